// Inspects whole meshes: whether their size is plausible for a building, and whether rooms are
// drawn with their faces inwards. The parts of one import, or the faces of one room, are in one
// table of the scene file and count as one thing.
#include <algorithm>
#include <map>

#include "actors/judge/inspect/same_place.hpp"
#include "actors/judge/inspect/site.hpp"

namespace luxodus {

namespace {

constexpr size_t shown_names = 4;

using Table = std::pair<std::string, int>;

Table table_of(const Object& object) {
  return {object.place.file, object.place.line};
}

/// NAME of NAME.PART, the names of imports and rooms.
std::string whole_name(const Object& object) {
  return object.name.substr(0, object.name.find('.'));
}

struct Whole {
  const Object* first = nullptr;
  bool in_parts = false;  // of an import, or of a room
  Bounds bounds;
};

std::vector<Whole> wholes_of(const SceneDescription& scene) {
  std::vector<Whole> out;
  std::map<Table, size_t> index;
  for (const Object& object : scene.objects) {
    const auto [at, fresh] = index.try_emplace(table_of(object), out.size());
    if (fresh) out.push_back({&object, object.name.find('.') != std::string::npos, {}});
    for (const glm::dvec3& p : object.mesh.positions) out[at->second].bounds.extend(p);
  }
  return out;
}

/// The front of a flat thing; nothing for others, which are seen from all sides.
glm::dvec3 front_of(const Object& object) {
  const Mesh& mesh = object.mesh;
  if (mesh.triangles.empty() || !is_flat(mesh)) return glm::dvec3(0);
  const glm::uvec3& t = mesh.triangles.front();
  return glm::normalize(glm::cross(mesh.positions[t.y] - mesh.positions[t.x],
                                   mesh.positions[t.z] - mesh.positions[t.x]));
}

/// Corners of two things in one space are at most so far apart, along each axis [m].
constexpr double one_space_m = 1e-3;

/// Whether two things fill the same space, seen from one side.
bool coincide(const Whole& a, const Whole& b) {
  const auto near = [](const glm::dvec3& p, const glm::dvec3& q) {
    return glm::all(glm::lessThan(glm::abs(p - q), glm::dvec3(one_space_m)));
  };
  if (!near(a.bounds.low, b.bounds.low) || !near(a.bounds.high, b.bounds.high)) return false;
  if (a.first->door.has_value() != b.first->door.has_value()) return false;
  return !(glm::dot(front_of(*a.first), front_of(*b.first)) < 0);
}

std::string size_text(const glm::dvec3& size) {
  return length_text(size.x) + " x " + length_text(size.y) + " x " + length_text(size.z);
}

}  // namespace

void inspect_sizes(const SceneDescription& scene, Findings& out) {
  for (const Whole& whole : wholes_of(scene)) {
    if (whole.bounds.empty()) continue;
    const glm::dvec3 size = whole.bounds.high - whole.bounds.low;
    const double least = std::min({size.x, size.y, size.z});
    const double largest = std::max({size.x, size.y, size.z});
    // A single disc or quad may be a pilot lamp, or a plain to the horizon.
    const bool may_be = largest < 1 ? !whole.in_parts : !(least > 0);
    if (!no_buildings_size(size) || may_be) continue;
    out.push_back(
        {Severity::warning,
         "unit",
         {whole.first->place,
          fmt::format("\"{}\" is {} large: is it drawn in another unit? The scene is in "
                      "metres; an import says units = \"mm\", \"cm\", \"m\", \"in\" or \"ft\"",
                      whole_name(*whole.first), size_text(size))}});
  }
}

void inspect_doubled_objects(const SceneDescription& scene, Findings& out) {
  const std::vector<Whole> wholes = wholes_of(scene);
  const auto place = [&](size_t i) {
    return wholes[i].bounds.empty() ? std::nullopt : std::optional(wholes[i].bounds.low);
  };
  const auto alike = [&](size_t a, size_t b) { return coincide(wholes[a], wholes[b]); };
  const auto firsts = first_in_same_place(wholes.size(), 2 * one_space_m, place, alike);
  for (size_t i = 0; i < wholes.size(); ++i) {
    if (!firsts[i]) continue;
    const Object &first = *wholes[*firsts[i]].first, &second = *wholes[i].first;
    out.push_back(
        {Severity::warning,
         "same place",
         {second.place, fmt::format("\"{}\" fills the very space of \"{}\" (line {}): which of the "
                                    "two is met is left to rounding; remove one of them",
                                    whole_name(second), whole_name(first), first.place.line)}});
  }
}

void inspect_turned_rooms(const Site& site, Findings& out) {
  std::map<Table, std::vector<const Object*>> turned;
  for (size_t i = 0; i < site.scene.objects.size(); ++i)
    if (site.building.turned()[i] != 0)
      turned[table_of(site.scene.objects[i])].push_back(&site.scene.objects[i]);
  const SceneDescription& s = site.scene;
  const bool asks_for_walls = !s.routes.empty() || !s.open_areas.empty() || !s.planes.empty();
  // Single faces in tables of their own can form one room.
  std::vector<const Object*> faces;
  for (auto at = turned.begin(); at != turned.end();) {
    const bool lone = at->second.size() == 1 && is_flat(at->second.front()->mesh);
    if (lone) faces.push_back(at->second.front());
    at = lone ? turned.erase(at) : std::next(at);
  }
  if (!faces.empty()) turned[table_of(*faces.front())] = faces;
  for (const auto& [table, objects] : turned) {
    std::string names;
    for (size_t i = 0; i < std::min(objects.size(), shown_names); ++i)
      names += (i > 0 ? ", \"" : "\"") + objects[i]->name + "\"";
    if (objects.size() > shown_names)
      names += fmt::format(" and {} more", objects.size() - shown_names);
    out.push_back(
        {asks_for_walls ? Severity::warning : Severity::note,
         "turned",
         {objects.front()->place,
          fmt::format("the room \"{}\" is drawn with its faces to the outside ({}): seen from "
                      "within, where lamps or people are, it shows its backs. It is taken as a "
                      "room, not as a solid body; turn its normals round, or use shape = \"room\"",
                      whole_name(*objects.front()), names)}});
  }
}

}  // namespace luxodus
