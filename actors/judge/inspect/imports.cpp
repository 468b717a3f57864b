// Inspects imported buildings: whether they lie on their side, and whether their storey heights are
// plausible or in another unit. Decided by their largest areas, and by names of their parts. For
// any building: whether all of its doors have sizes in feet.
#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <map>

#include "actors/judge/inspect/site.hpp"
#include "scenes/light/geometry/closed_mesh.hpp"

namespace luxodus {

namespace {

/// Floors have at least this area, unless they are in another unit; and are at most this thin [m].
constexpr double min_storey_area_m2 = 1e-4;
constexpr double level_cosine = 0.99;
/// Number of distinct levels over the building's height.
constexpr int level_bins = 400;
/// Share of a building's bounds that a floor, and a ceiling above it, cover.
constexpr double floor_share = 0.5;
/// Clear heights of storeys and halls; and those that a guessed unit should give [m].
constexpr double min_clear_m = 1.9;
constexpr double max_clear_m = 20;
constexpr double usual_low_m = 2.2;
constexpr double usual_high_m = 4.5;
/// A building on its side: as thin as a storey is high, much higher than that, with its largest
/// areas vertical [m].
constexpr double min_storey_m = 2.2;
constexpr double max_storey_m = 4.5;
constexpr double min_aside_m = 6;
constexpr double times_more = 2;
/// A vertical floor of this size is not the front of a step [m2].
constexpr double min_named_floor_m2 = 2;

/// Sizes of door leaves [m], and of those whose feet were read as metres.
constexpr glm::dvec2 leaf_width_m{0.55, 1.6}, leaf_height_in_m{1.8, 2.9};
constexpr double metres_of_a_foot = 0.3048;
/// Faces of signs are mostly 0.1 to 0.3 m high; a single door is taken to be in feet only if all
/// signs are this high [m].
constexpr double sign_in_feet_m = 0.45;

struct Sided {
  glm::dvec3 along{0};  // area whose normal lies along x, y, z
  double all = 0;
};

/// Calls `use(area, normal, z)` for every triangle.
template <class Use>
void each_triangle(const Mesh& mesh, const Use& use) {
  for (const glm::uvec3& t : mesh.triangles) {
    const glm::dvec3 &a = mesh.positions[t.x], &b = mesh.positions[t.y], &c = mesh.positions[t.z];
    const glm::dvec3 across = glm::cross(b - a, c - a);
    const double twice = glm::length(across);
    if (twice > 0) use(twice / 2, across / twice, (a.z + b.z + c.z) / 3);
  }
}

Sided sided(const std::vector<const Object*>& parts) {
  Sided out;
  for (const Object* part : parts)
    each_triangle(part->mesh, [&](double area, const glm::dvec3& normal, double) {
      out.all += area;
      for (int axis = 0; axis < 3; ++axis)
        if (std::abs(normal[axis]) > level_cosine) out.along[axis] += area;
    });
  return out;
}

/// The faces of shape = "room" are not an import, and their numbers are in the scene.
bool is_room_shape(const std::vector<const Object*>& parts) {
  return std::all_of(parts.begin(), parts.end(), [](const Object* part) {
    const std::string face = part->name.substr(part->name.find('.') + 1);
    return face == "floor" || face == "ceiling" || face == "x0" || face == "x1" || face == "y0" ||
           face == "y1";
  });
}

bool is_called(const Object& part, std::initializer_list<const char*> words) {
  std::string name = part.name.substr(part.name.find('.') + 1);
  std::transform(name.begin(), name.end(), name.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return std::any_of(words.begin(), words.end(), [&](const char* word) {
    const size_t at = name.find(word);
    return at != std::string::npos &&
           (at == 0 || std::isalpha(static_cast<unsigned char>(name[at - 1])) == 0);
  });
}

/// A part called a floor or a ceiling that is vertical.
const Object* upright_floor(const std::vector<const Object*>& parts) {
  for (const Object* part : parts) {
    if (!is_called(*part, {"floor", "ceiling", "slab", "boden", "decke", "plafond"})) continue;
    const Sided area = sided({part});
    const double upright = std::max(area.along.x, area.along.y);
    if (upright >= min_named_floor_m2 && upright > 0.9 * area.all) return part;
  }
  return nullptr;
}

const char* lies_on_side = "an import says which axis points up in its file: 'up' = \"y\" or \"z\"";

void tell_on_side(const std::vector<const Object*>& parts, const Bounds& box,
                  const std::string& name, Findings& out) {
  if (const Object* floor = upright_floor(parts)) {
    out.push_back({Severity::warning,
                   "turned",
                   {parts.front()->place,
                    fmt::format("\"{}\" lies on its side: its part \"{}\" stands upright; {}", name,
                                floor->name, lies_on_side)}});
    return;
  }
  const glm::dvec3 size = box.high - box.low;
  const int thin = size.x < size.y ? 0 : 1;
  const bool storey = size[thin] >= min_storey_m && size[thin] <= max_storey_m;
  if (!storey || size.z < min_aside_m || size.z < times_more * size[thin] ||
      size[1 - thin] < times_more * size[thin])
    return;
  const Sided area = sided(parts);
  if (area.along[thin] < times_more * area.along.z || area.along[thin] < 0.3 * area.all) return;
  out.push_back(
      {Severity::warning,
       "turned",
       {parts.front()->place,
        fmt::format("\"{}\" is {} high and only {} wide, and its largest areas are upright: does "
                    "it lie on its side? {}",
                    name, length_text(size.z), length_text(size[thin]), lies_on_side)}});
}

/// Height from the largest floor of a building to the ceiling above it; none if either is missing.
std::optional<double> clear_height(const std::vector<const Object*>& parts, const Bounds& box) {
  const glm::dvec3 size = box.high - box.low;
  if (!(size.z > 0) || size.x * size.y < min_storey_area_m2) return std::nullopt;
  std::array<double, level_bins + 1> up{}, down{};
  for (const Object* part : parts)
    each_triangle(part->mesh, [&](double area, const glm::dvec3& normal, double z) {
      if (std::abs(normal.z) < level_cosine) return;
      const auto bin = static_cast<size_t>((z - box.low.z) / size.z * level_bins);
      (normal.z > 0 ? up : down)[std::min<size_t>(bin, level_bins)] += area;
    });
  const auto floor = std::max_element(up.begin(), up.end()) - up.begin();
  const double plan = floor_share * size.x * size.y;
  if (up[static_cast<size_t>(floor)] < plan) return std::nullopt;
  for (auto at = static_cast<size_t>(floor) + 1; at < down.size(); ++at)
    if (down[at] >= plan)
      return (static_cast<double>(at) - static_cast<double>(floor)) / level_bins * size.z;
  return std::nullopt;
}

/// Says what the file's numbers would give in another unit. Only ratios are known, since the unit
/// of the import is not kept.
std::string unit_guess(double clear_m) {
  struct Ratio {
    double factor;
    const char* words;
  };
  static constexpr Ratio ratios[] = {
      {0.0254, "inches read as metres"},      {2.54, "inches read as centimetres"},
      {25.4, "inches read as millimetres"},   {0.001, "millimetres read as metres"},
      {1000, "metres read as millimetres"},   {0.01, "centimetres read as metres"},
      {100, "metres read as centimetres"},    {0.1, "millimetres read as centimetres"},
      {10, "centimetres read as millimetres"}};
  std::string guess;
  for (const Ratio& r : ratios) {
    const double meant = clear_m * r.factor;
    if (meant < usual_low_m || meant > usual_high_m) continue;
    guess += (guess.empty() ? "" : ", or ") +
             fmt::format("{} (it would be {})", r.words, length_text(meant));
  }
  return guess.empty() ? "?" : ": " + guess + "?";
}

/// Width and height of a part that may be a door leaf: upright and thin.
std::optional<glm::dvec2> leaf_size(const Object& part) {
  if (part.mesh.positions.empty() || is_furniture(part)) return std::nullopt;
  if (!part.door && !is_called(part, {"door", "tuer", "tür", "porte"})) return std::nullopt;
  Bounds box;
  for (const glm::dvec3& p : part.mesh.positions) box.extend(p);
  const glm::dvec3 size = box.high - box.low;
  return glm::dvec2(std::hypot(size.x, size.y), size.z);
}

bool between(const glm::dvec2& range, double value) {
  return value >= range.x && value <= range.y;
}

}  // namespace

void inspect_feet(const SceneDescription& scene, Findings& out) {
  const Object* first = nullptr;
  size_t in_feet = 0;
  double height = 0;
  for (const Object& object : scene.objects) {
    const auto leaf = leaf_size(object);
    if (!leaf) continue;
    if (between(leaf_width_m, leaf->x) && between(leaf_height_in_m, leaf->y)) return;
    if (!between(leaf_width_m / metres_of_a_foot, leaf->x) ||
        !between(leaf_height_in_m / metres_of_a_foot, leaf->y))
      continue;
    ++in_feet;
    height = leaf->y;
    if (first == nullptr) first = &object;
  }
  const bool large_signs = !scene.signs.empty() &&
                           std::all_of(scene.signs.begin(), scene.signs.end(),
                                       [](const Sign& s) { return s.height_m >= sign_in_feet_m; });
  // A single gate of a hall can have this size.
  if (in_feet == 0 || (in_feet == 1 && !large_signs)) return;
  out.push_back({Severity::warning,
                 "unit",
                 {first->place,
                  fmt::format("{} {} high, as no door is, and {} if that is in feet: lengths of a "
                              "scene are in metres; an import says units = \"ft\"",
                              in_feet == 1 ? "the door \"" + first->name + "\" is"
                                           : fmt::format("all {} doors, \"{}\" first, are", in_feet,
                                                         first->name),
                              length_text(height), length_text(height * metres_of_a_foot))}});
}

void inspect_imports(const SceneDescription& scene, Findings& out) {
  std::map<std::pair<std::string, int>, std::vector<const Object*>> tables;
  for (const Object& object : scene.objects)
    if (object.name.find('.') != std::string::npos && !is_furniture(object) &&
        !object.mesh.positions.empty())
      tables[{object.place.file, object.place.line}].push_back(&object);
  for (const auto& [table, parts] : tables) {
    if (is_room_shape(parts)) continue;
    const std::string name = parts.front()->name.substr(0, parts.front()->name.find('.'));
    Bounds box;
    for (const Object* part : parts)
      for (const glm::dvec3& p : part->mesh.positions) box.extend(p);
    tell_on_side(parts, box, name, out);
    if (no_buildings_size(box.high - box.low)) continue;  // reported for the whole
    const auto clear = clear_height(parts, box);
    if (!clear || (*clear >= min_clear_m && *clear <= max_clear_m)) continue;
    out.push_back({Severity::warning,
                   "unit",
                   {parts.front()->place,
                    fmt::format("\"{}\" is {} from its floor to its ceiling, as no storey is: is "
                                "its unit right{} An import says units = \"m\", \"cm\", \"mm\", "
                                "\"in\" or \"ft\"",
                                name, length_text(*clear), unit_guess(*clear))}});
  }
}

void inspect_open_solids(const SceneDescription& scene, Findings& out) {
  for (const Object& object : scene.objects) {
    if (std::find(object.tags.begin(), object.tags.end(), "open solid") == object.tags.end())
      continue;
    const double area = open_edges(object.mesh).area_m2;
    out.push_back(
        {Severity::warning,
         "open solid",
         {object.place,
          fmt::format("\"{}\" is a solid in its model, but its shape is not closed{}: light "
                      "passes where a face is missing; draw the body in another way in "
                      "the model, or the missing face in the scene",
                      object.name,
                      area > 0 ? fmt::format(" ({:.3g} m2 are missing)", area) : "")}});
  }
}

}  // namespace luxodus
