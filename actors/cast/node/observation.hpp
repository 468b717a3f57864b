// What people can see of one process: the numbers of all its nodes as one page over HTTP. A node
// registers its numbers when it starts and publishes copies of them now and then; whoever reads
// the page reads the copies, so no node ever waits for a reader, and no reader touches a node.
// Thread rule: start() and the end on one thread; show() and page() on any.
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
/// Events that a node's trace keeps, the last ones: 2 MiB of memory, 10 MB of the file.
inline constexpr size_t trace_events = 65'536;
}  // namespace limits

struct ObserveOptions {
  std::string address = "127.0.0.1";
  std::optional<uint16_t> metrics_port;  // 0: any that is free; nothing: no page
  uint64_t trace_every = 0;              // particles of which one is traced; 0: none
  /// Names under which the page may be asked for, beside the address.
  std::vector<std::string> allowed_hosts = {};
};

class Observation {
 public:
  /// Errors: the port is taken, or the address is none of this machine.
  static Result<std::unique_ptr<Observation>> start(const ObserveOptions& options);

  /// Where the page is served; nothing where it is not.
  std::optional<uint16_t> port() const;

  /// Shows a node's numbers from now on, in place of those of an earlier node of that name, which
  /// must have ended. They stay as they were published last when the node ends.
  Metrics& show(std::unique_ptr<Metrics> node);

  std::string page() const;

  /// Where a node tells what becomes of sampled particles; null where none are sampled. Its memory
  /// is taken here, and kept when the node ends. A later node of that number begins anew.
  NodeTrace* trace_of(NodeId node);
  bool traces() const { return trace_every_ != 0; }
  /// Whether nodes have anything to tell it.
  bool watches() const { return server_ != nullptr || traces(); }
  /// Writes what all nodes have told as Chrome's trace format, whole or not at all; nothing where
  /// nothing is traced. Requires: the nodes have ended. Errors: as write_file_atomically.
  Result<void> write_trace(const std::filesystem::path& file) const;

 private:
  explicit Observation(uint64_t trace_every) : trace_every_(trace_every) {}

  mutable std::mutex mutex_;
  const uint64_t trace_every_;
  const SystemClock clock_;
  std::vector<std::unique_ptr<Metrics>> nodes_;
  std::vector<std::unique_ptr<NodeTrace>> traces_;
  std::unique_ptr<HttpServer> server_;
  std::jthread serving_;  // the last: it ends before what it reads
};

/// Memory of this process that is resident, as the system counts it [bytes]; 0 where it does not.
uint64_t resident_bytes_of_process();

}  // namespace luxodus
