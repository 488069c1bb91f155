// Decides what of an HTTP request and its answer the studio looks at. Keeps the costly HTTP headers out of all but one
// source (http_server.cpp).
#pragma once

#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace hysteron::studio {

struct HttpRequest {
  std::string method;                               ///< "GET"
  std::string path;                                 ///< "/api/view", decoded
  std::multimap<std::string, std::string> query{};  ///< decoded
  std::string host{}, origin{}, authorization{};    ///< headers; "" where they were not sent
  std::string body{};

  /// The first value of a key of the query, or "".
  std::string asked(const std::string& key) const {
    const auto found = query.find(key);
    return found == query.end() ? "" : found->second;
  }
};

/// Sends one more piece of an answer that goes on; with "" only looks. False: nobody reads any more, or the server
/// ends.
using HttpSend = std::function<bool(std::string_view piece)>;

struct HttpReply {
  int status = 200;
  std::string type = "application/json";
  std::string body{};
  std::vector<std::pair<std::string, std::string>> headers{};
  std::function<void(const HttpSend&)> stream{};  ///< in place of `body`, where there is one; returns when it is over
};

}  // namespace hysteron::studio
