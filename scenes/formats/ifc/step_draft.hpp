// An exchange file of ISO 10303-21 that is changed: instances are replaced and added as text, and
// the whole is written again. Comments between instances, and statements that could not be read,
// are not written. Holds a reference to the file, which it does not change; one thread.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "scenes/formats/ifc/step_file.hpp"

namespace luxodus {

namespace limits {
/// Text that may be added to a model, as a multiple of its size, and in any case [bytes].
inline constexpr uint64_t draft_growth = 4;
inline constexpr uint64_t draft_bytes = uint64_t{64} << 20;
}  // namespace limits

class StepDraft {
 public:
  explicit StepDraft(const StepFile& file);

  /// As it is now; empty where there is none.
  std::string_view type(uint64_t id) const;
  std::string_view body(uint64_t id) const;
  /// Texts of the parameters, without the white space around them.
  std::vector<std::string_view> parameters(uint64_t id) const;
  /// The same as copies, to be changed and joined again.
  std::vector<std::string> copied_parameters(uint64_t id) const;

  void replace(uint64_t id, std::string type, std::string body);
  /// Adds an instance; returns its number, or 0 if the draft would become too large.
  uint64_t add(std::string type, std::string body);
  /// Whether an instance was refused: the draft is then incomplete.
  bool is_full() const { return is_full_; }

  /// The whole file.
  std::string text() const;

 private:
  struct Instance {
    std::string type, body;
  };

  const StepFile& file_;
  std::unordered_map<uint64_t, Instance> changed_;
  std::vector<uint64_t> added_;
  uint64_t next_ = 1, added_bytes_ = 0, most_bytes_ = 0;
  bool is_full_ = false;
};

/// The parameters of a statement's text, split at its commas.
std::vector<std::string_view> split_parameters(std::string_view body);

/// Parameters joined to a statement's text.
std::string joined_parameters(const std::vector<std::string>& parameters);

}  // namespace luxodus
