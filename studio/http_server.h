// Decides how requests come in and answers go out: HTTP on the loopback interface, and nowhere else.
// Does not decide who may ask (guard.h) nor what is answered (api.h).
#pragma once

#include <functional>
#include <memory>

#include "studio/http_message.h"

namespace hysteron::studio {

class HttpServer {
 public:
  /// `answer` is called by several threads at once and throws nothing.
  explicit HttpServer(std::function<HttpReply(const HttpRequest&)> answer);
  ~HttpServer();
  HttpServer(const HttpServer&) = delete;
  HttpServer& operator=(const HttpServer&) = delete;

  /// Takes a port of 127.0.0.1 (0: any that is free) and returns it. Throws Error "port_taken".
  int bind(int port);
  /// Answers until stop() is called, by another thread.
  void serve();
  void stop();

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace hysteron::studio
