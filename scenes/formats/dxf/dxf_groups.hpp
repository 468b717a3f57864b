// The text of a DXF drawing as groups of a code and a value, and groups as records: what begins
// with code 0. Neither copies the text. Plain values; one thread per object.
#pragma once

#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

#include "runtime/core/result.hpp"

namespace luxodus {

namespace limits {
/// Groups of one record. Longer ones are cut; none that is read as walls is so long.
inline constexpr size_t dxf_record_groups = 4'000'000;
}  // namespace limits

struct DxfGroup {
  int code = 0;
  std::string_view value;  // without blanks at its ends
  int line = 0;            // of the value
};

/// A record: "LINE", "LAYER", "SECTION" with the groups up to the next one.
struct DxfRecord {
  std::string_view kind;
  int line = 0;
  std::vector<DxfGroup> groups;
  bool cut = false;  // it has more groups than the limit

  /// The first group of this code; null where there is none.
  const DxfGroup* find(int code) const;
  /// The text of the first group of this code; "" where there is none.
  std::string_view text(int code) const;
};

class DxfRecords {
 public:
  /// Requires: a text that outlives this.
  explicit DxfRecords(std::string_view text) : text_(text) {}

  /// The next record; false at the end of the text, and where `fault` is set.
  bool next(DxfRecord& record);

  /// A line that should be a code and is none.
  const std::optional<Problem>& fault() const { return fault_; }
  /// Bytes read so far.
  size_t at() const { return at_; }

 private:
  bool next_group(DxfGroup& group);
  std::string_view take_line();

  std::string_view text_;
  size_t at_ = 0;
  int line_ = 0;
  std::optional<DxfGroup> begun_;  // the code 0 that ended the record before
  std::optional<Problem> fault_;
};

/// The number of a group. Errors: what is no finite number, with its line.
Result<double> number_of(const DxfGroup& group);
/// The whole number of a group. Errors: as number_of, or a fraction.
Result<int> integer_of(const DxfGroup& group);

}  // namespace luxodus
