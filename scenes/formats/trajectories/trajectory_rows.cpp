#include "scenes/formats/trajectories/trajectory_rows.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numeric>
#include <unordered_map>

namespace luxodus {

Result<void> TrajectoryRows::add(const TrajectoryRow& row, int line) {
  const auto bad = [&](std::string what) {
    return problem_in(file_, line, fmt::format("person {}: {}", row.id, what));
  };
  if (rows_.size() >= limits::trajectory_rows)
    return problem_in(file_, line,
                      fmt::format("the file has more than {} places of people: write fewer frames "
                                  "per second",
                                  limits::trajectory_rows));
  if (!(std::abs(row.time_s) <= limits::trajectory_s))
    return bad(
        fmt::format("the time {} s is no time within {:g} s", row.time_s, limits::trajectory_s));
  for (int axis = 0; axis < 3; ++axis)
    if (!(std::abs(row.place[axis]) <= limits::trajectory_m))
      return bad(fmt::format("{} = {} m at {} s is no coordinate within {:g} m", "xyz"[axis],
                             row.place[axis], row.time_s, limits::trajectory_m));
  if (!std::isfinite(row.facing.x) || !std::isfinite(row.facing.y))
    return bad(fmt::format("the orientation at {} s is no direction", row.time_s));
  rows_.push_back(row);
  if (line > 0) lines_.push_back(line);
  return {};
}

/// Orders the rows by person, and each person's by time.
Result<void> TrajectoryRows::sort() {
  if (order_ == Order::ascending) {
    std::unordered_map<int64_t, double> last;
    for (size_t i = 0; i < rows_.size(); ++i) {
      const auto [at, first] = last.try_emplace(rows_[i].id, rows_[i].time_s);
      if (!first && rows_[i].time_s < at->second)
        return problem_in(file_, i < lines_.size() ? lines_[i] : 0,
                          fmt::format("person {}: the time goes back from {} s to {} s: the rows "
                                      "of a person have to ascend",
                                      rows_[i].id, at->second, rows_[i].time_s));
      at->second = rows_[i].time_s;
    }
  }
  std::sort(rows_.begin(), rows_.end(), [](const TrajectoryRow& a, const TrajectoryRow& b) {
    return a.id != b.id ? a.id < b.id : a.time_s < b.time_s;
  });
  return {};
}

Result<Trajectories> TrajectoryRows::people_of(Trajectories out) {
  if (rows_.empty()) return problem_in(file_, "there is nobody in this file of trajectories");
  if (auto ok = sort(); !ok) return ok.problem();
  for (size_t from = 0; from < rows_.size();) {
    size_t to = from;
    while (to < rows_.size() && rows_[to].id == rows_[from].id) ++to;
    if (out.people.size() >= limits::trajectory_people)
      return problem_in(file_,
                        fmt::format("there are more than {} people", limits::trajectory_people));
    Trajectory person{.id = rows_[from].id, .times_s = {}, .places = {}, .facing = {}};
    bool looks = true;
    for (size_t i = from; i < to; ++i) {
      if (!person.times_s.empty() && person.times_s.back() == rows_[i].time_s)
        return problem_in(file_, fmt::format("person {} is twice in the file at {} s", person.id,
                                             rows_[i].time_s));
      person.times_s.push_back(rows_[i].time_s);
      person.places.push_back(rows_[i].place);
      looks = looks && glm::length(rows_[i].facing) > 0;
    }
    for (size_t i = from; looks && i < to; ++i)
      person.facing.push_back(glm::normalize(rows_[i].facing));
    out.people.push_back(std::move(person));
    from = to;
  }
  return out;
}

Result<double> checked_fps(double fps, const std::string& file, int line) {
  if (fps > 0 && fps <= limits::trajectory_fps) return fps;
  return problem_in(file, line,
                    fmt::format("{} frames per second are stated: more than 0 and at most {:g} are "
                                "possible",
                                fps, limits::trajectory_fps));
}

std::optional<double> decimal_of(std::string_view text) {
  if (text.starts_with('+')) text.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value)) return {};
  return value;
}

std::optional<int64_t> whole_of(std::string_view text) {
  int64_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return {};
  return value;
}

}  // namespace luxodus
