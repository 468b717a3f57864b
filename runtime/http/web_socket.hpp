// One open WebSocket of an HttpServer, and its listener. Thread rule: everything on the thread that
// serves.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace luxodus {

class WebSocket {
 public:
  using Bytes = std::shared_ptr<const std::string>;  // one message may wait in many queues
  enum class Kind { text, binary };

  virtual ~WebSocket() = default;
  /// Queues a message. A `revocable` message may be taken back while it waits. A socket whose peer
  /// leaves too much unread is closed. Does nothing once the socket is closed.
  virtual void send(Bytes message, Kind kind, bool revocable) = 0;
  /// Removes the revocable messages that wait, and returns them in order.
  virtual std::vector<Bytes> take_back() = 0;
};

/// Receives the messages of one socket; destroyed when the socket has closed or the server ends.
class SocketListener {
 public:
  virtual ~SocketListener() = default;
  virtual void hears(std::string_view message) = 0;
};

struct SocketLimits {
  size_t sockets = 32;              // open at once; further ones are refused
  size_t message_bytes = 64 << 10;  // a longer message closes its socket
  int messages_per_s = 50;          // further ones are dropped
  size_t unread_bytes = 256 << 20;  // waiting to be sent; more closes the socket
};

}  // namespace luxodus
