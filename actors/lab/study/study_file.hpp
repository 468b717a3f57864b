// A study as its file describes it: a scene, the varied parameters, the plots. Every problem of a
// file is reported with its line; a study is returned only if there is none. It reads no other
// file. Plain values; any thread.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "actors/lab/simulate/sim_costs.hpp"
#include "runtime/core/result.hpp"

namespace luxodus {

namespace limits {
inline constexpr size_t study_file_bytes = size_t{1} << 20;
inline constexpr size_t study_values = 64;  // of one axis
inline constexpr size_t study_plots = 16;
inline constexpr size_t study_runs = 10'000;  // points x seeds
}  // namespace limits

/// A key of `[sweep]` with its values: words or numbers.
struct StudyAxis {
  std::string key;
  std::vector<std::string> words;
  std::vector<double> numbers;

  bool of_words() const { return !words.empty(); }
  size_t size() const { return of_words() ? words.size() : numbers.size(); }
  /// A value as text.
  std::string text(size_t value) const;
};

struct StudyPlot {
  std::string name;
  std::string title;
  std::string x;  // a key of the sweep
  std::string y;  // a column of results
  bool log_x = false;
  bool log_y = false;
  std::string explain;
};

/// A combination of parameters: the index of the value on each axis.
struct StudyPoint {
  std::vector<size_t> values;
};

/// Whether this word of `on` means real nodes and wall-clock time.
inline bool is_real(std::string_view on) {
  return on == "nodes" || on == "processes";
}

struct Study {
  std::filesystem::path file;
  std::string title;
  std::string question;
  std::filesystem::path scene;
  std::string scenario;
  bool whole_tally = false;
  std::filesystem::path costs;
  int seeds = 3;
  uint64_t first_seed = 1;
  uint32_t cores = 0;
  Nanoseconds jitter = 0;
  Nanoseconds crash_for = 0;
  std::vector<StudyAxis> axes;  // all keys of the sweep, in the schema's order
  std::vector<StudyPlot> plots;

  const StudyAxis& axis(std::string_view key) const;
  double number(const StudyPoint& point, std::string_view key) const;
  int64_t whole(const StudyPoint& point, std::string_view key) const;
  const std::string& word(const StudyPoint& point, std::string_view key) const;
  /// Axes with more than one value.
  std::vector<const StudyAxis*> varied() const;
  /// All combinations; the last axis runs fastest.
  std::vector<StudyPoint> points() const;
};

/// A study, possibly with warnings, or problems.
struct ReadStudy {
  std::optional<Study> study;
  Problems problems;
  std::vector<Problem> warnings;
};

ReadStudy read_study(const std::filesystem::path& file);
/// Parses a text; problems name `file`, and paths are relative to its folder.
ReadStudy parse_study(std::string_view text, const std::filesystem::path& file);

/// Measured costs, and the machine and scene.
struct MeasuredCosts {
  SimCosts costs;
  std::string machine;
  std::string scene;
};

struct ReadCosts {
  std::optional<MeasuredCosts> measured;
  Problems problems;
};

ReadCosts read_costs(const std::filesystem::path& file);
/// A text that read_costs() reads back to the same costs.
std::string costs_text(const MeasuredCosts& measured);

}  // namespace luxodus
