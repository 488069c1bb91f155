#include "studio/guard.h"

#include <sys/random.h>

#include <algorithm>
#include <array>

#include "engine/diagram/error.h"
#include "io/json/problems_json.h"

namespace hysteron::studio {
namespace {

HttpReply refusal(int status, const std::string& code, const std::string& what, const std::string& cure) {
  HttpReply reply;
  reply.status = status;
  reply.body = problems_json({{code, "request", what, cure, "", 0}}, 2);
  return reply;
}

bool is_own_address(std::string_view address, int port) {
  const std::string end = ":" + std::to_string(port);
  return address == "127.0.0.1" + end || address == "localhost" + end;
}

}  // namespace

std::string new_token() {
  std::array<unsigned char, 16> bytes{};
  if (getrandom(bytes.data(), bytes.size(), 0) != static_cast<long>(bytes.size()))
    fail("no_random_numbers", "token", "the system gave no random numbers", "look whether /dev/urandom can be read");
  std::string token;
  for (const unsigned char b : bytes) {
    token += "0123456789abcdef"[b >> 4];
    token += "0123456789abcdef"[b & 15];
  }
  return token;
}

bool same_secret(std::string_view a, std::string_view b) {
  unsigned different = a.size() == b.size() ? 0 : 1;
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i)
    different |= static_cast<unsigned>(static_cast<unsigned char>(a[i]) ^ static_cast<unsigned char>(b[i]));
  return different == 0;
}

std::optional<HttpReply> refused(const HttpRequest& request, const Guard& guard, bool needs_token) {
  const std::string page = "open the address that hysteron studio printed";
  if (!is_own_address(request.host, guard.port))
    return refusal(403, "foreign_host", "the request names another host than this one", page);
  constexpr std::string_view scheme = "http://";
  if (!request.origin.empty() && !(request.origin.starts_with(scheme) &&
                                   is_own_address(std::string_view(request.origin).substr(scheme.size()), guard.port)))
    return refusal(403, "foreign_origin", "the request comes from another page", page);
  if (needs_token && !same_secret(request.authorization, "Bearer " + guard.token))
    return refusal(401, "no_token", "the request does not carry the token of this studio", page);
  return {};
}

void add_safety_headers(HttpReply& reply) {
  reply.headers.insert(reply.headers.end(), {{"Content-Security-Policy",
                                              "default-src 'self'; img-src 'self' data: blob:; frame-ancestors 'none'; "
                                              "base-uri 'none'; form-action 'none'"},
                                             {"X-Content-Type-Options", "nosniff"},
                                             {"Referrer-Policy", "no-referrer"},
                                             {"Cross-Origin-Resource-Policy", "same-origin"},
                                             {"Cache-Control", "no-store"}});
}

}  // namespace hysteron::studio
