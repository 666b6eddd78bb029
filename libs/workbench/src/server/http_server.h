#pragma once

#include <functional>
#include <memory>
#include <string>

#include "server/exchange.h"

namespace hersey::workbench {

/// HTTP on the loopback address: connections with limits and deadlines, each request examined by `refusal` before its
/// body is read. The one file that includes cpp-httplib is its source.
///
/// A connection has 10 s for the head of a request, 10 s more for its body, and 10 s for each part of a reply to be
/// taken. At most 96 connections are served; a further one replaces the one that has asked the interface for nothing
/// for longest.
class HttpServer {
 public:
  using Log = std::function<void(const std::string&)>;

  HttpServer(std::string token, Handler handler, Log log);
  HttpServer(const HttpServer&) = delete;
  HttpServer& operator=(const HttpServer&) = delete;
  ~HttpServer();

  /// @returns false if the port is taken
  [[nodiscard]] bool bind(int port);
  /// Serves until `stop` is called from another thread, and returns when all connections are closed.
  void listen();
  void stop();

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace hersey::workbench
