// Rows of a trajectory file, checked one by one, become the people of Trajectories. One thread.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "scenes/formats/trajectories/trajectories.hpp"

namespace luxodus {

/// One person at one time.
struct TrajectoryRow {
  int64_t id = 0;
  double time_s = 0;
  glm::dvec3 place{0};
  glm::dvec2 facing{0};  // any length; 0: not given
};
static_assert(sizeof(TrajectoryRow) == 56);  // limits::trajectory_rows

class TrajectoryRows {
 public:
  /// The order of rows in a file. Tables of databases have none; the lines of a file have one, and
  /// a time that goes back is then a mistake.
  enum class Order { any, ascending };
  TrajectoryRows(std::string file, Order order) : file_(std::move(file)), order_(order) {}

  /// `line`: of the file, 0 where it has none. Errors: values that are no numbers or beyond the
  /// limits; too many rows.
  Result<void> add(const TrajectoryRow& row, int line);
  /// Errors: as read_trajectories, of people and times. `out`: has all but the people.
  Result<Trajectories> people_of(Trajectories out);

 private:
  Result<void> sort();

  std::string file_;
  Order order_;
  std::vector<TrajectoryRow> rows_;
  std::vector<int> lines_;  // of the rows; empty where the file has no lines
};

/// A rate of frames within the limits [1/s]. Errors: any other.
Result<double> checked_fps(double fps, const std::string& file, int line = 0);

/// A finite decimal number that fills the whole text.
std::optional<double> decimal_of(std::string_view text);
/// A whole number that fills the whole text.
std::optional<int64_t> whole_of(std::string_view text);

// The readers of the single forms. `file` names the content in messages.
Result<Trajectories> sqlite_trajectories(std::string_view bytes, const std::string& file);
Result<Trajectories> hdf5_trajectories(const std::string& file);
Result<Trajectories> text_trajectories(std::string_view bytes, const std::string& file);
Result<Trajectories> pathfinder_csv_trajectories(std::string_view bytes, const std::string& file);
Result<Trajectories> pathfinder_json_trajectories(std::string_view bytes, const std::string& file);

}  // namespace luxodus
