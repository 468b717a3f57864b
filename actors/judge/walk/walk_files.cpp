#include "actors/judge/walk/walk_files.hpp"

#include <fmt/format.h>

#include <cmath>

#include "actors/judge/assess/plan_cut.hpp"
#include "actors/judge/report/people_map.hpp"
#include "actors/results/formats/csv.hpp"
#include "actors/results/formats/svg_plot.hpp"
#include "runtime/core/atomic_file.hpp"

namespace luxodus {

namespace {

std::string names_of(const WalkToWrite& w, const WalkStep& step, SignAnswer answer) {
  std::string out;
  for (const SignOnWay& one : step.signs)
    if (one.answer == answer) out += (out.empty() ? "" : "; ") + w.scene.signs[one.sign].name;
  return out;
}

CsvTable people_csv(const FollowedPeople& followed) {
  CsvTable table({"group", "person", "from_s", "to_s", "read_s", "undecided_s", "unread_s",
                  "longest_without_s", "first_read_s", "last_read_s", "signs_read",
                  "mean_extinction_per_m", "largest_extinction_per_m",
                  "largest_equivalent_background_cd_m2"});
  for (const FollowedPerson& one : followed.people)
    table.row(one.group, one.id, one.from_s, one.to_s, one.read_s, one.undecided_s, one.unread_s,
              one.longest_unread_s, one.first_read_s, one.last_read_s,
              static_cast<int64_t>(one.signs_read), one.mean_extinction, one.max_extinction,
              one.max_bleached_cd_m2);
  return table;
}

CsvTable signs_csv(const FollowedPeople& followed) {
  CsvTable table({"sign", "in_view_s", "read_s", "seen_s", "invisible_s", "hidden_s", "undecided_s",
                  "hidden_by_people_s", "readers"});
  for (const PassedSign& sign : followed.signs)
    table.row(sign.name, sign.in_view_s, sign.read_s, sign.seen_s, sign.invisible_s, sign.hidden_s,
              sign.undecided_s, sign.hidden_by_people_s, static_cast<int64_t>(sign.readers));
  return table;
}

/// Direction from +x counter-clockwise; NaN where it is unknown.
double facing_deg(const glm::dvec2& facing) {
  if (facing == glm::dvec2(0)) return std::nan("");
  return glm::degrees(std::atan2(facing.y, facing.x));
}

CsvTable steps_csv(const WalkToWrite& w) {
  CsvTable table({"group", "person", "time_s", "x_m", "y_m", "eye_z_m", "facing_deg",
                  "extinction_per_m", "equivalent_background_cd_m2", "unread_s", "read", "seen",
                  "invisible", "hidden", "undecided"});
  for (const WalkedPerson& walked : w.walk.walks)
    for (const WalkStep& step : walked.steps) {
      const PlacedPerson& one = w.people[walked.person];
      table.row(one.group, one.id, step.time_s, step.eye.x, step.eye.y, step.eye.z,
                facing_deg(step.facing), step.extinction_per_m, step.bleached_cd_m2, step.unread_s,
                names_of(w, step, SignAnswer::read), names_of(w, step, SignAnswer::seen),
                names_of(w, step, SignAnswer::invisible), names_of(w, step, SignAnswer::hidden),
                names_of(w, step, SignAnswer::undecided));
    }
  return table;
}

CsvTable curve_csv(const FollowedPeople& followed) {
  CsvTable table({"time_s", "people", "reading", "undecided", "reading_share"});
  for (const PeopleAtTime& point : followed.curve)
    table.row(point.time_s, static_cast<int64_t>(point.present),
              static_cast<int64_t>(point.reading), static_cast<int64_t>(point.undecided),
              point.reading_share());
  return table;
}

Result<void> write_levels(const std::filesystem::path& folder, const WalkToWrite& w,
                          const FollowedPeople& followed) {
  std::vector<std::vector<const WalkedPerson*>> begun(w.levels.size());
  for (const WalkedPerson& walked : w.walk.walks) {
    const PlacedPerson& one = w.people[walked.person];
    begun[level_of(w.levels, walked.steps.front().eye.z - one.eye_height_m)].push_back(&walked);
  }
  const auto maps = level_files("map", w.levels.size()),
             animations = level_files("animation", w.levels.size());
  for (size_t i = 0; i < w.levels.size(); ++i) {
    std::optional<std::string> map, animation;
    if (!followed.floors[i].cells.empty())
      map = people_map(w.levels[i], followed.floors[i], followed.cell_m, english()).svg;
    if (!begun[i].empty()) animation = walk_animation(w.levels[i], begun[i], w.options.step_s);
    if (auto ok = write_or_remove(folder / maps[i], map); !ok) return ok;
    if (auto ok = write_or_remove(folder / animations[i], animation); !ok) return ok;
  }
  return {};
}

}  // namespace

std::vector<std::string> level_files(const std::string& what, size_t levels) {
  if (levels == 1) return {what + ".svg"};
  std::vector<std::string> out;
  for (size_t i = 1; i <= levels; ++i) out.push_back(fmt::format("{}_{}.svg", what, i));
  return out;
}

FollowedPeople record_of(const WalkToWrite& w) {
  FollowedPeople out;
  out.program = w.version;
  out.scene = w.scene.name;
  out.scenario = w.walk.scenario;
  out.states_s = w.walk.times_s;
  out.forms = w.forms;
  out.step_s = w.options.step_s;
  out.field_of_view_deg = w.options.field_of_view_deg;
  out.crowd_hides = w.options.crowd_hides;
  out.through_walls = w.walk.walls.share();
  out.sure_errors = w.walk.sure_errors;
  out.cell_m = counted_cell_m;
  for (const WalkedPerson& walked : w.walk.walks)
    out.people.push_back(summary_of(w.people[walked.person], walked, w.options.step_s));
  out.signs = sign_summaries(w.scene.signs, w.walk.walks, w.options.step_s);
  out.curve = curve_of(w.walk.walks, w.options.step_s);
  out.floors = walked_floors(w.levels, w.people, w.walk.walks, w.options.step_s);
  return out;
}

Result<void> write_walk(const std::filesystem::path& folder, const WalkToWrite& walk,
                        const FollowedPeople& followed) {
  if (auto ok = write_csv(folder / "people.csv", people_csv(followed)); !ok) return ok;
  if (auto ok = write_csv(folder / "signs.csv", signs_csv(followed)); !ok) return ok;
  if (auto ok = write_csv(folder / "steps.csv", steps_csv(walk)); !ok) return ok;
  if (auto ok = write_csv(folder / "curve.csv", curve_csv(followed)); !ok) return ok;
  if (auto ok = write_svg_plot(folder / "curve.svg", people_curve(followed, english())); !ok)
    return ok;
  if (auto ok = write_levels(folder, walk, followed); !ok) return ok;
  return write_json(folder / "walk.json", followed_people_json(followed));
}

}  // namespace luxodus
