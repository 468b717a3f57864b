#include "actors/judge/record/threshold_record.hpp"

#include <algorithm>

namespace luxodus {

const char* name_of(Sought sought) {
  return sought_words[static_cast<size_t>(sought)].data();
}

const char* name_of(ThresholdEnd end) {
  return threshold_ends[static_cast<size_t>(end)].data();
}

const char* ThresholdRecord::unit() const {
  return sought == Sought::distance || sought == Sought::height ? "m" : "1";
}

std::vector<ThresholdRange> ranges_of(const std::vector<ThresholdRecord>& thresholds) {
  std::vector<ThresholdRange> out;
  for (const ThresholdRecord& one : thresholds) {
    if (!one.eyes.empty()) continue;
    auto at = std::find_if(out.begin(), out.end(), [&](const ThresholdRange& range) {
      return range.sought == one.sought && range.sign == one.sign && range.read == one.read;
    });
    if (at == out.end())
      at = out.insert(at, {.sought = one.sought, .sign = one.sign, .read = one.read});
    switch (one.end) {
      case ThresholdEnd::found:
        at->low = at->found == 0 ? one.at.value : std::min(at->low, one.at.value);
        at->high = std::max(at->high, one.at.value);
        if (at->found++ == 0) at->above = one.above;
        break;
      case ThresholdEnd::everywhere:
        ++at->always;
        break;
      case ThresholdEnd::nowhere:
        ++at->never;
        break;
      case ThresholdEnd::not_assessed:
        ++at->not_assessed;
        break;
    }
  }
  return out;
}

}  // namespace luxodus
