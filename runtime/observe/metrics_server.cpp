#include "runtime/observe/metrics_server.hpp"

#include <arpa/inet.h>
#include <fmt/core.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/eventfd.h>
#include <sys/socket.h>
#include <sys/time.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <limits>
#include <string_view>

namespace luxodus {

namespace {

constexpr Nanoseconds no_deadline = std::numeric_limits<Nanoseconds>::max();
constexpr const char* text_type = "text/plain; version=0.0.4; charset=utf-8";

std::string reply(const char* status, const std::string& body, bool with_body = true) {
  return fmt::format(
             "HTTP/1.1 {}\r\nContent-Type: {}\r\nContent-Length: {}\r\nConnection: close\r\n\r\n",
             status, text_type, body.size()) +
         (with_body ? body : "");
}

/// The part of `line` before the next blank, taken off it.
std::string_view next_word(std::string_view& line) {
  const size_t end = std::min(line.find(' '), line.size());
  const std::string_view word = line.substr(0, end);
  line.remove_prefix(std::min(end + 1, line.size()));
  return word;
}

void send_all(int client, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t sent = send(client, bytes.data(), bytes.size(), MSG_NOSIGNAL);
    if (sent <= 0) return;  // gone, or too slow: there is nobody to tell
    bytes.remove_prefix(static_cast<size_t>(sent));
  }
}

void limit_sending(int client) {
  timeval limit{};
  limit.tv_sec = limits::http_client / seconds(1);
  setsockopt(client, SOL_SOCKET, SO_SNDTIMEO, &limit, sizeof limit);
}

}  // namespace

MetricsServer::Descriptor::~Descriptor() {
  if (fd_ >= 0) close(fd_);
}

Result<std::unique_ptr<MetricsServer>> MetricsServer::start(const std::string& address,
                                                            uint16_t port,
                                                            std::function<std::string()> page) {
  const auto refused = [&](const std::string& why) {
    return Problem{{}, fmt::format("cannot serve metrics on {}:{}: {}", address, port, why)};
  };
  sockaddr_in place{};
  place.sin_family = AF_INET;
  place.sin_port = htons(port);
  if (inet_pton(AF_INET, address.c_str(), &place.sin_addr) != 1)
    return refused("the address is no IPv4 address such as 127.0.0.1");
  Descriptor listener(socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0));
  Descriptor stop(eventfd(0, EFD_CLOEXEC));
  const int yes = 1;
  setsockopt(listener.get(), SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
  constexpr int waiting_most = 16;
  auto* where = reinterpret_cast<sockaddr*>(&place);
  socklen_t size = sizeof place;
  if (stop.get() < 0 || listener.get() < 0 || bind(listener.get(), where, size) != 0 ||
      listen(listener.get(), waiting_most) != 0 || getsockname(listener.get(), where, &size) != 0)
    return refused(std::strerror(errno));
  return std::unique_ptr<MetricsServer>(new MetricsServer(std::move(listener), std::move(stop),
                                                          ntohs(place.sin_port), std::move(page)));
}

MetricsServer::MetricsServer(Descriptor listener, Descriptor stop, uint16_t port,
                             std::function<std::string()> page)
    : listener_(std::move(listener)),
      stop_(std::move(stop)),
      port_(port),
      page_(std::move(page)),
      thread_([this] { serve(); }) {}

MetricsServer::~MetricsServer() {
  eventfd_write(stop_.get(), 1);
  thread_.join();
}

void MetricsServer::serve() {
  while (readable(listener_.get(), no_deadline)) {
    const Descriptor client(accept4(listener_.get(), nullptr, nullptr, SOCK_CLOEXEC));
    if (client.get() >= 0) answer(client.get());
  }
}

/// Waits until `fd` can be read; false when the deadline comes first, or the server should end.
bool MetricsServer::readable(int fd, Nanoseconds deadline) const {
  std::array<pollfd, 2> watched{pollfd{fd, POLLIN, 0}, pollfd{stop_.get(), POLLIN, 0}};
  for (;;) {
    int wait_ms = -1;
    if (deadline != no_deadline) {
      const Nanoseconds left = deadline - clock_.now();
      if (left <= 0) return false;
      wait_ms = static_cast<int>(left / milliseconds(1)) + 1;
    }
    const int ready = poll(watched.data(), watched.size(), wait_ms);
    if (ready < 0 && errno != EINTR) return false;
    if (watched[1].revents != 0) return false;
    if (ready > 0 && watched[0].revents != 0) return true;
  }
}

void MetricsServer::answer(int client) const {
  limit_sending(client);
  const std::string request = read_request(client, clock_.now() + limits::http_client);
  if (!request.empty()) send_all(client, reply_to(request));
}

/// All up to the empty line, or more than is allowed; nothing where the client is gone or too slow.
std::string MetricsServer::read_request(int client, Nanoseconds deadline) const {
  std::string request;
  std::array<char, 1024> part{};
  while (request.find("\r\n\r\n") == std::string::npos &&
         request.size() <= limits::http_request_bytes) {
    if (!readable(client, deadline)) return {};
    const ssize_t received = recv(client, part.data(), part.size(), 0);
    if (received <= 0) return {};
    request.append(part.data(), static_cast<size_t>(received));
  }
  return request;
}

std::string MetricsServer::reply_to(const std::string& request) const {
  if (request.size() > limits::http_request_bytes)
    return reply("431 Request Header Fields Too Large", "the request is too long\n");
  std::string_view line = std::string_view(request).substr(0, request.find("\r\n"));
  const std::string_view method = next_word(line);
  const std::string_view path = next_word(line);
  const std::string_view version = next_word(line);
  if (!version.starts_with("HTTP/1.") || path.empty())
    return reply("400 Bad Request", "this is not HTTP/1\n");
  if (method != "GET" && method != "HEAD")
    return reply("405 Method Not Allowed", "only GET and HEAD\n");
  const bool with_body = method == "GET";
  if (path != "/metrics") return reply("404 Not Found", "there is only /metrics\n", with_body);
  return reply("200 OK", page_(), with_body);
}

}  // namespace luxodus
