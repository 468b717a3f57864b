// ZeroMQ state shared by all nodes of a process: the context with its I/O threads, and the
// authenticator (ZAP, https://rfc.zeromq.org/spec/27), which admits only clients whose keys are
// listed. It has no thread of its own: every node that polls serves it, one at a time. Thread rule:
// any thread.
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "runtime/core/ids.hpp"

namespace zmq {
class context_t;
class socket_t;
}  // namespace zmq

namespace luxodus {

/// A client that is admitted, and its node.
struct Admitted {
  NodeId node;
  std::string public_key;  // Z85
};

/// The routing id of a node's sockets.
std::string routing_id(NodeId node);

class ZmqContext {
 public:
  /// Two I/O threads: a single one would do all encryption of a host.
  static constexpr int io_threads_usual = 2;

  /// Also makes malloc keep freed memory, in the whole process: see zmq_context.cpp. Errors
  /// (exception): an invalid key.
  explicit ZmqContext(const std::vector<Admitted>& admitted, int io_threads = io_threads_usual);
  ~ZmqContext();

  zmq::context_t& context() { return *context_; }

  /// Readable when an authentication request may be waiting.
  int door_descriptor() const { return door_descriptor_; }
  /// Answers waiting authentication requests; returns at once if another thread is doing so.
  void answer_door();

  uint64_t let_in() const { return let_in_; }
  uint64_t turned_away() const { return turned_away_; }

 private:
  struct Listed {
    std::string binary_key;
    std::string name;
  };
  bool answer_one();
  const Listed* find(const std::string& binary_key) const;

  std::vector<Listed> listed_;
  std::unique_ptr<zmq::context_t> context_;
  std::mutex door_mutex_;
  std::unique_ptr<zmq::socket_t> door_;
  int door_descriptor_ = -1;
  std::atomic<uint64_t> let_in_ = 0;
  std::atomic<uint64_t> turned_away_ = 0;
};

}  // namespace luxodus
