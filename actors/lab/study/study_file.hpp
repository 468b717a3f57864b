// What a study asks, as its file says it: a scene, what is varied, what is drawn. Every problem of
// a file is reported with its line; a study comes out only where there is none. It reads that file
// and no other. Plain values; any thread.
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

/// A key of `[sweep]` and its values, words or numbers.
struct StudyAxis {
  std::string key;
  std::vector<std::string> words;
  std::vector<double> numbers;

  bool of_words() const { return !words.empty(); }
  size_t size() const { return of_words() ? words.size() : numbers.size(); }
  /// A value as people write it.
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

/// A combination: by axis, the number of its value.
struct StudyPoint {
  std::vector<size_t> values;
};

/// Of the words of `on`: whether nodes run by the clock on the wall.
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
  /// Those with more than one value.
  std::vector<const StudyAxis*> varied() const;
  /// All combinations; the last axis runs fastest.
  std::vector<StudyPoint> points() const;
};

/// Either a study, with warnings that do not hinder, or problems.
struct ReadStudy {
  std::optional<Study> study;
  Problems problems;
  std::vector<Problem> warnings;
};

ReadStudy read_study(const std::filesystem::path& file);
/// The same of a text; `file` is named in problems, and paths are relative to its folder.
ReadStudy parse_study(std::string_view text, const std::filesystem::path& file);

/// Costs as they were measured, and on what.
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
/// The text of a file that read_costs() reads to the same costs.
std::string costs_text(const MeasuredCosts& measured);

}  // namespace luxodus
