#include "actors/judge/assess/threshold_words.hpp"

#include <fmt/format.h>

#include "actors/judge/texts/texts.hpp"

namespace luxodus {

namespace {

const char* heading_of(Sought sought) {
  switch (sought) {
    case Sought::extinction:
      return "extinction, as a factor on all smoke";
    case Sought::distance:
      return "distance along the route [m]";
    case Sought::luminance:
      return "luminance, as a factor on that of all signs";
    case Sought::size:
      return "size, as a factor on the edges of all signs";
    case Sought::height:
      return "height of the sign's centre above the floor [m]";
  }
  return "";
}

/// "at least 0.4 to 1.9 (in 9), always (in 2), never (in 3)".
std::string range_words(const ThresholdRange& range) {
  std::vector<std::string> parts;
  const std::string low = fmt::format("{:.3g}", range.low),
                    high = fmt::format("{:.3g}", range.high);
  if (range.found > 0)
    parts.push_back(fmt::format("{} {} (in {})", range.above ? "at least" : "at most",
                                low == high ? low : low + " to " + high, range.found));
  for (const auto& [count, word] : {std::pair{range.always, "always"},
                                    {range.never, "never"},
                                    {range.not_assessed, "not assessed"}})
    if (count > 0) parts.push_back(fmt::format("{} (in {})", word, count));
  return fmt::format("{}", fmt::join(parts, ", "));
}

}  // namespace

CsvTable thresholds_csv(const std::vector<ThresholdRecord>& thresholds) {
  CsvTable table({"sought", "from", "along.value", "eye_height.value", "sign", "eyes", "limit",
                  "end", "value", "standard_error", "unit", "holds", "amounts_to.value",
                  "amounts_to.unit"});
  for (const ThresholdRecord& one : thresholds) {
    const bool found = one.end == ThresholdEnd::found;
    std::optional<double> value, error, amount;
    std::optional<std::string> holds, unit;
    if (found) {
      value = one.at.value;
      error = one.at.error;
      holds = one.above ? "above" : "below";
    }
    if (one.amounts_to) {
      amount = one.amounts_to->value;
      unit = one.amounts_to->unit;
    }
    table.row(name_of(one.sought), english().subject(one.from), one.along_m, one.eye_height_m,
              one.sign, one.eyes, one.read ? "read" : "seen", name_of(one.end), value, error,
              one.unit(), holds, amount, unit);
  }
  return table;
}

std::string thresholds_text(const std::vector<ThresholdRecord>& thresholds) {
  std::string out;
  std::optional<Sought> last;
  for (const ThresholdRange& range : ranges_of(thresholds)) {
    if (last != range.sought)
      out += fmt::format("thresholds: {}; in brackets the number of views\n",
                         heading_of(range.sought));
    last = range.sought;
    out += fmt::format("  sign \"{}\" {}: {}\n", range.sign, range.read ? "read" : "seen",
                       range_words(range));
  }
  return out;
}

}  // namespace luxodus
