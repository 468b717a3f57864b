#include "scenes/light/transport/surroundings.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>

namespace luxodus {

namespace {

constexpr Real far_m = 1e5_r;
/// Test for a place in a body: in at least two thirds of these directions a line must leave the
/// body more often than it enters it. Beside a single surface half of all directions do. The first
/// few directions already decide most places.
constexpr int body_directions = 24;
constexpr int body_backs = 16;
constexpr int first_directions = 4;
constexpr int first_backs = 2;
/// The bottom of a body on a floor lies in the floor's plane, where either may be hit: downwards,
/// the body cannot be distinguished from its floor. It counts as a body if it shows its back in
/// nearly all upward directions, the flattest at 2.4 degrees, which no roof does, and its front in
/// none.
constexpr int rising_directions = 12;
constexpr int rising_backs = 11;
/// Surfaces that one line may cross: as many as a hall of furniture has in a row.
constexpr int crossings = 256;
constexpr int sky_directions = 128;
/// In front of a long wall half of all directions are free, and nearly half of the horizontal ones,
/// i.e. those that rise or fall by less than 30 degrees.
constexpr double outside_share = 0.5;
constexpr double outside_level_share = 0.4;
constexpr Real level_rise = 0.5_r;
/// Least dimensions of a room; walls are thinner, tables are lower [m].
constexpr double room_width_m = 0.8;
constexpr double room_length_m = 1.5;
constexpr double room_height_m = 1.8;
/// Number of the six sides on which a room's backs must dominate.
constexpr int sides_of_room = 4;
constexpr size_t max_places = 64;
/// Eye height for places on a route [m].
constexpr double waist_m = 1.0;
/// Distance from a lamp's opening or a sign's face, so that no place lies within what it is fixed
/// to [m].
constexpr double off_m = 0.01;

bool is_object(const CompiledScene& scene, uint32_t surface) {
  return surface < scene.description->objects.size();
}

/// Faces of signs and bodies of luminaires do not enclose people.
auto solid_objects(const CompiledScene& scene) {
  return [&scene](const FacedSurface& f) {
    return !is_object(scene, f.surface) || lets_light_through(f.kind);
  };
}

/// Panes and closed doors count as closed: they keep out people and air.
auto closed_objects(const CompiledScene& scene) {
  return [&scene](const FacedSurface& f) {
    return !is_object(scene, f.surface) || f.kind == MaterialKind::open;
  };
}

/// West, east, south, north, down, up.
size_t side_of(const Vec3& d) {
  size_t axis = 0;
  for (size_t a = 1; a < 3; ++a)
    if (std::abs(d[static_cast<int>(a)]) > std::abs(d[static_cast<int>(axis)])) axis = a;
  return 2 * axis + (d[static_cast<int>(axis)] > 0 ? 1 : 0);
}

/// Places of lamps, eyes and routes, at most so many of them, evenly chosen. Planes extend through
/// shafts and cupboards, so they do not count.
std::vector<Vec3> inhabited(const CompiledScene& scene) {
  const SceneDescription& d = *scene.description;
  std::vector<glm::dvec3> all;
  for (const Emitter& e : d.emitters) all.push_back(e.frame.origin - e.frame.axes[2] * off_m);
  for (const Sign& s : d.signs) all.push_back(s.frame.origin + s.frame.axes[2] * off_m);
  for (const Observer& o : d.observers) all.push_back(o.eye);
  for (const Camera& c : d.cameras) all.push_back(c.eye);
  for (const EscapeRoute& r : d.routes)
    for (const glm::dvec3& p : r.path) all.push_back(p + glm::dvec3(0, 0, waist_m));
  std::vector<Vec3> out;
  const size_t step = all.size() / max_places + 1;
  for (size_t i = 0; i < all.size(); i += step) out.emplace_back(all[i] - scene.local_origin);
  return out;
}

/// The view from one place: by side, distances and whose backs are visible. Parts of one table of
/// the scene file belong together, as the faces of a room do.
struct View {
  using Table = std::pair<std::string, int>;  // file and line
  std::array<int, 6> directions{};
  std::array<std::vector<Real>, 6> distances;
  std::map<Table, std::array<int, 6>> backs;
  std::map<uint32_t, std::array<int, 2>> by_surface;  // fronts, backs
};

View::Table table_of(const CompiledScene& scene, uint32_t surface) {
  const SourcePlace& place = scene.description->objects[surface].place;
  return {place.file, place.line};
}

View view_from(const CompiledScene& scene, const GeometryAccess& access, const Vec3& place) {
  static const std::vector<Vec3> directions = sphere_directions(sky_directions);
  View view;
  for (const Vec3& d : directions) {
    const size_t side = side_of(d);
    ++view.directions[side];
    const auto met = first_stop(scene, access, place, d, far_m, solid_objects(scene));
    if (!met) continue;
    view.distances[side].push_back(met->distance_m);
    ++view.by_surface[met->surface][met->front ? 0 : 1];
    if (!met->front) ++view.backs[table_of(scene, met->surface)][side];
  }
  return view;
}

/// Median distance on a side; far if most directions there are free.
double clear_m(View& view, size_t side) {
  auto& list = view.distances[side];
  if (2 * list.size() < static_cast<size_t>(view.directions[side])) return far_m;
  const auto middle = list.begin() + static_cast<std::ptrdiff_t>(list.size() / 2);
  std::nth_element(list.begin(), middle, list.end());
  return static_cast<double>(*middle);
}

/// Tables with a single flat face: a room may be modelled as six of them.
std::set<View::Table> lone_faces(const CompiledScene& scene) {
  std::map<View::Table, std::vector<const Object*>> by_table;
  for (const Object& object : scene.description->objects)
    by_table[{object.place.file, object.place.line}].push_back(&object);
  std::set<View::Table> out;
  for (const auto& [table, objects] : by_table)
    if (objects.size() == 1 && is_flat(objects.front()->mesh)) out.insert(table);
  return out;
}

bool has_size_of_room(View& view) {
  const double x = clear_m(view, 0) + clear_m(view, 1);
  const double y = clear_m(view, 2) + clear_m(view, 3);
  const double z = clear_m(view, 4) + clear_m(view, 5);
  return std::min(x, y) >= room_width_m && std::max(x, y) >= room_length_m && z >= room_height_m;
}

/// Whether the backs of one table dominate on enough sides for it to be the room.
bool surrounds(const View& view, const std::array<int, 6>& backs) {
  int sides = 0;
  for (size_t side = 0; side < backs.size(); ++side)
    if (2 * backs[side] > view.directions[side]) ++sides;
  return sides >= sides_of_room;
}

/// Crossings of one line with a body, and in how many directions it came out of it. Without a table
/// only the first surface counts, whatever it belongs to, since a body may be modelled in several
/// tables.
struct Around {
  const SourcePlace* table = nullptr;
  int side = 0;  // shown by its first surface: 1 back, -1 front, 0 no hit
  int backs = 0, rising = 0, fronts = 0;

  bool stands_around() const { return table != nullptr && fronts == 0 && rising >= rising_backs; }
};

/// Continues to the end: things in a body, or the floor that it is sunk into, show their fronts
/// before the body's own back.
void cross(const CompiledScene& scene, const GeometryAccess& access, const Vec3& place,
           const Vec3& direction, std::span<const char> turned, std::span<const char> ignored,
           std::vector<Around>& all) {
  int count = 0;
  first_stop(scene, access, place, direction, far_m, [&](const FacedSurface& f) {
    const bool is_ignored = f.surface < ignored.size() && ignored[f.surface] != 0;
    if (!is_object(scene, f.surface) || lets_light_through(f.kind) || is_ignored)
      return ++count < crossings;
    const SourcePlace& table = scene.description->objects[f.surface].place;
    auto at = std::find_if(all.begin(), all.end(), [&](const Around& one) {
      return one.table != nullptr && one.table->line == table.line && one.table->file == table.file;
    });
    if (at == all.end()) at = all.insert(all.end(), Around{&table});
    const bool is_turned = f.surface < turned.size() && turned[f.surface] != 0;
    const int step = f.front == is_turned ? 1 : -1;
    if (at->side == 0) at->side = step;
    if (all.front().side == 0) all.front().side = step;
    return ++count < crossings;
  });
}

/// Whether half of all directions are free, and nearly as many of the horizontal ones.
bool is_open(const CompiledScene& scene, const GeometryAccess& access, const Vec3& place) {
  static const std::vector<Vec3> directions = sphere_directions(sky_directions);
  int open = 0, level = 0, open_level = 0;
  for (const Vec3& d : directions) {
    const bool is_level = std::abs(d.z) < level_rise;
    const bool meets =
        first_stop(scene, access, place, d, far_m, closed_objects(scene)).has_value();
    open += meets ? 0 : 1;
    level += is_level ? 1 : 0;
    open_level += is_level && !meets ? 1 : 0;
  }
  return open >= outside_share * sky_directions && open_level >= outside_level_share * level;
}

}  // namespace

bool is_flat(const Mesh& mesh) {
  constexpr double thin_m = 1e-6;
  Bounds box;
  for (const glm::dvec3& p : mesh.positions) box.extend(p);
  const auto& p = mesh.positions;
  if (mesh.triangles.empty()) return false;
  const glm::uvec3 t = mesh.triangles.front();
  const glm::dvec3 across = glm::cross(p[t.y] - p[t.x], p[t.z] - p[t.x]);
  const double size = glm::length(box.high - box.low);
  if (!(glm::length(across) > 0)) return false;
  const glm::dvec3 normal = glm::normalize(across);
  return std::all_of(p.begin(), p.end(), [&](const glm::dvec3& q) {
    return std::abs(glm::dot(q - p[t.x], normal)) <= thin_m * std::max(size, 1.0);
  });
}

std::vector<Vec3> sphere_directions(int count) {
  constexpr double golden_angle = 2.399963229728653;  // pi (3 - sqrt 5)
  std::vector<Vec3> out;
  for (int i = 0; i < count; ++i) {
    const double z = 1 - (2 * i + 1) / static_cast<double>(count);
    const double r = std::sqrt(1 - z * z), phi = golden_angle * i + 0.1;
    out.emplace_back(r * std::cos(phi), r * std::sin(phi), z);
  }
  return out;
}

std::vector<char> turned_surfaces(const CompiledScene& scene, const GeometryAccess& access) {
  std::vector<char> turned(scene.surfaces.size(), 0);
  const std::set<View::Table> faces = lone_faces(scene);
  for (const Vec3& place : inhabited(scene)) {
    View view = view_from(scene, access, place);
    if (view.backs.empty() || !has_size_of_room(view)) continue;
    std::array<int, 6> of_faces{};
    for (const auto& [table, backs] : view.backs) {
      if (faces.count(table) > 0)
        for (size_t side = 0; side < backs.size(); ++side) of_faces[side] += backs[side];
      if (!surrounds(view, backs)) continue;
      for (const auto& [surface, seen] : view.by_surface)
        if (table_of(scene, surface) == table && seen[1] > seen[0]) turned[surface] = 1;
    }
    if (!surrounds(view, of_faces)) continue;
    for (const auto& [surface, seen] : view.by_surface)
      if (faces.count(table_of(scene, surface)) > 0 && seen[1] > seen[0]) turned[surface] = 1;
  }
  return turned;
}

bool in_body(const CompiledScene& scene, const GeometryAccess& access, const Vec3& place,
             std::span<const char> turned, std::span<const char> ignored) {
  static const std::vector<Vec3> directions = sphere_directions(body_directions);
  std::vector<Around> all(1);
  for (int i = 0; i < body_directions; ++i) {
    for (Around& one : all) one.side = 0;
    cross(scene, access, place, directions[static_cast<size_t>(i)], turned, ignored, all);
    int most = 0;
    bool stands_around = false;
    for (Around& one : all) {
      one.backs += one.side > 0 ? 1 : 0;
      one.rising += one.side > 0 && i < rising_directions ? 1 : 0;
      one.fronts += one.side < 0 ? 1 : 0;
      most = std::max(most, one.backs);
      stands_around |= one.stands_around();
    }
    const int left = body_directions - (i + 1);
    if (most >= body_backs || (left == 0 && stands_around)) return true;
    const bool hopeless = i + 1 >= first_directions && most < first_backs;
    if (hopeless || (most + left < body_backs && !stands_around)) return false;
  }
  return false;
}

bool is_outside(const CompiledScene& scene, const GeometryAccess& access, const Vec3& place) {
  if (!is_open(scene, access, place)) return false;
  // At the height of the upper edge of walls, a place in a room without a ceiling is as open as one
  // outdoors. Below it the walls enclose it.
  const Vec3 down(0, 0, -1);
  const auto below = first_stop(scene, access, place, down, far_m, closed_objects(scene));
  return !below || is_open(scene, access, place + down * (below->distance_m / 2));
}

}  // namespace luxodus
