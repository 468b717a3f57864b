// Answers GET /metrics over HTTP/1.1, for Prometheus or curl: one thread of its own, one request
// a connection, nothing kept. It asks a function for the page and touches no node. Clients do not
// wait for each other. What comes from outside is bounded: connections, bytes of a request, and the
// time a client may take for it.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "runtime/core/clock.hpp"
#include "runtime/core/result.hpp"

namespace luxodus {

namespace limits {
/// A request's line and headers [bytes]; a scraper sends about 200.
inline constexpr size_t http_request_bytes = 8 * 1024;
/// From accepting a client to the last byte of its answer.
inline constexpr Nanoseconds http_client = seconds(2);
/// At once; one more takes the place of the one that has been there longest. Scrapers and people
/// who look are a handful.
inline constexpr size_t http_clients = 32;
}  // namespace limits

class MetricsServer {
 public:
  /// Begins to listen on a numeric IPv4 address; port 0 is any that is free. `page` is called on
  /// the server's thread. Errors: no such address, or the port is taken.
  static Result<std::unique_ptr<MetricsServer>> start(const std::string& address, uint16_t port,
                                                      std::function<std::string()> page);
  MetricsServer(const MetricsServer&) = delete;
  MetricsServer& operator=(const MetricsServer&) = delete;
  /// Ends at once: clients that are being answered are cut off.
  ~MetricsServer();

  uint16_t port() const { return port_; }

 private:
  /// A descriptor that is closed once.
  class Descriptor {
   public:
    explicit Descriptor(int fd) : fd_(fd) {}
    Descriptor(Descriptor&& other) noexcept : fd_(other.fd_) { other.fd_ = -1; }
    Descriptor& operator=(Descriptor&& other) noexcept {
      std::swap(fd_, other.fd_);
      return *this;
    }
    ~Descriptor();
    int get() const { return fd_; }

   private:
    int fd_;
  };

  MetricsServer(Descriptor listener, Descriptor stop, uint16_t port,
                std::function<std::string()> page);
  /// A client from its connection to the end of its answer.
  struct Client;
  void serve();
  bool accept_one(std::vector<Client>& clients, Nanoseconds now) const;
  bool go_on(Client& client) const;
  std::string reply_to(const std::string& request) const;

  Descriptor listener_;
  Descriptor stop_;  // an eventfd that is readable once this should end
  uint16_t port_;
  std::function<std::string()> page_;
  SystemClock clock_;
  std::thread thread_;
};

}  // namespace luxodus
