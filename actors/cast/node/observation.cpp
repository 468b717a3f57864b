#include "actors/cast/node/observation.hpp"

#include <fmt/core.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>

namespace luxodus {

Result<std::unique_ptr<Observation>> Observation::start(const ObserveOptions& options) {
  std::unique_ptr<Observation> seen(new Observation(options.trace_every));
  if (!options.metrics_port) return seen;
  HttpSite site;
  site.page = [page_of = seen.get()](std::string_view path) -> std::optional<HttpPage> {
    if (path != "/metrics") return std::nullopt;
    return HttpPage{page_of->page(), "text/plain; version=0.0.4; charset=utf-8"};
  };
  auto server = HttpServer::listen(
      {options.address, *options.metrics_port, "", options.allowed_hosts}, std::move(site));
  if (!server)
    return problem("no metrics can be served: " + server.problem().what, server.problem().kind);
  seen->server_ = std::move(server).value();
  seen->serving_ = std::jthread([&serving = *seen->server_](std::stop_token end) {
    const std::stop_callback at_the_end(std::move(end), [&serving] { serving.stop(); });
    serving.run();
  });
  return seen;
}

std::optional<uint16_t> Observation::port() const {
  return server_ ? std::optional(server_->port()) : std::nullopt;
}

Metrics& Observation::show(std::unique_ptr<Metrics> node) {
  const std::lock_guard lock(mutex_);
  const auto before = std::find_if(nodes_.begin(), nodes_.end(), [&](const auto& other) {
    return other->node() == node->node();
  });
  if (before == nodes_.end()) return *nodes_.emplace_back(std::move(node));
  *before = std::move(node);
  return **before;
}

std::string Observation::page() const {
  std::string text;
  {
    const std::lock_guard lock(mutex_);
    std::vector<const Metrics*> nodes;
    for (const auto& node : nodes_) nodes.push_back(node.get());
    text = Metrics::published(nodes);
  }
  return text + fmt::format(
                    "# HELP luxodus_process_resident_bytes Memory of the process that is "
                    "resident.\n"
                    "# TYPE luxodus_process_resident_bytes gauge\n"
                    "luxodus_process_resident_bytes {}\n",
                    resident_bytes_of_process());
}

NodeTrace* Observation::trace_of(NodeId node) {
  if (trace_every_ == 0) return nullptr;
  auto trace = std::make_unique<NodeTrace>(node, limits::trace_events, trace_every_, clock_);
  const std::lock_guard lock(mutex_);
  const auto before = std::find_if(traces_.begin(), traces_.end(),
                                   [&](const auto& other) { return other->node() == node; });
  if (before == traces_.end()) return traces_.emplace_back(std::move(trace)).get();
  *before = std::move(trace);
  return before->get();
}

Result<void> Observation::write_trace(const std::filesystem::path& file) const {
  if (trace_every_ == 0) return {};
  const std::lock_guard lock(mutex_);
  std::vector<TraceTrack> tracks;
  for (const auto& trace : traces_) tracks.push_back({trace->node(), trace->ring().kept()});
  return write_file_atomically(file, chrome_trace(tracks, trace_kind_names()));
}

uint64_t resident_bytes_of_process() {
  std::ifstream statm("/proc/self/statm");  // proc(5): size and resident, in pages
  uint64_t mapped = 0, resident = 0;
  if (!(statm >> mapped >> resident)) return 0;
  return resident * static_cast<uint64_t>(::sysconf(_SC_PAGESIZE));
}

}  // namespace luxodus
