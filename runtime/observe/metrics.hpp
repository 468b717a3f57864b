// Metrics of a node. Counting means adding to a plain integer of the part that counts; this
// registry only knows where those integers are and what they mean. The node publishes them now and
// then by copying them under a lock that it only tries and never waits for; others read the copy.
// Registered at start; publishing allocates nothing. Thread rule: add_* and publish() on the node's
// thread, published() on any.
#pragma once

#include <cstdint>
#include <mutex>
#include <string>
#include <vector>

#include "runtime/observe/histogram.hpp"

namespace luxodus {

/// Describes a number. Its full name is luxodus_<name>[_<unit>], with _total for a counter, by
/// Prometheus' convention.
struct MetricInfo {
  std::string name;    // "fetches": lower case letters, digits, '_'
  std::string unit;    // "bytes", "seconds"; "" for plain counts
  std::string help;    // one sentence
  std::string labels;  // "hops=\"2\"", distinguishes entries of one name; mostly ""
};

class Metrics {
 public:
  /// `node` is the value of the label that distinguishes the nodes of a run.
  explicit Metrics(std::string node);

  const std::string& node() const { return node_; }

  /// A number that only grows. The reference must outlive this.
  void add_counter(MetricInfo info, const uint64_t& value);
  /// A number that goes up and down.
  void add_gauge(const MetricInfo& info, const uint64_t& value);
  /// Durations; shown in seconds, as quantiles, sum and count.
  void add_histogram(MetricInfo info, const Histogram& value);

  /// Copies the current numbers for readers. Returns false, and changes nothing, while someone
  /// reads.
  bool publish();

  /// The numbers published last by all `nodes`, in Prometheus' text format 0.0.4, grouped by name.
  /// Any thread.
  static std::string published(const std::vector<const Metrics*>& nodes);

 private:
  enum class Kind { counter, gauge, histogram };
  struct Entry {
    Kind kind;
    std::string full_name;
    std::string help;
    std::string labels;  // including the node's
    size_t index;        // in the list of its kind
  };
  struct Values {
    std::vector<uint64_t> numbers;
    std::vector<Histogram> histograms;
  };

  void add(Kind kind, const MetricInfo& info, size_t index);
  static void write(std::string& out, const Entry& entry, const Values& values);

  std::string node_;
  std::vector<Entry> entries_;
  std::vector<const uint64_t*> numbers_;
  std::vector<const Histogram*> histograms_;
  mutable std::mutex published_mutex_;
  Values published_;
};

}  // namespace luxodus
