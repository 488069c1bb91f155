// The only source that reads the headers of Boost.Beast, which take long to compile; they bring no library with them,
// whose loading every verb would pay for. One thread per connection: a browser holds six of them.
#include "studio/http_server.h"

#include <poll.h>
#include <sys/socket.h>

#include <atomic>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/write.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <chrono>
#include <list>
#include <mutex>
#include <thread>

#include "engine/diagram/error.h"

namespace hysteron::studio {
namespace {

namespace asio = boost::asio;
namespace http = boost::beast::http;
using Tcp = asio::ip::tcp;
using Clock = std::chrono::steady_clock;

constexpr std::uint64_t largest_body = std::uint64_t{64} << 20;  // [bytes]; a recording that is dropped on the page
constexpr std::uint32_t largest_header = 16 * 1024;              // [bytes]
constexpr std::size_t most_connections = 64;
constexpr auto patience = std::chrono::seconds(30);  // for a request to come in, whole
constexpr int look_every = 200;                      // [ms] for connections that wait too long

int digit_of(char c) {
  return c >= '0' && c <= '9'   ? c - '0'
         : c >= 'a' && c <= 'f' ? c - 'a' + 10
         : c >= 'A' && c <= 'F' ? c - 'A' + 10
                                : -1;
}

/// "%2F" is "/"; in a query "+" is a blank.
std::string decoded(std::string_view text, bool is_query) {
  std::string plain;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '%' && i + 2 < text.size() && digit_of(text[i + 1]) >= 0 && digit_of(text[i + 2]) >= 0) {
      plain += static_cast<char>(16 * digit_of(text[i + 1]) + digit_of(text[i + 2]));
      i += 2;
    } else {
      plain += is_query && text[i] == '+' ? ' ' : text[i];
    }
  }
  return plain;
}

HttpRequest plain(const http::request<http::string_body>& from) {
  const auto header = [&](http::field name) { return std::string(from[name]); };
  const std::string_view target(from.target().data(), from.target().size());
  HttpRequest request{std::string(from.method_string()), decoded(target.substr(0, target.find('?')), false)};
  for (auto at = target.find('?'); at != target.npos;) {
    const auto end = target.find('&', at + 1);
    const std::string_view pair = target.substr(at + 1, end == target.npos ? end : end - at - 1);
    const auto equals = std::min(pair.find('='), pair.size());
    if (!pair.empty())
      request.query.emplace(decoded(pair.substr(0, equals), true),
                            decoded(pair.substr(std::min(equals + 1, pair.size())), true));
    at = end;
  }
  request.host = header(http::field::host);
  request.origin = header(http::field::origin);
  request.authorization = header(http::field::authorization);
  request.body = from.body();
  return request;
}

}  // namespace

struct HttpServer::Parts {
  struct Connection {
    explicit Connection(Tcp::socket s) : socket(std::move(s)) {}
    Tcp::socket socket;
    std::thread thread{};
    std::atomic<Clock::time_point> deadline{Clock::now() + patience};
    std::atomic<bool> has_ended{false};
  };

  void talk(Connection& connection) {
    boost::beast::flat_buffer buffer;
    boost::system::error_code error;
    while (!error) {
      http::request_parser<http::string_body> parser;
      parser.body_limit(largest_body);
      parser.header_limit(largest_header);
      connection.deadline = Clock::now() + patience;
      http::read(connection.socket, buffer, parser, error);
      if (error) break;
      connection.deadline = Clock::time_point::max();  // however long the answer takes
      HttpReply reply = answer(plain(parser.get()));
      http::response<http::string_body> response{static_cast<http::status>(reply.status), parser.get().version()};
      for (const auto& [name, value] : reply.headers) response.set(name, value);
      response.set(http::field::content_type, reply.type);
      if (reply.stream) {
        stream(connection, response.base(), reply.stream);
        break;
      }
      response.keep_alive(parser.get().keep_alive());
      response.body() = std::move(reply.body);
      response.prepare_payload();
      http::write(connection.socket, response, error);
      if (!response.keep_alive()) break;
    }
    connection.socket.shutdown(Tcp::socket::shutdown_both, error);
    connection.has_ended = true;
  }

  /// An answer that goes on: in pieces, until it is over, or nobody reads it any more.
  void stream(Connection& connection, const http::response_header<>& header,
              const std::function<void(const HttpSend&)>& pieces) {
    boost::system::error_code error;
    http::response<http::empty_body> response{header};
    response.keep_alive(false);
    response.chunked(true);
    http::response_serializer<http::empty_body> serializer{response};
    http::write_header(connection.socket, serializer, error);
    pieces([&](std::string_view piece) {
      if (!error && !piece.empty())
        asio::write(connection.socket, http::make_chunk(asio::buffer(piece.data(), piece.size())), error);
      pollfd there{connection.socket.native_handle(), POLLRDHUP, 0};
      return !error && !ends && poll(&there, 1, 0) == 0;
    });
    if (!error) asio::write(connection.socket, http::make_chunk_last(), error);
  }

  /// Those that have ended go; those that wait too long, or all, are cut.
  void reap(bool all) {
    for (auto i = connections.begin(); i != connections.end();) {
      if (all || i->deadline.load() < Clock::now()) shutdown(i->socket.native_handle(), SHUT_RDWR);
      if (all || i->has_ended) {
        i->thread.join();
        i = connections.erase(i);
      } else {
        ++i;
      }
    }
  }

  void accept_one() {
    boost::system::error_code error;
    Tcp::socket socket = acceptor.accept(error);
    if (error || connections.size() >= most_connections) return;
    socket.set_option(Tcp::no_delay(true), error);
    Connection& connection = connections.emplace_back(std::move(socket));
    connection.thread = std::thread([this, &connection] { talk(connection); });
  }

  std::function<HttpReply(const HttpRequest&)> answer;
  asio::io_context context{};
  Tcp::acceptor acceptor{context};
  std::list<Connection> connections{};  // of the thread that serves
  std::atomic<bool> ends{false};
};

HttpServer::HttpServer(std::function<HttpReply(const HttpRequest&)> answer) : parts_(std::make_unique<Parts>()) {
  parts_->answer = std::move(answer);
}

HttpServer::~HttpServer() = default;

int HttpServer::bind(int port) {
  const Tcp::endpoint here(asio::ip::address_v4::loopback(), static_cast<std::uint16_t>(port));
  boost::system::error_code error;
  parts_->acceptor.open(here.protocol());
  parts_->acceptor.set_option(Tcp::acceptor::reuse_address(true));
  parts_->acceptor.bind(here, error);
  if (!error) parts_->acceptor.listen(asio::socket_base::max_listen_connections, error);
  if (error)
    fail("port_taken", "--port",
         "port " + std::to_string(port) + " of this machine cannot be taken: " + error.message(),
         "leave --port out, then a free one is taken; or end the program that has it");
  return parts_->acceptor.local_endpoint().port();
}

void HttpServer::serve() {
  while (!parts_->ends) {
    pollfd incoming{parts_->acceptor.native_handle(), POLLIN, 0};
    if (poll(&incoming, 1, look_every) > 0) parts_->accept_one();
    parts_->reap(false);
  }
  parts_->reap(true);
}

void HttpServer::stop() { parts_->ends = true; }

}  // namespace hysteron::studio
