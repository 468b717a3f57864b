// What all nodes of a process share of ZeroMQ: the context with its I/O threads, and the door that
// lets in only clients whose keys are listed (ZAP, https://rfc.zeromq.org/spec/27). It has no
// thread of its own: every node that polls answers at the door, one at a time.
// Thread rule: any thread.
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

/// A client that may come in, and as which node.
struct Admitted {
  NodeId node;
  std::string public_key;  // Z85
};

/// The name under which a node's sockets know each other.
std::string routing_id(NodeId node);

class ZmqContext {
 public:
  /// Two I/O threads: one alone does all encryption of a host.
  static constexpr int io_threads_usual = 2;

  /// Errors (exception): a key that is none.
  explicit ZmqContext(const std::vector<Admitted>& admitted, int io_threads = io_threads_usual);
  ~ZmqContext();

  zmq::context_t& context() { return *context_; }

  /// Readable when somebody may be at the door.
  int door_descriptor() const { return door_descriptor_; }
  /// Answers whoever is at the door; returns at once if another thread is doing so.
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
