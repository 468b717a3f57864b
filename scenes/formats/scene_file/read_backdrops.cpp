// Reads drawings under plans: PNG pictures and lines of DXF.
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <numbers>

#include "scenes/formats/dxf/dxf_contents.hpp"
#include "scenes/formats/dxf/dxf_plan.hpp"
#include "scenes/formats/images/page_picture.hpp"
#include "scenes/formats/scene_file/read_files.hpp"
#include "scenes/formats/scene_file/scene_readers.hpp"
#include "scenes/light/geometry/transform.hpp"

namespace luxodus {

namespace {

/// Drawings in a scene. Plans show the longest lines.
constexpr size_t max_backdrops = 50;

/// From the drawing's own coordinates to the scene's.
struct DrawingPlacement {
  glm::dvec2 origin{0}, x{1, 0}, y{0, 1};
  glm::dvec2 at(const glm::dvec2& p) const { return origin + p.x * x + p.y * y; }
};

DrawingPlacement placement_of(KeyReader& keys, double metres) {
  const double turn = keys.number("rotation_deg") * std::numbers::pi / 180;
  DrawingPlacement out;
  out.origin = keys.pair("origin");
  out.x = metres * glm::dvec2(std::cos(turn), std::sin(turn));
  out.y = metres * glm::dvec2(-std::sin(turn), std::cos(turn));
  return out;
}

bool ends_in(const std::filesystem::path& file, const std::string& wanted) {
  std::string ending = file.extension().string();
  for (char& c : ending) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return ending == wanted;
}

/// Pages embed all drawings of a scene at once.
void take_room(KeyReader& keys, uint64_t bytes) {
  uint64_t& all = keys.reading().backdrop_bytes;
  const bool had_room = all <= limits::backdrops_bytes;
  all += bytes;
  if (had_room && all > limits::backdrops_bytes)
    keys.problem("file",
                 fmt::format("the drawings up to this one take {:.3g} MB on a page, of {:.3g} "
                             "MB that all of a scene may: make pictures smaller, or leave "
                             "some out",
                             static_cast<double>(all) / 1e6,
                             static_cast<double>(limits::backdrops_bytes) / 1e6));
}

void read_picture(KeyReader& keys, const std::filesystem::path& path, Backdrop& out) {
  if (!keys.has("metres_per_pixel"))
    return keys.problem("file",
                        "a picture needs 'metres_per_pixel': how long is one of its pixels?");
  const auto picture = read_backdrop_picture(path);
  if (!picture) return take_problem(picture.problem(), keys.place("file"), keys.reading());
  const DrawingPlacement placement = placement_of(keys, keys.number("metres_per_pixel"));
  out.picture = true;
  out.corner = placement.origin;
  out.across = placement.x * static_cast<double>(picture->width);
  out.up = placement.y * static_cast<double>(picture->height);
  take_room(keys, picture->png.size());
}

void read_drawing(KeyReader& keys, const std::filesystem::path& path, Backdrop& out) {
  const auto drawing = read_dxf_plan(path, keys.reading().share);
  if (!drawing) return take_problem(drawing.problem(), keys.place("file"), keys.reading());
  const auto plan = with_contents_of(drawing.value(), [](const std::string&) { return true; });
  if (!plan) return take_problem(plan.problem(), keys.place("file"), keys.reading());
  double metres = plan->metres_per_unit;
  if (const auto unit = keys.maybe_choice("units")) {
    const auto said = metres_per_unit(*unit);
    if (!said) return keys.problem("units", said.problem().what);
    metres = said.value();
  }
  if (!(metres > 0)) return keys.problem("file", plan->unit_problem + ": say it by 'units'");
  const DrawingPlacement placement = placement_of(keys, metres);
  for (const DxfSegment& s : plan->segments) {
    const glm::dvec2 from = placement.at(s.from), to = placement.at(s.to);
    constexpr double farthest_m = 1e6;
    if (std::max({std::abs(from.x), std::abs(from.y), std::abs(to.x), std::abs(to.y)}) < farthest_m)
      out.lines.emplace_back(from, to);
  }
  take_room(keys, limits::backdrop_line_bytes * std::min(out.lines.size(), limits::backdrop_lines));
}

/// Wrong units or origins place a drawing far away.
void warn_if_elsewhere(KeyReader& keys, const Backdrop& backdrop) {
  SceneReading& reading = keys.reading();
  Bounds drawn, building;
  if (backdrop.picture)
    for (const glm::dvec2& p :
         {backdrop.corner, backdrop.corner + backdrop.across, backdrop.corner + backdrop.up,
          backdrop.corner + backdrop.across + backdrop.up})
      drawn.extend(glm::dvec3(p, 0));
  for (const auto& [a, b] : backdrop.lines) {
    drawn.extend(glm::dvec3(a, 0));
    drawn.extend(glm::dvec3(b, 0));
  }
  for (const Object& object : reading.scene.objects)
    for (const glm::dvec3& p : object.mesh.positions) building.extend(p);
  if (drawn.empty() || building.empty()) return;
  const glm::dvec2 low = glm::max(glm::dvec2(drawn.low), glm::dvec2(building.low));
  const glm::dvec2 high = glm::min(glm::dvec2(drawn.high), glm::dvec2(building.high));
  if (low.x < high.x && low.y < high.y) return;
  reading.warning(keys.place("file"),
                  fmt::format("this drawing lies beside the building, x {:.4g} to {:.4g}, y {:.4g} "
                              "to {:.4g} m: are its origin and its unit right?",
                              drawn.low.x, drawn.high.x, drawn.low.y, drawn.high.y));
}

}  // namespace

void read_backdrop(const toml::Table& table, SceneReading& reading) {
  KeyReader keys(table, {"backdrop"}, reading);
  Backdrop out;
  out.place = keys.place();
  if (const auto floors = keys.maybe_pair("floors")) {
    out.low_m = std::min(floors->x, floors->y);
    out.high_m = std::max(floors->x, floors->y);
  }
  const auto path = keys.file("file");
  if (!path || !keys.clean() || !take_hash(*path, keys.place("file"), reading)) return;
  if (reading.scene.backdrops.size() >= max_backdrops)
    return keys.problem("file", fmt::format("a scene has at most {} backdrops", max_backdrops));
  out.file = path->string();
  const bool is_picture = ends_in(*path, ".png");
  if (!is_picture && !ends_in(*path, ".dxf"))
    return keys.problem("file",
                        "a backdrop is a PNG picture or a DXF drawing: name a file that "
                        "ends in .png or .dxf");
  for (const char* key : {"metres_per_pixel", "units"})
    if (keys.has(key) && is_picture == (std::string_view(key) == "units"))
      return keys.problem(key, std::string("'") + key + "' is of " +
                                   (is_picture ? "drawings: a picture has 'metres_per_pixel'"
                                               : "pictures: a drawing has 'units'"));
  if (is_picture)
    read_picture(keys, *path, out);
  else
    read_drawing(keys, *path, out);
  if (!keys.clean()) return;
  warn_if_elsewhere(keys, out);
  reading.scene.backdrops.push_back(std::move(out));
}

}  // namespace luxodus
