#include "runtime/observe/metrics.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <map>
#include <string_view>

#include "runtime/core/check.hpp"

namespace luxodus {

namespace {

bool is_name(std::string_view text) {
  const auto plain = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_';
  };
  return !text.empty() && std::all_of(text.begin(), text.end(), plain);
}

/// Escapes text for quotes and HELP lines of the text format.
std::string escaped(std::string_view text) {
  std::string out;
  for (const char c : text) {
    if (c == '\\' || c == '"') out += '\\';
    if (c == '\n')
      out += "\\n";
    else
      out += c;
  }
  return out;
}

double to_seconds(Nanoseconds t) {
  return static_cast<double>(t) * 1e-9;
}

}  // namespace

Metrics::Metrics(std::string node) : node_(std::move(node)) {}

void Metrics::add_counter(MetricInfo info, const uint64_t& value) {
  info.unit += info.unit.empty() ? "total" : "_total";
  add(Kind::counter, info, numbers_.size());
  numbers_.push_back(&value);
  published_.numbers.push_back(0);
}

void Metrics::add_gauge(const MetricInfo& info, const uint64_t& value) {
  add(Kind::gauge, info, numbers_.size());
  numbers_.push_back(&value);
  published_.numbers.push_back(0);
}

void Metrics::add_histogram(MetricInfo info, const Histogram& value) {
  info.unit = "seconds";
  add(Kind::histogram, info, histograms_.size());
  histograms_.push_back(&value);
  published_.histograms.emplace_back();
}

void Metrics::add(Kind kind, const MetricInfo& info, size_t index) {
  LUX_CHECK(is_name(info.name) && (info.unit.empty() || is_name(info.unit)),
            "a metric's name and unit are small letters, digits and '_'");
  Entry entry{kind, "luxodus_" + info.name, info.help, "", index};
  if (!info.unit.empty()) entry.full_name += "_" + info.unit;
  entry.labels = fmt::format("node=\"{}\"", escaped(node_));
  if (!info.labels.empty()) entry.labels += "," + info.labels;
  LUX_CHECK(std::none_of(entries_.begin(), entries_.end(),
                         [&](const Entry& other) {
                           return other.full_name == entry.full_name &&
                                  (other.labels == entry.labels || other.kind != entry.kind);
                         }),
            "two metrics of one name and label, or of one name and two kinds");
  entries_.push_back(std::move(entry));
}

bool Metrics::publish() {
  const std::unique_lock lock(published_mutex_, std::try_to_lock);
  if (!lock.owns_lock()) return false;
  for (size_t i = 0; i < numbers_.size(); ++i) published_.numbers[i] = *numbers_[i];
  for (size_t i = 0; i < histograms_.size(); ++i) published_.histograms[i] = *histograms_[i];
  return true;
}

void Metrics::write(std::string& out, const Entry& entry, const Values& values) {
  if (entry.kind != Kind::histogram) {
    out += fmt::format("{}{{{}}} {}\n", entry.full_name, entry.labels, values.numbers[entry.index]);
    return;
  }
  const Histogram& histogram = values.histograms[entry.index];
  for (const char* quantile : {"0.5", "0.9", "0.99", "0.999", "0.9999"})
    out += fmt::format("{}{{{},quantile=\"{}\"}} {}\n", entry.full_name, entry.labels, quantile,
                       to_seconds(histogram.at(std::stod(quantile))));
  out +=
      fmt::format("{}_sum{{{}}} {}\n", entry.full_name, entry.labels, to_seconds(histogram.sum()));
  out += fmt::format("{}_count{{{}}} {}\n", entry.full_name, entry.labels, histogram.count());
}

std::string Metrics::published(const std::vector<const Metrics*>& nodes) {
  constexpr std::array<const char*, 3> type_names{"counter", "gauge", "summary"};
  std::map<std::string, std::string> families;  // by name: its lines
  for (const Metrics* node : nodes) {
    Values values;
    {
      const std::lock_guard lock(node->published_mutex_);
      values = node->published_;
    }
    for (const Entry& entry : node->entries_) {
      std::string& lines = families[entry.full_name];
      if (lines.empty())
        lines = fmt::format("# HELP {} {}\n# TYPE {} {}\n", entry.full_name, escaped(entry.help),
                            entry.full_name, type_names[static_cast<size_t>(entry.kind)]);
      write(lines, entry, values);
    }
  }
  std::string out;
  for (const auto& [name, lines] : families) out += lines;
  return out;
}

}  // namespace luxodus
