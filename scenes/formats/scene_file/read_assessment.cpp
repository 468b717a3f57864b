// Reads routes, areas, points of emphasis, and assumptions about people.
#include <algorithm>
#include <charconv>
#include <cmath>
#include <span>

#include "runtime/core/output_text.hpp"
#include "runtime/core/printable.hpp"
#include "scenes/emergency/rule_sets.hpp"
#include "scenes/emergency/sight.hpp"
#include "scenes/formats/scene_file/scene_readers.hpp"
#include "scenes/light/geometry/polygon.hpp"

namespace luxodus {

namespace {

/// Two points of a path nearer than this are the same point, which gives no direction [m].
constexpr double shortest_leg_m = 0.01;

AssessedArea read_area(KeyReader& keys, const char* kind) {
  AssessedArea area;
  area.name = read_name(keys, kind);
  area.place = keys.place();
  area.ifc_guid = keys.text("ifc_guid");
  area.z_m = keys.number("z");
  const auto outline = keys.corners("outline");
  if (!keys.clean()) return area;
  auto checked = checked_outline(outline);
  if (!checked)
    keys.problem("outline", checked.problem().what);
  else
    area.outline = std::move(checked).value();
  return area;
}

/// Floors nearer than this to each other are of one storey [m].
constexpr double one_storey_m = 1;
/// Rooms may overlap by this much, by rounding and by the thickness of a wall between them [m2].
constexpr double shared_m2 = 0.5;
/// Every room is compared with every other: 5000 take a tenth of a second.
constexpr size_t max_rooms = 5000;

struct OutlineBox {
  glm::dvec2 low{1e300}, high{-1e300};
};

OutlineBox box_of(const std::vector<glm::dvec2>& outline) {
  OutlineBox out;
  for (const glm::dvec2& p : outline) {
    out.low = glm::min(out.low, p);
    out.high = glm::max(out.high, p);
  }
  return out;
}

/// The area that two outlines have in common, by a grid of points over where their boxes meet.
double overlap_m2(const std::vector<glm::dvec2>& a, const OutlineBox& box_a,
                  const std::vector<glm::dvec2>& b, const OutlineBox& box_b) {
  constexpr int points = 64;  // along each side
  const glm::dvec2 low = glm::max(box_a.low, box_b.low);
  const glm::dvec2 size = glm::min(box_a.high, box_b.high) - low;
  if (!(size.x > 0 && size.y > 0) || size.x * size.y <= shared_m2) return 0;
  int both = 0;
  for (int i = 0; i < points; ++i)
    for (int j = 0; j < points; ++j) {
      const glm::dvec2 p = low + size * (glm::dvec2(i, j) + 0.5) / double{points};
      both += is_within(a, p) && is_within(b, p);
    }
  return size.x * size.y * both / (points * points);
}

/// Reports names that are not valid, with their line; whether they match is checked when all files
/// are read.
void check_names(KeyReader& keys, const char* key, const std::vector<std::string>& names,
                 std::span<const NamedRules> known) {
  std::string all;
  for (const NamedRules& one : known) all += (all.empty() ? "" : ", ") + std::string(one.id);
  for (const std::string& name : names)
    if (std::none_of(known.begin(), known.end(),
                     [&](const NamedRules& one) { return one.id == name; }))
      keys.problem(key, "there is no \"" + name + "\" in '" + key + "'; there are: " + all);
}

/// "75", "protan", "protan 75".
std::optional<OtherEyes> other_eyes_named(const std::string& name) {
  constexpr std::string_view protan = "protan";
  OtherEyes eyes{name, {}, name.starts_with(protan)};
  std::string_view age = name;
  if (eyes.protan) age.remove_prefix(protan.size());
  if (eyes.protan && age.empty()) return eyes;
  if (eyes.protan && age.starts_with(' ')) age.remove_prefix(1);
  double years = 0;
  const auto [end, error] = std::from_chars(age.data(), age.data() + age.size(), years);
  if (error != std::errc() || end != age.data() + age.size() || !(years >= limits::min_age) ||
      !(years <= limits::max_age))
    return std::nullopt;
  eyes.age_years = years;
  return eyes;
}

std::vector<OtherEyes> read_other_eyes(KeyReader& keys) {
  std::vector<OtherEyes> out;
  for (const std::string& name : keys.texts("other_eyes")) {
    if (auto eyes = other_eyes_named(name))
      out.push_back(*std::move(eyes));
    else
      keys.problem("other_eyes", "'other_eyes' has \"" + excerpt(name) +
                                     "\"; it takes ages from 23 to 75, such as \"75\", and "
                                     "\"protan\" with or without one");
  }
  return out;
}

}  // namespace

void read_assessment(const toml::Table& table, SceneReading& reading) {
  KeyReader keys(table, {"assessment"}, reading);
  AssessmentSettings& s = reading.scene.assessment;
  // Each of several files of a scene may state some keys: the others keep their values.
  const auto says = [&](const char* key) { return keys.has(key); };
  s.place = keys.place();
  if (says("age_years")) s.age_years = keys.number("age_years");
  if (says("eye_heights_m")) {
    s.eye_heights_m = keys.numbers("eye_heights_m");
    if (keys.clean() && s.eye_heights_m.empty())
      keys.problem("eye_heights_m", "'eye_heights_m' names no height");
  }
  if (says("other_eyes")) s.other_eyes = read_other_eyes(keys);
  if (says("spacing_m")) s.spacing_m = keys.number("spacing_m");
  if (says("luminance_before")) s.luminance_before_cd_m2 = keys.number("luminance_before");
  if (says("smoke_expected")) s.smoke_expected = keys.flag("smoke_expected");
  if (says("irritant_smoke")) s.irritant_smoke = keys.flag("irritant_smoke");
  if (says("rules")) {
    s.rules = keys.texts("rules");
    check_names(keys, "rules", s.rules, rule_sets());
  }
  if (says("deviations")) {
    s.deviations = keys.texts("deviations");
    check_names(keys, "deviations", s.deviations, deviations());
  }
}

void read_route(const toml::Table& table, SceneReading& reading) {
  KeyReader keys(table, {"route"}, reading);
  EscapeRoute r;
  r.name = read_name(keys, "route");
  r.place = keys.place();
  r.path = keys.points("path");
  r.width_m = keys.number("width");
  if (keys.clean() && r.path.size() < 2) keys.problem("path", "'path' needs two points at least");
  for (size_t i = 1; i < r.path.size() && keys.clean(); ++i)
    if (glm::length(glm::dvec2(r.path[i] - r.path[i - 1])) < shortest_leg_m)
      keys.problem("path", "points " + std::to_string(i) + " and " + std::to_string(i + 1) +
                               " of 'path' are less than 1 cm apart, seen from above");
  reading.scene.routes.push_back(std::move(r));
}

void read_open_area(const toml::Table& table, SceneReading& reading) {
  KeyReader keys(table, {"open_area"}, reading);
  reading.scene.open_areas.push_back(read_area(keys, "open_area"));
}

void read_task_area(const toml::Table& table, SceneReading& reading) {
  KeyReader keys(table, {"task_area"}, reading);
  AssessedArea area = read_area(keys, "task_area");
  area.mains_lx = keys.number("mains_lx");
  reading.scene.task_areas.push_back(std::move(area));
}

void read_room(const toml::Table& table, SceneReading& reading) {
  KeyReader keys(table, {"room"}, reading);
  reading.scene.rooms.push_back(read_area(keys, "room"));
}

void check_rooms(SceneReading& reading) {
  const auto& rooms = reading.scene.rooms;
  if (rooms.size() > max_rooms)
    return reading.problem(rooms[max_rooms].place,
                           "a scene may have " + std::to_string(max_rooms) + " rooms");
  std::vector<OutlineBox> boxes;
  for (const AssessedArea& room : rooms) boxes.push_back(box_of(room.outline));
  for (size_t i = 0; i < rooms.size(); ++i)
    for (size_t j = 0; j < i; ++j) {
      if (std::abs(rooms[i].z_m - rooms[j].z_m) >= one_storey_m) continue;
      const double shared = overlap_m2(rooms[i].outline, boxes[i], rooms[j].outline, boxes[j]);
      if (shared > shared_m2)
        reading.problem(rooms[i].place, "room '" + rooms[i].name + "' overlaps room '" +
                                            rooms[j].name + "' by " + readable_number(shared, 2) +
                                            " m2: a place belongs to one room, mend an outline");
    }
}

void read_emphasis(const toml::Table& table, SceneReading& reading) {
  KeyReader keys(table, {"emphasis"}, reading);
  EmphasisPoint p;
  p.name = read_name(keys, "emphasis");
  p.place = keys.place();
  p.position = keys.point("position");
  p.facing = keys.maybe_direction("facing");
  p.ifc_guid = keys.text("ifc_guid");
  const auto word = std::find(emphasis_words.begin(), emphasis_words.end(), keys.choice("kind"));
  if (word != emphasis_words.end())
    p.kind = static_cast<EmphasisKind>(word - emphasis_words.begin());
  reading.scene.emphasis.push_back(std::move(p));
}

}  // namespace luxodus
