#include "actors/view/lamps.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "scenes/optics/spectrum.hpp"
#include "scenes/transport/emission.hpp"

namespace luxodus {

namespace {

/// A photometric file says intensities, which a flat face at grazing angles divides by next to
/// nothing: nearer to its plane than this cosine it looks as it does there.
constexpr double least_lamp_cosine = 0.02;

struct Webs {
  const CompiledScene* scene;
  const PhotometricWeb& web(uint32_t i) const { return *scene->webs[i]; }
};

/// Of a direction in the frame of the table: its pole is the luminaire's local -Z, or a normal.
double brightness(const CompiledScene& scene, const CompiledEmitter& e, double polar,
                  double azimuth) {
  const bool of_luminaire = e.distribution == Distribution::web;
  const Vec3 pole = of_luminaire ? -e.axes[2] : Vec3(0, 0, 1);
  const Vec3 x = of_luminaire ? e.axes[0] : Vec3(1, 0, 0);
  const Vec3 y = of_luminaire ? e.axes[1] : Vec3(0, 1, 0);
  const auto across = static_cast<Real>(std::sin(polar));
  const Vec3 direction = pole * static_cast<Real>(std::cos(polar)) +
                         x * (across * static_cast<Real>(std::cos(azimuth))) +
                         y * (across * static_cast<Real>(std::sin(azimuth)));
  const Webs webs{&scene};
  const auto density =
      static_cast<double>(directional_density(e, {e.origin, pole}, direction, webs));
  return density / std::max(least_lamp_cosine, std::abs(std::cos(polar)));
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
  out.colour = linear_srgb_from_xyz(xyz);
  out.of_luminaire = e.distribution == Distribution::web;
  return out;
}

bool is_shown(const CompiledEmitter& e) {
  return has_own_face(e) && e.distribution != Distribution::collimated && e.area_m2 > 0 &&
         e.luminous_flux_lm > 0 && e.corners.size() <= 3 * limits::view_lamp_triangles;
}

}  // namespace

LiveLamps lamps_of(const CompiledScene& scene) {
  LiveLamps out;
  for (const CompiledEmitter& e : scene.emitters) {
    if (out.lamps.size() == limits::view_lamps) break;
    if (!is_shown(e)) continue;
    LampTable table = table_of(scene, e);
    if (!(table.peak > 0)) continue;
    LiveLamp lamp = lamp_of(scene, e);
    const auto known = std::find(out.tables.begin(), out.tables.end(), table);
    lamp.table = static_cast<uint32_t>(known - out.tables.begin());
    if (known == out.tables.end()) out.tables.push_back(std::move(table));
    out.lamps.push_back(std::move(lamp));
  }
  return out;
}

}  // namespace luxodus
