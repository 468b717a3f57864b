// Parses pages of metrics as metrics.hpp writes them, in Prometheus' text format 0.0.4. A page
// comes from another machine and is not trusted: lines that are no valid samples are skipped. Plain
// values; any thread.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace luxodus {

namespace limits {
/// Most samples of one page: a node has about 150 plus 10 for each link, a process at most 64
/// nodes.
inline constexpr size_t metric_samples = 200'000;
}  // namespace limits

struct MetricSample {
  std::string name;
  std::map<std::string, std::string, std::less<>> labels;
  double value = 0;

  /// The label's value; "" if it has none.
  std::string_view label(std::string_view key) const;
};

/// Parses one line; nothing for a comment, a blank line, or an invalid sample.
std::optional<MetricSample> parse_metric(std::string_view line);

/// All samples of a page, up to the limit.
std::vector<MetricSample> parse_metrics(std::string_view page);

}  // namespace luxodus
