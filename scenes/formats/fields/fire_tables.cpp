#include "scenes/formats/fields/fire_tables.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace luxodus {

std::string material_table(const FireMaterial& material) {
  std::string out = fmt::format(
      "[[material]]\nname = \"{}\"\nkind = \"lambertian\"\nreflectance = {{ srgb = [{:.4g}, "
      "{:.4g}, {:.4g}] }}\n",
      material.name, material.rgb.x, material.rgb.y, material.rgb.z);
  if (material.opacity < 1)
    out += fmt::format(
        "# FDS displays it with an opacity of {:.3g}. If light comes through, take instead of the "
        "two\n# lines above: kind = \"glass\"\n",
        material.opacity);
  return out;
}

namespace fds {

namespace {

/// The range of `appears_at` and `vanishes_at` [s].
constexpr double last_turn_s = 1e6;

std::string metres_text(const glm::dvec3& p) {
  return fmt::format("[{:.10g}, {:.10g}, {:.10g}]", p.x, p.y, p.z);
}

/// "vanishes_at = [40.06]"; nothing where there are none.
std::string times_text(const char* key, const std::vector<double>& times) {
  std::string out;
  for (const double time : times) out += fmt::format("{}{:.10g}", out.empty() ? "" : ", ", time);
  return out.empty() ? "" : fmt::format("{} = [{}]\n", key, out);
}

std::string hexadecimal(const glm::dvec3& rgb) {
  const auto byte = [](double v) { return static_cast<int>(std::lround(255 * v)); };
  return fmt::format("#{:02x}{:02x}{:02x}", byte(rgb.x), byte(rgb.y), byte(rgb.z));
}

}  // namespace

FireTimes times_of_turns(std::vector<FireTurn> turns) {
  FireTimes out;
  if (turns.empty()) return out;
  std::stable_sort(turns.begin(), turns.end(),
                   [](const FireTurn& a, const FireTurn& b) { return a.at_s < b.at_s; });
  // An object whose first change is to appear was absent before.
  const bool at_start = !turns.front().appears;
  for (FireTurn& turn : turns) turn.at_s = std::max(turn.at_s, -last_turn_s);
  bool there = at_start;
  for (size_t i = 0; i < turns.size() && turns[i].at_s <= last_turn_s; ++i) {
    const bool is_last = i + 1 == turns.size() || turns[i + 1].at_s > turns[i].at_s;
    if (!is_last || turns[i].appears == there) continue;
    there = turns[i].appears;
    (there ? out.appears : out.vanishes).push_back(turns[i].at_s);
  }
  // An object that never appears is written to appear at the end of the time range.
  if (!at_start && out.appears.empty()) out.appears.push_back(last_turn_s);
  return out;
}

std::string scene_name(const std::string& name, const std::string& otherwise) {
  std::string out;
  for (const char c : name) {
    const auto u = static_cast<unsigned char>(c);
    out += u < 0x20 || u >= 0x7f || c == '"' || c == '/' || c == '\\' ? '_' : c;
  }
  while (!out.empty() && (out.front() == ' ' || out.front() == '.')) out.erase(0, 1);
  constexpr size_t longest = 120;
  out.resize(std::min(out.size(), longest));
  while (!out.empty() && out.back() == ' ') out.pop_back();
  return out.empty() ? otherwise : out;
}

const std::string& FireTables::material(const FireLook& look) {
  const std::string own = look.rgb ? " " + hexadecimal(*look.rgb) : "";
  const std::string key = fmt::format("{}\n{}{}\n{:.3g}", look.surface,
                                      hexadecimal(look.surface_rgb), own, look.opacity);
  const auto [at, fresh] = places_.try_emplace(key, materials_.size());
  if (fresh) {
    const std::string base = scene_name(look.surface, "surface") + own;
    std::string name = base;
    for (size_t i = 2; !material_names_.insert(name).second; ++i)
      name = fmt::format("{} {}", base, i);
    materials_.push_back({name, look.rgb.value_or(look.surface_rgb), look.opacity});
  }
  return materials_[at->second].name;
}

std::string FireTables::name(const std::string& base) {
  for (;;) {
    const size_t number = ++numbers_[base];
    std::string name = number == 1 ? base : fmt::format("{} {}", base, number);
    if (object_names_.insert(name).second) return name;
  }
}

void FireTables::object(const std::string& base, const std::string& shape, const FireLook& look,
                        const FireTimes& times) {
  ++objects_;
  text_ += fmt::format("[[object]]\nname = \"{}\"\n{}material = \"{}\"\n{}{}\n", name(base), shape,
                       material(look), times_text("appears_at", times.appears),
                       times_text("vanishes_at", times.vanishes));
}

void FireTables::box(const std::string& base, const glm::dvec3& low, const glm::dvec3& high,
                     const FireLook& look, const FireTimes& times) {
  object(base,
         fmt::format("shape = \"box\"\nlow = {}\nhigh = {}\n", metres_text(low), metres_text(high)),
         look, times);
}

void FireTables::quad(const std::string& base, const glm::dvec3& corner, const glm::dvec3& edge_u,
                      const glm::dvec3& edge_v, const FireLook& look, const FireTimes& times) {
  object(base,
         fmt::format("shape = \"quad\"\ncorner = {}\nedge_u = {}\nedge_v = {}\n",
                     metres_text(corner), metres_text(edge_u), metres_text(edge_v)),
         look, times);
}

void FireTables::plate(const std::string& base, const glm::dvec3& low, const glm::dvec3& high,
                       int across, const FireLook& look, const FireTimes& times) {
  const int u = (across + 1) % 3, v = (across + 2) % 3;
  glm::dvec3 edge_u(0), edge_v(0);
  edge_u[u] = high[u] - low[u];
  edge_v[v] = high[v] - low[v];
  quad(base, low, edge_u, edge_v, look, times);
}

void FireTables::face(int face, const glm::dvec3& low, const glm::dvec3& high,
                      const FireLook& look) {
  const char* const names[] = {"west wall",  "east wall", "south wall",
                               "north wall", "floor",     "ceiling"};
  const int across = face / 2;
  const int u = (across + 1) % 3, v = (across + 2) % 3;
  glm::dvec3 edge_u(0), edge_v(0);
  edge_u[u] = high[u] - low[u];
  edge_v[v] = high[v] - low[v];
  if (face % 2 == 1)
    quad(names[face], low, edge_v, edge_u, look);
  else
    quad(names[face], low, edge_u, edge_v, look);
}

}  // namespace fds
}  // namespace luxodus
