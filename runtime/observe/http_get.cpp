#include "runtime/observe/http_get.hpp"

#include <fcntl.h>
#include <fmt/core.h>
#include <netdb.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <memory>
#include <string_view>

namespace luxodus {

namespace {

/// Status line and headers [bytes].
constexpr size_t max_head_bytes = 16 * 1024;

/// A connection under a deadline; the first thing that goes wrong is kept.
class Connection {
 public:
  explicit Connection(Nanoseconds patience) : deadline_(clock_.now() + patience) {}
  Connection(const Connection&) = delete;
  Connection& operator=(const Connection&) = delete;
  ~Connection() {
    if (fd_ >= 0) ::close(fd_);
  }

  bool open(const HttpUrl& url) {
    addrinfo wanted{};
    wanted.ai_family = AF_INET;
    wanted.ai_socktype = SOCK_STREAM;
    addrinfo* found = nullptr;
    const int wrong =
        ::getaddrinfo(url.host.c_str(), std::to_string(url.port).c_str(), &wanted, &found);
    if (wrong != 0) return fail(::gai_strerror(wrong));
    const std::unique_ptr<addrinfo, decltype(&::freeaddrinfo)> owned(found, ::freeaddrinfo);
    fd_ = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
    if (fd_ < 0) return fail(std::strerror(errno));
    if (::connect(fd_, found->ai_addr, found->ai_addrlen) == 0) return true;
    if (errno != EINPROGRESS) return fail(std::strerror(errno));
    if (!wait(POLLOUT)) return false;
    int error = 0;
    socklen_t size = sizeof error;
    ::getsockopt(fd_, SOL_SOCKET, SO_ERROR, &error, &size);
    return error == 0 || fail(std::strerror(error));
  }

  bool send_all(std::string_view bytes) {
    while (!bytes.empty()) {
      if (!wait(POLLOUT)) return false;
      const ssize_t sent = ::send(fd_, bytes.data(), bytes.size(), MSG_NOSIGNAL);
      if (sent < 0 && (errno == EAGAIN || errno == EINTR)) continue;
      if (sent < 0) return fail(std::strerror(errno));
      bytes.remove_prefix(static_cast<size_t>(sent));
    }
    return true;
  }

  /// All until the other end closes.
  bool receive_all(std::string& answer) {
    std::array<char, 16 * 1024> part{};
    while (wait(POLLIN)) {
      const ssize_t received = ::recv(fd_, part.data(), part.size(), 0);
      if (received == 0) return true;
      if (received < 0 && (errno == EAGAIN || errno == EINTR)) continue;
      if (received < 0) return fail(std::strerror(errno));
      answer.append(part.data(), static_cast<size_t>(received));
      if (answer.size() > limits::http_page_bytes + max_head_bytes)
        return fail(fmt::format("the page is longer than {} bytes", limits::http_page_bytes));
    }
    return false;
  }

  const std::string& why() const { return why_; }

 private:
  bool fail(const std::string& why) {
    why_ = why;
    return false;
  }
  bool wait(short events) {
    for (;;) {
      const Nanoseconds left = deadline_ - clock_.now();
      if (left <= 0) return fail("no answer in time");
      pollfd watched{fd_, events, 0};
      const int ready = ::poll(&watched, 1, static_cast<int>(left / milliseconds(1)) + 1);
      if (ready > 0) return true;
      if (ready < 0 && errno != EINTR) return fail(std::strerror(errno));
    }
  }

  SystemClock clock_;
  Nanoseconds deadline_;
  int fd_ = -1;
  std::string why_;
};

}  // namespace

std::string HttpUrl::text() const {
  return fmt::format("http://{}:{}{}", host, port, path);
}

Result<HttpUrl> parse_http_url(const std::string& text) {
  const Problem wrong{{},
                      fmt::format("\"{}\" is no address such as 127.0.0.1:9464 or "
                                  "http://host:9464/metrics",
                                  text)};
  std::string_view rest = text;
  constexpr std::string_view scheme = "http://";
  if (rest.starts_with(scheme)) rest.remove_prefix(scheme.size());
  const size_t slash = std::min(rest.find('/'), rest.size());
  const std::string_view place = rest.substr(0, slash);
  HttpUrl url;
  if (slash < rest.size()) url.path = rest.substr(slash);
  const size_t colon = place.rfind(':');
  if (colon == std::string_view::npos || colon == 0) return wrong;
  url.host = place.substr(0, colon);
  const char* end = place.data() + place.size();
  const auto [at, error] = std::from_chars(place.data() + colon + 1, end, url.port);
  const auto printable = [](char c) { return c > ' ' && c < 0x7f; };
  if (error != std::errc() || at != end || url.port == 0 ||
      url.host.find(':') != std::string::npos ||
      !std::all_of(url.host.begin(), url.host.end(), printable) ||
      !std::all_of(url.path.begin(), url.path.end(), printable))
    return wrong;
  return url;
}

Result<std::string> http_get(const HttpUrl& url, Nanoseconds patience) {
  const auto refused = [&](const std::string& why) {
    return Problem{{}, fmt::format("{}: {}", url.text(), why)};
  };
  Connection connection(patience);
  std::string answer;
  const std::string question = fmt::format(
      "GET {} HTTP/1.1\r\nHost: {}:{}\r\nConnection: close\r\n\r\n", url.path, url.host, url.port);
  if (!connection.open(url) || !connection.send_all(question) || !connection.receive_all(answer))
    return refused(connection.why());
  const size_t head = answer.find("\r\n\r\n");
  if (head == std::string::npos || !answer.starts_with("HTTP/1."))
    return refused("the answer is not HTTP/1");
  const std::string status = answer.substr(0, answer.find("\r\n"));
  if (status.find(" 200") != std::string("HTTP/1.1").size())
    return refused("the answer is " + status);
  return answer.substr(head + 4);
}

}  // namespace luxodus
