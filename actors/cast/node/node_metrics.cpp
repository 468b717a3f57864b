#include "actors/cast/node/node_metrics.hpp"

#include <fmt/core.h>

#include <cmath>

namespace luxodus {

namespace {
/// Often enough for a person; a copy takes microseconds.
constexpr Nanoseconds publish_every = milliseconds(250);
/// A batch ends every few tenths of a second; over a shorter span the rate would fluctuate.
constexpr Nanoseconds rate_span = seconds(1);
}  // namespace

NodeMetrics::NodeMetrics(const std::vector<std::string>& names, NodeId self,
                         const std::string& role, NodeShell& shell)
    : scheduler_(shell.scheduler()),
      registered_(std::make_unique<Metrics>(names[self.value])),
      mark_(scheduler_.clock().now()) {
  registry().add_gauge({"node_info", "", "1; what the node is.",
                        fmt::format("role=\"{}\",number=\"{}\"", role, self.value)},
                       info_);
  scheduler_.add_metrics(registry());
  shell.network().add_metrics(registry(), [&](NodeId node) { return names[node.value]; });
  shell.actors().add_metrics(registry());
  shell.supervisor().add_metrics(registry());
  add_sample([&shell] {
    shell.network().sample();
    shell.actors().sample();
  });
}

void NodeMetrics::add_rate(const MetricInfo& info, const uint64_t& counter) {
  registry().add_gauge(info, rates_.emplace_back(Rate{counter, counter, 0}).per_second);
}

void NodeMetrics::start(Observation& seen) {
  shown_ = &seen.show(std::move(registered_));
  publish();
}

void NodeMetrics::publish() {
  const Nanoseconds now = scheduler_.clock().now();
  for (const auto& sample : samples_) sample();
  renew_rates(now);
  shown_->publish();  // if a reader holds the lock: next time
  scheduler_.timers().set(now + publish_every, [this] { publish(); });
}

void NodeMetrics::renew_rates(Nanoseconds now) {
  if (now - mark_ < rate_span) return;
  const double passed_s = static_cast<double>(now - mark_) * 1e-9;
  for (Rate& rate : rates_) {
    const double grown = static_cast<double>(rate.counter - rate.at_mark);
    rate.per_second = static_cast<uint64_t>(std::llround(grown / passed_s));
    rate.at_mark = rate.counter;
  }
  mark_ = now;
}

}  // namespace luxodus
