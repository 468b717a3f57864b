// A client of a server in the same process that sends arbitrary bytes over raw sockets, including
// invalid ones. Any thread.
#pragma once

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <cstdint>
#include <string>
#include <utility>

namespace luxodus::test {

/// One connection; make the client early if descriptors will run out.
class RawClient {
 public:
  RawClient() : socket_(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) { REQUIRE(socket_ >= 0); }
  RawClient(RawClient&& other) noexcept : socket_(std::exchange(other.socket_, -1)) {}
  ~RawClient() {
    if (socket_ >= 0) ::close(socket_);
  }

  void connect(uint16_t port) const {
    sockaddr_in place{};
    place.sin_family = AF_INET;
    place.sin_port = htons(port);
    place.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    REQUIRE(::connect(socket_, reinterpret_cast<sockaddr*>(&place), sizeof place) == 0);
  }
  void say(const std::string& bytes) const {
    REQUIRE(::send(socket_, bytes.data(), bytes.size(), MSG_NOSIGNAL) ==
            static_cast<ssize_t>(bytes.size()));
  }
  /// Closes the sending side.
  void end() const { ::shutdown(socket_, SHUT_WR); }
  std::string hear_some() const {
    std::string out(4096, '\0');
    const ssize_t count = ::recv(socket_, out.data(), out.size(), 0);
    out.resize(static_cast<size_t>(std::max<ssize_t>(0, count)));
    return out;
  }
  std::string hear_all() const {
    std::string out;
    for (std::string some = hear_some(); !some.empty(); some = hear_some()) out += some;
    return out;
  }
  /// Whether the other end has neither sent anything nor closed.
  bool is_waiting() const {
    char byte = 0;
    return ::recv(socket_, &byte, 1, MSG_DONTWAIT | MSG_PEEK) < 0;
  }

 private:
  int socket_;
};

/// The complete answer of a server to these bytes.
inline std::string whole_answer(uint16_t port, const std::string& bytes) {
  const RawClient client;
  client.connect(port);
  client.say(bytes);
  client.end();
  return client.hear_all();
}

/// The first line of a server's answer to these bytes.
inline std::string answer(uint16_t port, const std::string& bytes) {
  const RawClient client;
  client.connect(port);
  client.say(bytes);
  client.end();
  const std::string text = client.hear_some();
  return text.substr(0, text.find("\r\n"));
}

inline constexpr const char* http_ok = "HTTP/1.1 200 OK";
inline constexpr const char* http_switching = "HTTP/1.1 101 Switching Protocols";
inline constexpr const char* http_forbidden = "HTTP/1.1 403 Forbidden";

}  // namespace luxodus::test
