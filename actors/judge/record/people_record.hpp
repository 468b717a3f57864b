// People who were followed through a scene (actors/judge/walk), as walk.json holds them: what each
// of them read, what each sign gave, how many read a sign over time, and where nobody did. Times
// count steps: a step stands for its length. Undecided is not read. Plain values; any thread.
#pragma once

#include <filesystem>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <vector>

#include "actors/results/formats/json_fields.hpp"

namespace luxodus {

namespace limits {
/// Largest walk.json that is read [bytes].
inline constexpr uint64_t followed_people_bytes = uint64_t{256} << 20;
}  // namespace limits

/// What walk.json says it is.
inline constexpr const char* followed_people_format = "luxodus walk 1";

struct FollowedPerson {
  std::string group;
  int64_t id = 0;  // in the file of the group
  double from_s = 0, to_s = 0;
  double read_s = 0, undecided_s = 0, unread_s = 0;  // with a sign read; perhaps; surely without
  double longest_unread_s = 0;                       // longest time without a sign read
  std::optional<double> first_read_s, last_read_s;   // of the clock
  size_t signs_read = 0;
  double mean_extinction = 0, max_extinction = 0;  // at the eye [1/m]
  double max_bleached_cd_m2 = 0;                   // equivalent background of eyes from a lit room
  static constexpr void fields(auto&& field, auto& m) {
    field("group", m.group)("person", m.id)("from_s", m.from_s)("to_s", m.to_s);
    field("read_s", m.read_s)("undecided_s", m.undecided_s)("unread_s", m.unread_s);
    field("longest_without_s", m.longest_unread_s);
    field("first_read_s", m.first_read_s, {.or_null = true});
    field("last_read_s", m.last_read_s, {.or_null = true})("signs_read", m.signs_read);
    field("mean_extinction_per_m", m.mean_extinction);
    field("largest_extinction_per_m", m.max_extinction);
    field("largest_equivalent_background_cd_m2", m.max_bleached_cd_m2);
  }
};

/// Person-seconds of one sign in the fields of view of people whom it could guide.
struct PassedSign {
  std::string name;
  double in_view_s = 0;
  double read_s = 0, seen_s = 0, invisible_s = 0, hidden_s = 0, undecided_s = 0;
  double hidden_by_people_s = 0;  // part of hidden_s
  size_t readers = 0;             // people who read it
  static constexpr void fields(auto&& field, auto& m) {
    field("name", m.name)("in_view_s", m.in_view_s)("read_s", m.read_s)("seen_s", m.seen_s);
    field("invisible_s", m.invisible_s)("hidden_s", m.hidden_s)("undecided_s", m.undecided_s);
    field("hidden_by_people_s", m.hidden_by_people_s)("readers", m.readers);
  }
};

/// People at one time.
struct PeopleAtTime {
  double time_s = 0;
  size_t present = 0, reading = 0, undecided = 0;
  std::optional<double> reading_share() const;  // none if nobody is there
  static constexpr void fields(auto&& field, auto& m) {
    field("time_s", m.time_s)("people", m.present)("reading", m.reading);
    field("undecided", m.undecided);
    field("reading_share", derived([&m] { return m.reading_share(); }), {.or_null = true});
  }
};

/// A square of the floor in which somebody was.
struct WalkedCell {
  glm::dvec2 corner{0};  // the lower one along both axes
  double unread_s = 0;   // person-seconds without a sign read
  static constexpr void fields(auto&& field, auto& m) {
    field("corner", m.corner)("unread_s", m.unread_s);
  }
};

struct WalkedFloor {
  double floor_m = 0;
  std::vector<WalkedCell> cells;
  static constexpr void fields(auto&& field, auto& m) {
    field("floor_m", m.floor_m)("cells", m.cells);
  }
};

struct FollowedPeople {
  std::string program, scene, scenario;
  std::vector<double> states_s;    // times of the states that were traced; empty: one state
  std::vector<std::string> forms;  // of the files of trajectories, by group
  double step_s = 0, field_of_view_deg = 0;
  bool crowd_hides = false;
  double through_walls = 0;  // share of steps that cross walls or begin in solids
  double sure_errors = 0;    // distance of a value from its limit, in standard errors
  double cell_m = 0;         // edge of the cells of the floors
  std::vector<FollowedPerson> people;
  std::vector<PassedSign> signs;
  std::vector<PeopleAtTime> curve;
  std::vector<WalkedFloor> floors;  // from below
  static constexpr void fields(auto&& field, auto& m) {
    field("format", derived([] { return std::string(followed_people_format); }));
    field("program", m.program)("scene", m.scene)("scenario", m.scenario);
    field("states_s", m.states_s)("forms", m.forms)("step_s", m.step_s);
    field("field_of_view_deg", m.field_of_view_deg)("crowd_hides", m.crowd_hides);
    field("steps_through_walls", m.through_walls)("sure_errors", m.sure_errors);
    field("cell_m", m.cell_m)("people", m.people)("signs", m.signs)("curve", m.curve);
    field("floors", m.floors);
  }
};

/// Sums over all people.
struct PeopleTotals {
  double all_s = 0, read_s = 0, undecided_s = 0;  // person-seconds
  double longest_unread_s = 0;
  size_t never = 0;  // people who never read a sign
  double unread_s() const { return all_s - read_s - undecided_s; }
};
PeopleTotals totals_of(const std::vector<FollowedPerson>& people);

Json followed_people_json(const FollowedPeople& people);
/// Errors: a file that cannot be read, is none of this program, or is damaged.
Result<FollowedPeople> read_followed_people(const std::filesystem::path& file);

}  // namespace luxodus
