// Answers GET /metrics over HTTP/1.1, for Prometheus or curl: one thread of its own, one request
// after another, nothing kept. It asks a function for the page and touches no node. What comes from
// outside is bounded: bytes of a request, and the time a client may take for it.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <thread>

#include "runtime/core/clock.hpp"
#include "runtime/core/result.hpp"

namespace luxodus {

namespace limits {
/// A request's line and headers [bytes]; a scraper sends about 200.
inline constexpr size_t http_request_bytes = 8 * 1024;
/// From accepting a client to its answer; who is slower would keep others waiting.
inline constexpr Nanoseconds http_client = seconds(2);
}  // namespace limits

class MetricsServer {
 public:
  /// Begins to listen on a numeric IPv4 address; port 0 is any that is free. `page` is called on
  /// the server's thread. Errors: no such address, or the port is taken.
  static Result<std::unique_ptr<MetricsServer>> start(const std::string& address, uint16_t port,
                                                      std::function<std::string()> page);
  MetricsServer(const MetricsServer&) = delete;
  MetricsServer& operator=(const MetricsServer&) = delete;
  /// Ends after the request that is being answered.
  ~MetricsServer();

  uint16_t port() const { return port_; }

 private:
  /// A descriptor that is closed once.
  class Descriptor {
   public:
    explicit Descriptor(int fd) : fd_(fd) {}
    Descriptor(Descriptor&& other) noexcept : fd_(other.fd_) { other.fd_ = -1; }
    Descriptor& operator=(Descriptor&&) = delete;
    ~Descriptor();
    int get() const { return fd_; }

   private:
    int fd_;
  };

  MetricsServer(Descriptor listener, Descriptor stop, uint16_t port,
                std::function<std::string()> page);
  void serve();
  bool readable(int fd, Nanoseconds deadline) const;
  void answer(int client) const;
  std::string read_request(int client, Nanoseconds deadline) const;
  std::string reply_to(const std::string& request) const;

  Descriptor listener_;
  Descriptor stop_;  // an eventfd that is readable once this should end
  uint16_t port_;
  std::function<std::string()> page_;
  SystemClock clock_;
  std::thread thread_;
};

}  // namespace luxodus
