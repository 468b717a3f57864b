// Parses exchange files of ISO 10303-21 ("STEP physical files"), the format of IFC models: the type
// of each instance, and its parameters. The whole text is kept, and an instance is parsed on
// request: a model of 44 MB has 629 291 of them, most of which are points. Damage is a fault with
// its line, and reading goes on after it. Immutable once read; any thread.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "runtime/core/result.hpp"

namespace luxodus {

class ReadingShare;

namespace limits {
/// Size of a model [bytes]; the largest public ones have about 400 MB.
inline constexpr uint64_t step_bytes = uint64_t{1} << 30;
inline constexpr size_t step_instances = 30'000'000;
/// Nested brackets of one instance: the schemas of IFC nest four deep.
inline constexpr int step_nesting = 16;
/// Faults that are kept.
inline constexpr size_t step_faults = 100;
}  // namespace limits

/// A parameter of an instance.
struct StepValue {
  enum class Kind { omitted, derived, number, text, word, reference, list };
  Kind kind = Kind::omitted;
  double number = 0;  // number
  uint64_t id = 0;    // reference
  std::string text;   // text as UTF-8; word: ".MILLI." without dots; list: its type, or ""
  std::vector<StepValue> items;  // list; a typed value is a list of one, with its type
};

class StepFile {
 public:
  /// Parses the bytes of a file; `reading`, where given, receives the progress.
  /// Errors: not a STEP file, or larger than the limits.
  static Result<StepFile> of(std::string bytes, const std::string& file,
                             ReadingShare* reading = nullptr);

  struct Instance {
    uint64_t id = 0;
    std::string_view type;  // "IFCWALL"; "" of instances of several types
    std::string_view body;  // the text in the brackets
  };
  /// In file order; where two have the same number, the first.
  const std::vector<Instance>& instances() const { return instances_; }
  /// Null where there is none.
  const Instance* find(uint64_t id) const;
  /// The parameters of an instance; fewer if they are damaged.
  std::vector<StepValue> parameters(const Instance& instance) const;

  const std::string& text() const { return *text_; }
  /// "IFC2X3", "IFC4", ... in capitals; "" where the file states none.
  const std::string& schema() const { return schema_; }
  const std::vector<Problem>& faults() const { return faults_; }
  size_t fault_count() const { return fault_count_; }

 private:
  void index(const std::string& file, ReadingShare* reading);
  void fault(const std::string& file, size_t at, std::string what);

  std::unique_ptr<const std::string> text_;  // on the heap: views into it outlive a move
  std::vector<Instance> instances_;
  std::unordered_map<uint64_t, uint32_t> by_id_;
  std::string schema_;
  std::vector<Problem> faults_;
  size_t fault_count_ = 0;
};

/// A text of the file as UTF-8: doubled quotes, \X\, \X2\, \X4\ and \S\ of ISO 10303-21 are
/// resolved; bytes that are not UTF-8 are read as Latin-1.
std::string step_text(std::string_view written);

}  // namespace luxodus
