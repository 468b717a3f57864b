// The one HTTP server of the program, by Boost.Beast: pages that a function makes, and perhaps one
// WebSocket. It reads no file. What comes from outside is bounded: clients, bytes of a request, and
// the time a client may take; no client waits for another. A request must name the address where
// it arrived, or an allowed name (served_names.hpp says why). Only GET and HEAD; one request a
// connection. Thread rule: run() serves on the thread that calls it; post(), stop(), port() and
// accepts_failed() may be called from any. Design: README.md.
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
/// From accepting a client to the last byte of its answer.
inline constexpr Nanoseconds http_client = seconds(15);
/// At once, open WebSockets apart; one more takes the place of the one that has been there longest.
inline constexpr size_t http_clients = 32;
}  // namespace limits

struct HttpPage {
  std::string body;
  std::string type;                           // "text/html; charset=utf-8"
  std::string policy = "default-src 'none'";  // Content-Security-Policy
};

/// What a server answers to.
struct HttpSite {
  /// The page at a path, without its query; none: 404. Called on the thread of run().
  std::function<std::optional<HttpPage>(std::string_view path)> page;
  /// Where a WebSocket is opened; "": nowhere.
  std::string socket_path = {};
  /// Makes the listener of a socket that has been opened.
  std::function<std::unique_ptr<SocketListener>(WebSocket&)> opened = {};
  SocketLimits limits = {};
};

struct HttpAddress {
  std::string address = "127.0.0.1";  // numeric, IPv4 or IPv6
  uint16_t port = 0;                  // 0: any that is free
  std::string token = {};             // demanded as ?token=...; "": none
  /// Names that requests may give, beside the address: see served_names.hpp.
  std::vector<std::string> allowed_hosts = {};
};

class HttpServer {
 public:
  /// Listens at once. Errors: an address that is none, a port that is taken.
  static Result<std::unique_ptr<HttpServer>> listen(HttpAddress at, HttpSite site);
  HttpServer(const HttpServer&) = delete;
  HttpServer& operator=(const HttpServer&) = delete;
  /// Requires: run() has returned.
  ~HttpServer();

  uint16_t port() const;
  /// Connections that could not be accepted, as where descriptors have run out.
  uint64_t accepts_failed() const;
  /// Serves until stop(), or until `interrupt`, which is looked at ten times a second. Clients that
  /// are being answered are then cut off, and listeners of sockets are destroyed.
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
