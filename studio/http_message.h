// Decides what of an HTTP request and its answer the studio looks at. Keeps the costly HTTP headers out of all but one
// source (http_server.cpp).
#pragma once

#include <map>
#include <string>
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

struct HttpReply {
  int status = 200;
  std::string type = "application/json";
  std::string body{};
  std::vector<std::pair<std::string, std::string>> headers{};
};

}  // namespace hysteron::studio
