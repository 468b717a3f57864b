#include "actors/apps/view/lamps.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <utility>

#include "scenes/light/optics/spectrum.hpp"
#include "scenes/light/transport/emission.hpp"

namespace luxodus {

namespace {

struct Webs {
  const CompiledScene* scene;
  const PhotometricWeb& web(uint32_t i) const { return *scene->webs[i]; }
};

bool is_flat(const CompiledEmitter& e) {
  return e.kind == EmitterKind::rectangle || e.kind == EmitterKind::disc;
}

/// Density in a direction in the frame of the table, whose pole is the luminaire's local -Z or a
/// normal. The cosine is never 0: centres of cells are half a cell away from the plane of the face.
double brightness(const CompiledScene& scene, const CompiledEmitter& e, double polar,
                  double azimuth) {
  const double across = std::sin(polar);
  const glm::dvec3 direction(across * std::cos(azimuth), across * std::sin(azimuth),
                             -std::cos(polar));
  const double cosine = std::abs(direction.z);
  if (e.distribution == Distribution::web) {
    // In the luminaire's own frame, so that luminaires with other orientations share the table.
    const double density = scene.webs[e.web]->pdf(direction);
    return is_flat(e) ? density / cosine : density;
  }
  const Webs webs{&scene};
  const auto density = static_cast<double>(
      directional_density(e, {e.origin, Vec3(0, 0, -1)}, Vec3(direction), webs));
  return density / cosine;
}

LampTable table_of(const CompiledScene& scene, const CompiledEmitter& e) {
  std::vector<double> values;
  for (int p = 0; p < limits::lamp_polar; ++p)
    for (int a = 0; a < limits::lamp_azimuth; ++a)
      values.push_back(brightness(scene, e, std::numbers::pi * (p + 0.5) / limits::lamp_polar,
                                  2 * std::numbers::pi * (a + 0.5) / limits::lamp_azimuth));
  LampTable out;
  out.peak = *std::max_element(values.begin(), values.end());
  for (const double value : values) {
    const auto word =
        static_cast<uint32_t>(std::lround(out.peak > 0 ? 65535 * value / out.peak : 0));
    out.values.push_back(static_cast<char>(word & 0xff));
    out.values.push_back(static_cast<char>(word >> 8));
  }
  return out;
}

/// The tables of a scene, without duplicates.
class LampTables {
 public:
  LampTables(const CompiledScene& scene, std::vector<LampTable>& tables)
      : scene_(scene), tables_(tables) {}

  /// The table of an emitter; none if it emits nothing, or if the limit is reached.
  std::optional<uint32_t> index_of(const CompiledEmitter& e) {
    if (e.distribution != Distribution::web) return index_of(table_of(scene_, e));
    const std::pair key(e.web, is_flat(e));
    const auto known = of_webs_.find(key);
    if (known != of_webs_.end()) return known->second;
    return of_webs_[key] = index_of(table_of(scene_, e));
  }

 private:
  std::optional<uint32_t> index_of(LampTable table) {
    if (!(table.peak > 0 && table.peak <= limits::view_lamp_peak)) return std::nullopt;
    const auto known = std::find(tables_.begin(), tables_.end(), table);
    const auto index = static_cast<uint32_t>(known - tables_.begin());
    if (known == tables_.end()) {
      if (tables_.size() == limits::view_lamp_tables) return std::nullopt;
      tables_.push_back(std::move(table));
    }
    return index;
  }

  const CompiledScene& scene_;
  std::vector<LampTable>& tables_;
  std::map<std::pair<uint32_t, bool>, std::optional<uint32_t>> of_webs_;
};

/// Colours brighter than pages read are reduced to their limit, which looks white.
std::array<double, 3> readable_colour(std::array<double, 3> rgb) {
  double most = 0;
  for (const double c : rgb) most = std::max(most, std::abs(c));
  if (most > limits::view_lamp_colour)
    for (double& c : rgb) c *= limits::view_lamp_colour / most;
  return rgb;
}

LiveLamp lamp_of(const CompiledScene& scene, const CompiledEmitter& e) {
  LiveLamp out;
  out.group = scene.groups[static_cast<size_t>(e.group)].name;
  out.kind = e.kind;
  out.origin = scene.local_origin + glm::dvec3(e.origin);
  for (int k = 0; k < 3; ++k) out.axes[static_cast<size_t>(k)] = glm::dvec3(e.axes[k]);
  out.size = glm::dvec3(e.size);
  for (const Vec3& corner : e.corners)
    out.corners.push_back(scene.local_origin + glm::dvec3(corner));
  std::array<double, 3> xyz{};
  for (int b = 0; b < scene.bands.count(); ++b) {
    const double exitance = e.power_w[static_cast<size_t>(b)] / e.area_m2;
    xyz[0] += exitance * scene.bands[b].x_per_w;
    xyz[1] += exitance * scene.bands[b].lm_per_w;
    xyz[2] += exitance * scene.bands[b].z_per_w;
  }
  out.colour = readable_colour(linear_srgb_from_xyz(xyz));
  out.of_luminaire = e.distribution == Distribution::web;
  return out;
}

bool is_shown(const CompiledEmitter& e) {
  const double widest = static_cast<double>(std::max({e.size.x, e.size.y, e.size.z}));
  return has_own_face(e) && e.distribution != Distribution::collimated && e.area_m2 > 0 &&
         e.luminous_flux_lm > 0 && widest <= limits::view_lamp_m &&
         e.corners.size() <= 3 * limits::view_lamp_triangles;
}

}  // namespace

LiveLamps lamps_of(const CompiledScene& scene) {
  LiveLamps out;
  LampTables tables(scene, out.tables);
  size_t corners = 0;
  for (const CompiledEmitter& e : scene.emitters) {
    if (out.lamps.size() == limits::view_lamps) break;
    if (!is_shown(e) || corners + e.corners.size() > limits::view_lamp_corners) continue;
    const auto table = tables.index_of(e);
    if (!table) continue;
    corners += e.corners.size();
    out.lamps.push_back(lamp_of(scene, e));
    out.lamps.back().table = *table;
  }
  return out;
}

}  // namespace luxodus
