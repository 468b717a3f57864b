// Reads objects written in the scene file.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "scenes/formats/scene_file/read_placement.hpp"
#include "scenes/formats/scene_file/scene_readers.hpp"
#include "scenes/light/geometry/building_parts.hpp"
#include "scenes/light/geometry/mesh_tools.hpp"
#include "scenes/light/geometry/primitives.hpp"

namespace luxodus {

namespace {

void move_by(Mesh& mesh, const glm::dvec3& offset) {
  apply(translation(offset), mesh);
}

Result<int> segments_of(KeyReader& keys, const char* radius) {
  return shapes::segments_within(keys.number(radius), keys.number("mesh_tolerance_m"));
}

Result<Shape> wall_shape(KeyReader& keys) {
  const glm::dvec3 from = keys.point("from"), to = keys.point("to");
  const double height = keys.number("height"), thickness = keys.number("thickness");
  std::vector<shapes::WallOpening> openings;
  for (const toml::Table* t : keys.tables("opening")) {
    KeyReader hole(*t, {"object.opening"}, keys.reading());
    openings.push_back(
        {hole.number("at"), hole.number("sill"), hole.number("width"), hole.number("height")});
    const auto& o = openings.back();
    const double length = glm::length(to - from);
    if (keys.clean() && hole.clean() &&
        (o.x + o.width > length * (1 + 1e-9) || o.z + o.height > height * (1 + 1e-9))) {
      hole.problem("this opening reaches outside its wall of " + std::to_string(length) + " m by " +
                   std::to_string(height) + " m");
      return Problem{};
    }
    for (size_t i = 0; hole.clean() && i + 1 < openings.size(); ++i) {
      constexpr double shared_m = 1e-6;
      const auto& other = openings[i];
      const double wide = std::min(o.x + o.width, other.x + other.width) - std::max(o.x, other.x);
      const double high = std::min(o.z + o.height, other.z + other.height) - std::max(o.z, other.z);
      if (wide > shared_m && high > shared_m)
        hole.problem("this opening overlaps opening " + std::to_string(i + 1) +
                     " of its wall: 'at' is from the wall's start to the opening's nearer edge; "
                     "move it, or write one opening for both");
    }
    if (!hole.clean()) return Problem{};
  }
  if (!keys.clean()) return Problem{};
  if (std::abs(from.z - to.z) > 1e-6) {
    return problem("a wall's 'from' and 'to' must be at the same height");
  }
  auto shape = shapes::wall(glm::length(to - from), height, thickness, openings);
  if (!shape) return shape;
  const glm::dvec3 along = glm::normalize(to - from);
  const glm::dvec3 up(0, 0, 1);
  const Transform place{glm::dmat3(along, glm::cross(up, along), up), from};
  apply(place, shape->mesh);
  return shape;
}

Result<Shape> box_shape(KeyReader& keys) {
  const glm::dvec3 low = keys.point("low"), high = keys.point("high");
  if (keys.clean() && !glm::all(glm::lessThan(low, high))) {
    return problem("'high' must lie above 'low' in x, y and z");
  }
  if (!keys.clean()) return Problem{};
  auto shape = shapes::box(high - low, shapes::BoxAt::corner);
  if (shape) move_by(shape->mesh, low);
  return shape;
}

Result<Shape> outline_shape(KeyReader& keys, bool prism) {
  const auto outline = keys.corners("outline");
  const double z = keys.number("z"), height = prism ? keys.number("height") : 0;
  if (!keys.clean()) return Problem{};
  auto shape = prism ? shapes::extrude(outline, height) : shapes::polygon(outline);
  if (shape) move_by(shape->mesh, {0, 0, z});
  return shape;
}

Result<Shape> round_shape(KeyReader& keys, const std::string& kind) {
  if (kind == "sphere") {
    const double radius = keys.number("radius"), bound = keys.number("mesh_tolerance_m");
    if (!keys.clean()) return Problem{};
    return shapes::sphere(radius, bound);
  }
  const auto segments = segments_of(keys, kind == "tube" ? "outer_radius" : "radius");
  if (kind == "tube") {
    const double outer = keys.number("outer_radius"), inner = keys.number("inner_radius");
    const double length = keys.number("length");
    if (keys.clean() && inner >= outer) {
      return problem("'inner_radius' must be less than 'outer_radius'");
    }
    if (!keys.clean()) return Problem{};
    if (!segments) return segments.problem();
    return shapes::tube(outer, inner, length, segments.value());
  }
  const double radius = keys.number("radius");
  if (kind == "disc") {
    if (!keys.clean()) return Problem{};
    if (!segments) return segments.problem();
    return shapes::disc(radius, segments.value());
  }
  const double height = keys.number("height");
  const bool caps = keys.flag("caps");
  if (!keys.clean()) return Problem{};
  if (!segments) return segments.problem();
  return shapes::cylinder(radius, height, segments.value(),
                          caps ? shapes::Caps::both : shapes::Caps::none);
}

Result<Shape> climbing_shape(KeyReader& keys, bool ramp) {
  const double width = keys.number("width"), rise = keys.number("rise");
  const std::string underside = keys.choice("underside");
  if (ramp) {
    const double length = keys.number("length");
    if (!keys.clean()) return Problem{};
    return shapes::ramp(
        length, width, rise,
        underside == "none" ? shapes::RampUnderside::none : shapes::RampUnderside::solid);
  }
  const int steps = static_cast<int>(keys.integer("steps"));
  const double going = keys.number("going");
  if (!keys.clean()) return Problem{};
  const auto below = underside == "none"    ? shapes::StairUnderside::none
                     : underside == "solid" ? shapes::StairUnderside::solid
                                            : shapes::StairUnderside::soffit;
  return shapes::stairs(steps, rise, going, width, below);
}

/// The mesh in local coordinates. An empty Problem means: already reported.
Result<Shape> shape_of(KeyReader& keys, const std::string& kind) {
  if (kind == "quad") {
    const glm::dvec3 corner = keys.point("corner");
    const glm::dvec3 u = keys.point("edge_u"), v = keys.point("edge_v");
    if (!keys.clean()) return Problem{};
    return shapes::quad(corner, u, v);
  }
  if (kind == "box") return box_shape(keys);
  if (kind == "polygon" || kind == "prism") return outline_shape(keys, kind == "prism");
  if (kind == "wall") return wall_shape(keys);
  if (kind == "stairs" || kind == "ramp") return climbing_shape(keys, kind == "ramp");
  return round_shape(keys, kind);
}

/// A room: six objects that differ only in mesh and material.
void read_room(KeyReader& keys, const Object& common, const SurfaceWords& words,
               const Transform& transform, std::span<const glm::dvec3> copies) {
  const glm::dvec3 low = keys.point("low"), high = keys.point("high");
  const auto omit = keys.texts("omit");
  std::map<std::string, SurfaceWords> faces;
  for (const char* face : {"floor", "ceiling", "x0", "x1", "y0", "y1"}) {
    const std::string key = face[0] == 'f' || face[0] == 'c' ? face : "walls";
    SurfaceWords own = words;
    if (const auto material = keys.maybe_text(key)) {
      own.material = *material;
      own.material_place = keys.place(key);
    }
    faces.emplace(face, std::move(own));
  }
  for (const auto& face : omit) {
    if (faces.erase(face) == 0) {
      keys.problem("omit",
                   "a room has no face '" + face + "'; it has floor, ceiling, x0, x1, y0, y1");
    }
  }
  if (keys.clean() && !glm::all(glm::lessThan(low, high))) {
    keys.problem("high", "'high' must lie above 'low' in x, y and z");
  }
  if (keys.has("door")) keys.problem("door", "a room is no door; only a single surface can be one");
  const bool sound = keys.clean();
  const auto room = shapes::room(sound ? high - low : glm::dvec3(1));
  if (!room) return adopt_problem(keys, room.problem());
  const std::map<std::string, const Mesh*> meshes = {
      {"floor", &room->floor}, {"ceiling", &room->ceiling}, {"x0", &room->x0},
      {"x1", &room->x1},       {"y0", &room->y0},           {"y1", &room->y1}};
  for (const auto& [face, own] : faces) {
    Object object = common;
    object.name = common.name + "." + face;
    object.tags.push_back(common.name);
    object.mesh = *meshes.at(face);
    move_by(object.mesh, sound ? low : glm::dvec3(0));
    apply(transform, object.mesh);
    repeat_mesh(keys, copies, object.mesh);
    keys.reading().declare("object", object.name, object.place);
    add_object(std::move(object), own, keys.reading());
  }
}

/// Whether an object that comes and goes exists: by the last of its times that has passed.
bool is_there_now(KeyReader& keys, const std::string& shape) {
  struct Turn {
    double at_s;
    bool appears;
  };
  std::vector<Turn> turns;
  for (const double at_s : keys.numbers("appears_at")) turns.push_back({at_s, true});
  for (const double at_s : keys.numbers("vanishes_at")) turns.push_back({at_s, false});
  if (turns.empty()) return true;
  SceneReading& reading = keys.reading();
  const char* key = keys.has("vanishes_at") ? "vanishes_at" : "appears_at";
  reading.changes_in_time = reading.goes_by_clock = true;
  std::sort(turns.begin(), turns.end(),
            [](const Turn& a, const Turn& b) { return a.at_s < b.at_s; });
  for (size_t i = 1; i < turns.size(); ++i)
    if (turns[i].at_s == turns[i - 1].at_s && turns[i].appears != turns[i - 1].appears)
      keys.problem(key, fmt::format("it appears and vanishes at {:g} s", turns[i].at_s));
  if (shape == "room") keys.problem(key, "a room stands: write what comes and goes by itself");
  const auto now = reading.time_s();
  if (!now) {
    keys.problem(key, fmt::format("'{}' goes by the clock, and no time is said: give --at 60s, or "
                                  "add [time] with 'from', 'to' and 'step'",
                                  key));
    return true;
  }
  bool there = !turns.front().appears;
  for (const Turn& turn : turns)
    if (turn.at_s <= *now) there = turn.appears;
  return there;
}

/// Keeps where the flights of stairs of an object are.
void keep_stair_flights(KeyReader& keys, const std::string& name, const Transform& transform,
                        std::span<const glm::dvec3> copies) {
  StairFlight stairs;
  stairs.name = name;
  stairs.treads = static_cast<int>(keys.integer("steps"));
  const double rise = keys.number("rise"), going = keys.number("going");
  const double middle = keys.number("width") / 2;
  const auto tread = [&](int number) {
    return transform.point({(number - 0.5) * going, middle, number * rise});
  };
  for (size_t i = 0; i < copies.size(); ++i) {
    if (i > 0) stairs.name = name + ", " + std::to_string(i + 1);
    stairs.lowest = tread(1) + copies[i];
    stairs.highest = tread(stairs.treads) + copies[i];
    keys.reading().stair_flights.push_back(stairs);
  }
}

}  // namespace

void read_object(const toml::Table& table, SceneReading& reading) {
  std::string kind;
  KeyReader keys = kind_reader(table, "object", "shape", reading, kind);
  Object object;
  object.place = keys.place();
  object.patch_edge_m = reading.patch_edge_m;
  object.name = read_name(keys, "object");
  SurfaceWords words;
  words.material = keys.text("material");
  words.material_place = keys.place("material");
  read_surface(keys, object, words);
  const Transform transform = read_transform(keys);
  const auto copies = read_repeat(keys);
  const bool there = is_there_now(keys, kind);
  if (kind == "room") return read_room(keys, object, words, transform, copies);
  read_door(keys, object);
  if (object.door && copies.size() > 1)
    keys.problem("repeat", "a door turns about one hinge: write each door down by itself");
  if (!kind.empty()) {
    auto shape = shape_of(keys, kind);
    if (shape) {
      object.mesh = std::move(shape->mesh);
      apply(transform, object.mesh);
      repeat_mesh(keys, copies, object.mesh);
      if (kind == "stairs" && keys.clean() && there)
        keep_stair_flights(keys, object.name, transform, copies);
      reading.scene.degenerate_triangles += clean_mesh(object.mesh);
      if (object.mesh.triangles.empty()) keys.problem("'" + object.name + "' has no area left");
    } else if (!shape.problem().what.empty()) {
      adopt_problem(keys, shape.problem());
    }
  }
  // A missing material has been reported already. For such an object, and for one that is absent at
  // this time, only the name must be known from here on.
  if (words.material.empty() || !keys.clean() || !there) {
    reading.note("object or tag", object.name, object.place);
    for (const auto& tag : object.tags) reading.note("object or tag", tag, object.place);
    if (object.door) reading.note("door", object.name, object.place);
    if (words.material.empty()) return;
  }
  if (keys.clean() && there) {
    add_object(std::move(object), words, reading);
  } else {
    reading.material_index(words.material, words.material_place);
  }
}

}  // namespace luxodus
