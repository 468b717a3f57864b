// A library that does the work of the table of peers. Everything here runs in a process of its own,
// which is killed when it has been measured: functions that return nothing never return. A function
// that is null is work for which the library has nothing.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace luxodus::bench {

/// What has been done so far. Any thread.
class Count {
 public:
  /// By the only thread that counts.
  void add(uint64_t more = 1) {
    done_.store(done_.load(std::memory_order_relaxed) + more, std::memory_order_relaxed);
  }
  /// By one of several threads.
  void add_shared() { done_.fetch_add(1, std::memory_order_relaxed); }
  uint64_t done() const { return done_.load(std::memory_order_relaxed); }

 private:
  std::atomic<uint64_t> done_{0};
};

/// Objects that one process holds and another asks for by their number, over TCP of this host.
struct Transfer {
  size_t bytes = 0;
  size_t in_flight = 0;  // requests that wait for their object at once
  uint16_t port = 0;     // this and the next are free

  /// Objects that the holder has: several for each request in flight, and at least 16 more than are
  /// in flight, so that a small cache helps nobody.
  size_t objects() const { return in_flight * (1 + (16 + in_flight - 1) / in_flight); }
  std::string endpoint() const { return "tcp://127.0.0.1:" + std::to_string(port); }
};

/// What a process says while it watches another. Any thread.
struct Watch {
  std::function<void()> connected;  // the other process is known to be there
  std::function<void()> lost;       // and to be gone
};

struct Peer {
  std::string name;
  std::string how;     // what does the work, and with which options
  bool polls = false;  // it takes whole processors while it waits

  /// Two actors or fibers of one thread send each other a number in turn.
  void (*play)(Count& messages) = nullptr;
  /// The same with messages that need no fiber.
  void (*play_without_fibers)(Count& messages) = nullptr;
  /// Makes so many actors or fibers that wait for messages, and calls `held` while they do.
  void (*hold_fibers)(size_t count, const std::function<void()>& held) = nullptr;
  void (*hold_actors)(size_t count, const std::function<void()>& held) = nullptr;

  /// Holds the objects.
  void (*serve)(const Transfer& work) = nullptr;
  /// Keeps so many requests in flight, and counts the objects that came.
  void (*ask)(const Transfer& work, Count& objects) = nullptr;
  /// Waits on a link without traffic for the end of the process that serves.
  void (*watch)(const Transfer& link, const Watch& watch) = nullptr;
  /// For libraries that start their own processes: a command that holds and asks, and prints what
  /// sample() gives.
  std::string (*command)(const Transfer& work, int64_t span_ns) = nullptr;
};

Peer luxodus_peer();
Peer zeromq_peer();
// Each where its package was found when this was compiled.
Peer boost_fiber_peer();
Peer caf_peer();
Peer nng_peer();
Peer open_mpi_peer();

}  // namespace luxodus::bench
