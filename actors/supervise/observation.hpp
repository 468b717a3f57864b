// What people can see of one process: the numbers of all its nodes as one page over HTTP. A node
// registers its numbers when it starts and publishes copies of them now and then; whoever reads
// the page reads the copies, so no node ever waits for a reader, and no reader touches a node.
// Thread rule: start() and the end on one thread; show() and page() on any.
#pragma once

#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "runtime/observe/metrics.hpp"
#include "runtime/observe/metrics_server.hpp"

namespace luxodus {

struct ObserveOptions {
  std::string address = "127.0.0.1";
  std::optional<uint16_t> metrics_port;  // 0: any that is free; nothing: no page
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

 private:
  Observation() = default;

  mutable std::mutex mutex_;
  std::vector<std::unique_ptr<Metrics>> nodes_;
  std::unique_ptr<MetricsServer> server_;  // the last: it ends before what it reads
};

/// Memory of this process that is resident, as the system counts it [bytes]; 0 where it does not.
uint64_t resident_bytes_of_process();

}  // namespace luxodus
