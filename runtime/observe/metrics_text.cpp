#include "runtime/observe/metrics_text.hpp"

#include <algorithm>
#include <charconv>

namespace luxodus {

namespace {

/// The rest of a line; parts are taken from its front.
class Rest {
 public:
  explicit Rest(std::string_view text) : text_(text) {}

  bool take(char c) {
    if (text_.empty() || text_.front() != c) return false;
    text_.remove_prefix(1);
    return true;
  }
  void skip_blanks() {
    while (take(' ')) {
    }
  }
  std::string_view name() {
    size_t end = 0;
    while (end < text_.size() && is_of_name(text_[end])) ++end;
    const std::string_view taken = text_.substr(0, end);
    text_.remove_prefix(end);
    return taken;
  }
  /// Takes the text up to the closing quote, and the quote; nothing if there is no quote.
  std::optional<std::string> quoted() {
    std::string value;
    while (!text_.empty()) {
      const char c = text_.front();
      text_.remove_prefix(1);
      if (c == '"') return value;
      if (c != '\\') {
        value += c;
        continue;
      }
      if (text_.empty()) return std::nullopt;
      value += text_.front() == 'n' ? '\n' : text_.front();
      text_.remove_prefix(1);
    }
    return std::nullopt;
  }
  std::optional<double> number() {
    double value = 0;
    const char* end = text_.data() + text_.size();
    const auto [at, error] = std::from_chars(text_.data(), end, value);
    if (error != std::errc() || (at != end && *at != ' ')) return std::nullopt;
    return value;
  }

 private:
  static bool is_of_name(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
  }
  std::string_view text_;
};

bool read_labels(Rest& rest, MetricSample& sample) {
  while (!rest.take('}')) {
    const std::string_view key = rest.name();
    if (key.empty() || !rest.take('=') || !rest.take('"')) return false;
    auto value = rest.quoted();
    if (!value) return false;
    sample.labels.emplace(key, std::move(*value));
    rest.take(',');
  }
  return true;
}

}  // namespace

std::string_view MetricSample::label(std::string_view key) const {
  const auto at = labels.find(key);
  return at == labels.end() ? std::string_view() : std::string_view(at->second);
}

std::optional<MetricSample> parse_metric(std::string_view line) {
  if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
  Rest rest(line);
  MetricSample sample;
  sample.name = rest.name();
  if (sample.name.empty()) return std::nullopt;
  if (rest.take('{') && !read_labels(rest, sample)) return std::nullopt;
  rest.skip_blanks();
  const auto value = rest.number();
  if (!value) return std::nullopt;
  sample.value = *value;
  return sample;
}

std::vector<MetricSample> parse_metrics(std::string_view page) {
  std::vector<MetricSample> samples;
  while (!page.empty() && samples.size() < limits::metric_samples) {
    const size_t end = std::min(page.find('\n'), page.size());
    if (auto sample = parse_metric(page.substr(0, end))) samples.push_back(std::move(*sample));
    page.remove_prefix(std::min(end + 1, page.size()));
  }
  return samples;
}

}  // namespace luxodus
