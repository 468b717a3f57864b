// Metrics and traces of one process: the numbers of all its nodes as one page over HTTP. A node
// registers its numbers when it starts and publishes copies of them now and then; readers of the
// page read the copies, so no node ever waits for a reader. Thread rule: start() and destruction on
// one thread; show() and page() on any.
#pragma once

#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "runtime/core/atomic_file.hpp"
#include "runtime/http/http_server.hpp"
#include "runtime/observe/metrics.hpp"
#include "runtime/observe/node_trace.hpp"

namespace luxodus {

namespace limits {
/// Events that a node's trace keeps, the newest: 2 MiB of memory, 10 MB in the file.
inline constexpr size_t trace_events = 65'536;
}  // namespace limits

struct ObserveOptions {
  std::string address = "127.0.0.1";
  std::optional<uint16_t> metrics_port;  // 0: any free port; nothing: no page
  uint64_t trace_every = 0;              // interval of sampled particles; 0: none
  /// Further names that requests for the page may give.
  std::vector<std::string> allowed_hosts = {};
};

class Observation {
 public:
  /// Errors: the port is in use, or the address is not of this machine.
  static Result<std::unique_ptr<Observation>> start(const ObserveOptions& options);

  /// Port of the page; nothing if there is none.
  std::optional<uint16_t> port() const;

  /// Shows a node's numbers from now on, in place of an earlier node of that name, which must have
  /// ended. After the node ends its last published numbers stay.
  Metrics& show(std::unique_ptr<Metrics> node);

  std::string page() const;

  /// The node's trace; null if no particles are sampled. Its memory is allocated here, and kept
  /// when the node ends. A later node with this number starts a new trace.
  NodeTrace* trace_of(NodeId node);
  bool traces() const { return trace_every_ != 0; }
  /// Whether there is a page or a trace.
  bool watches() const { return server_ != nullptr || traces(); }
  /// Writes the traces of all nodes in Chrome's trace format, atomically; does nothing without
  /// traces. Requires: the nodes have ended. Errors: those of write_file_atomically.
  Result<void> write_trace(const std::filesystem::path& file) const;

 private:
  explicit Observation(uint64_t trace_every) : trace_every_(trace_every) {}

  mutable std::mutex mutex_;
  const uint64_t trace_every_;
  const SystemClock clock_;
  std::vector<std::unique_ptr<Metrics>> nodes_;
  std::vector<std::unique_ptr<NodeTrace>> traces_;
  std::unique_ptr<HttpServer> server_;
  std::jthread serving_;  // last member: ends before the data that it reads
};

/// Resident memory of this process, as the system counts it [bytes]; 0 if unknown.
uint64_t resident_bytes_of_process();

}  // namespace luxodus
