#include "runtime/observe/metrics_server.hpp"

#include <arpa/inet.h>
#include <fmt/core.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/eventfd.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <limits>
#include <string_view>
#include <utility>

namespace luxodus {

namespace {

constexpr Nanoseconds no_deadline = std::numeric_limits<Nanoseconds>::max();
/// Until a connection is accepted again, after one could not be: descriptors have run out.
constexpr Nanoseconds accept_again = milliseconds(100);
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
  Descriptor listener(socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0));
  Descriptor stop(eventfd(0, EFD_CLOEXEC));
  const int yes = 1;
  setsockopt(listener.get(), SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
  constexpr int max_waiting = 16;
  auto* where = reinterpret_cast<sockaddr*>(&place);
  socklen_t size = sizeof place;
  if (stop.get() < 0 || listener.get() < 0 || bind(listener.get(), where, size) != 0 ||
      listen(listener.get(), max_waiting) != 0 || getsockname(listener.get(), where, &size) != 0)
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

struct MetricsServer::Client {
  Descriptor connection;
  Nanoseconds deadline;
  std::string request = {};
  std::string reply = {};  // empty while the request is read
  size_t sent = 0;
};

/// Waits for all at once: who says nothing, or reads nothing, keeps nobody else waiting.
void MetricsServer::serve() {
  std::vector<Client> clients;
  Nanoseconds accept_at = 0;
  for (;;) {
    const Nanoseconds now = clock_.now();
    std::erase_if(clients, [&](const Client& client) { return client.deadline <= now; });
    Nanoseconds wake = accept_at > now ? accept_at : no_deadline;
    for (const Client& client : clients) wake = std::min(wake, client.deadline);
    std::vector<pollfd> watched{{stop_.get(), POLLIN, 0}};
    watched.push_back({accept_at > now ? -1 : listener_.get(), POLLIN, 0});
    for (const Client& client : clients)
      watched.push_back({client.connection.get(),
                         static_cast<short>(client.reply.empty() ? POLLIN : POLLOUT), 0});
    const int wait_ms =
        wake == no_deadline ? -1 : static_cast<int>((wake - now) / milliseconds(1)) + 1;
    if (poll(watched.data(), watched.size(), wait_ms) < 0 && errno != EINTR) return;
    if (watched[0].revents != 0) return;
    for (size_t i = clients.size(); i-- > 0;)
      if (watched[i + 2].revents != 0 && !go_on(clients[i]))
        clients.erase(clients.begin() + static_cast<std::ptrdiff_t>(i));
    if (watched[1].revents != 0 && !accept_one(clients, clock_.now()))
      accept_at = clock_.now() + accept_again;
  }
}

/// False: none could be accepted, for want of descriptors or memory.
bool MetricsServer::accept_one(std::vector<Client>& clients, Nanoseconds now) const {
  Descriptor connection(accept4(listener_.get(), nullptr, nullptr, SOCK_CLOEXEC | SOCK_NONBLOCK));
  if (connection.get() < 0)  // gone before it was accepted, or what more is there to take
    return errno == EAGAIN || errno == EINTR || errno == ECONNABORTED;
  if (clients.size() == limits::http_clients) clients.erase(clients.begin());
  clients.push_back({std::move(connection), now + limits::http_client});
  return true;
}

/// Reads or sends what can be; false when the client has its answer, or is gone.
bool MetricsServer::go_on(Client& client) const {
  const auto later = [] { return errno == EAGAIN || errno == EINTR; };
  const int fd = client.connection.get();
  if (client.reply.empty()) {
    std::array<char, 1024> part{};
    const ssize_t received = recv(fd, part.data(), part.size(), 0);
    if (received <= 0) return received < 0 && later();
    client.request.append(part.data(), static_cast<size_t>(received));
    if (client.request.find("\r\n\r\n") == std::string::npos &&
        client.request.size() <= limits::http_request_bytes)
      return true;
    client.reply = reply_to(client.request);
  }
  const std::string_view rest = std::string_view(client.reply).substr(client.sent);
  const ssize_t sent = send(fd, rest.data(), rest.size(), MSG_NOSIGNAL);
  if (sent < 0) return later();
  client.sent += static_cast<size_t>(sent);
  return client.sent < client.reply.size();
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
