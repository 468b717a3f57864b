// The program's HTTP server, by Boost.Beast: pages made by a function, and optionally a WebSocket.
// It reads no file. Clients, bytes of a request, and the time per client are limited; no client
// waits for another. A request must name the address at which it arrived, or an allowed name
// (served_names.hpp says why). Only GET and HEAD; one request per connection. Thread rule: run()
// serves on the calling thread; post(), stop(), port() and accepts_failed() may be called from any.
// Design: README.md.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/core/clock.hpp"
#include "runtime/core/result.hpp"
#include "runtime/http/web_socket.hpp"

namespace luxodus {

namespace limits {
/// A request's line and headers [bytes]; a scraper sends about 200, a browser about 1000.
inline constexpr uint32_t http_request_bytes = 8 << 10;
/// Time from accepting a client to the last byte of its answer.
inline constexpr Nanoseconds http_client = seconds(15);
/// Clients at once, without open WebSockets; one more replaces the oldest.
inline constexpr size_t http_clients = 32;
}  // namespace limits

struct HttpPage {
  std::string body;
  std::string type;                           // "text/html; charset=utf-8"
  std::string policy = "default-src 'none'";  // Content-Security-Policy
};

/// Content of a server.
struct HttpSite {
  /// The page at a path without its query; nothing: 404. Called on the thread of run().
  std::function<std::optional<HttpPage>(std::string_view path)> page;
  /// Path of the WebSocket; "": none.
  std::string socket_path = {};
  /// Makes the listener of a newly opened socket.
  std::function<std::unique_ptr<SocketListener>(WebSocket&)> opened = {};
  SocketLimits limits = {};
};

struct HttpAddress {
  std::string address = "127.0.0.1";  // numeric, IPv4 or IPv6
  uint16_t port = 0;                  // 0: any free port
  std::string token = {};             // required as ?token=...; "": none
  /// Further names that requests may give: see served_names.hpp.
  std::vector<std::string> allowed_hosts = {};
};

class HttpServer {
 public:
  /// Starts to listen. Errors: an invalid address, a port in use.
  static Result<std::unique_ptr<HttpServer>> listen(HttpAddress at, HttpSite site);
  HttpServer(const HttpServer&) = delete;
  HttpServer& operator=(const HttpServer&) = delete;
  /// Requires: run() has returned.
  ~HttpServer();

  uint16_t port() const;
  /// Connections that could not be accepted, for example for lack of descriptors.
  uint64_t accepts_failed() const;
  /// Serves until stop(), or until `ends` returns true, which is checked ten times a second.
  /// Clients being served are then disconnected, and listeners of sockets destroyed.
  void run();
  void run(const std::function<bool()>& ends);
  void stop();
  /// Runs a function on the thread of run().
  void post(std::function<void()> function);

 private:
  class Implementation;
  explicit HttpServer(std::unique_ptr<Implementation> implementation);
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace luxodus
