// Thresholds of sight as `luxodus assess --find` finds them and the record of an assessment holds
// them. Plain values; any thread.
#pragma once

#include <array>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "actors/judge/record/inputs_record.hpp"
#include "actors/judge/record/record_forms.hpp"

namespace luxodus {

/// What is varied until a sign is just read, or just seen.
enum class Sought { extinction, distance, luminance, size, height };
inline constexpr std::array<std::string_view, 5> sought_words{"extinction", "distance", "luminance",
                                                              "size", "height"};
const char* name_of(Sought sought);
template <>
inline constexpr size_t names_of<Sought> = sought_words.size();

/// How the search of a threshold ended.
enum class ThresholdEnd {
  found,
  everywhere,   // read, or seen, at all values that were tried
  nowhere,      // at none of them
  not_assessed  // light does not decide: the sign is hidden, or the quantity is not the sign's
};
inline constexpr std::array<std::string_view, 4> threshold_ends{"found", "always", "never",
                                                                "not assessed"};
const char* name_of(ThresholdEnd end);
template <>
inline constexpr size_t names_of<ThresholdEnd> = threshold_ends.size();

/// The value of a threshold; NaN if there is none.
struct ThresholdValue {
  double value = std::numeric_limits<double>::quiet_NaN();
  double error = std::numeric_limits<double>::quiet_NaN();  // standard error
  static constexpr void fields(auto&& field, auto& m) {
    field("value", m.value, {.or_null = true});
    field("standard_error", m.error, {.or_null = true});
  }
};

/// A value at which a sign begins or ends to be read, or seen, by one eye. Extinction, luminance
/// and size are factors on those of the scene; distance is along the route; height is that of the
/// face's centre above the floor.
struct ThresholdRecord {
  Sought sought = Sought::extinction;
  Subject from;  // a route, an open area or an observer
  double along_m = 0, eye_height_m = 0;
  std::string sign;
  std::string eyes;   // as the scene names other eyes; "" of those of the stated age
  bool read = false;  // the smallest detail is read; else the face is seen
  ThresholdEnd end = ThresholdEnd::not_assessed;
  ThresholdValue at;   // in unit()
  bool above = false;  // read, or seen, at larger values; else at smaller ones
  /// What the value is of this sign: mean extinction of the line [1/m], distance from eye to sign
  /// [m], luminance of the legend [cd/m2], smallest detail [mm].
  std::optional<QuantityRecord> amounts_to;

  const char* unit() const;
  static constexpr void fields(auto&& field, auto& m) {
    field("sought", m.sought)("from", m.from);
    field("along", m.along_m, {.unit = "m"});
    field("eye_height", m.eye_height_m, {.unit = "m"});
    field("sign", m.sign)("eyes", m.eyes);
    field("limit", either(m.read, "read", "seen"))("end", m.end);
    field(in_place, m.at);
    field("unit", derived([&m] { return std::string(m.unit()); }));
    field("holds", either(m.above, "above", "below"));
    field("amounts_to", m.amounts_to, {.or_null = true});
  }
};

/// The thresholds of all views of a sign, by the eyes of the stated age.
struct ThresholdRange {
  Sought sought = Sought::extinction;
  std::string sign;
  bool read = false;
  double low = 0, high = 0;  // of those that were found
  bool above = false;        // of the first that was found
  size_t found = 0, always = 0, never = 0, not_assessed = 0;
};

/// By quantity, sign and limit, in the order of the records.
std::vector<ThresholdRange> ranges_of(const std::vector<ThresholdRecord>& thresholds);

}  // namespace luxodus
