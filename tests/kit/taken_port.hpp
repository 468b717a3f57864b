// A port of this host at which another program listens. One thread.
#pragma once

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>

#include <cstdint>
#include <stdexcept>

#include "runtime/core/file_descriptor.hpp"

namespace luxodus::test {

class TakenPort {
 public:
  TakenPort() : socket_(::socket(AF_INET, SOCK_STREAM, 0)) {
    sockaddr_in at{};
    at.sin_family = AF_INET;
    at.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t length = sizeof at;
    auto* address = reinterpret_cast<sockaddr*>(&at);
    if (::bind(socket_.number(), address, length) != 0 || ::listen(socket_.number(), 1) != 0 ||
        ::getsockname(socket_.number(), address, &length) != 0)
      throw std::runtime_error("no port to take");
    number_ = ntohs(at.sin_port);
  }
  uint16_t number() const { return number_; }

 private:
  FileDescriptor socket_;
  uint16_t number_ = 0;
};

}  // namespace luxodus::test
