#include "actors/results/files/glb_export.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <tuple>

#include "actors/results/files/maps.hpp"
#include "scenes/light/geometry/patches.hpp"
#include "scenes/light/transport/packed_scene.hpp"
#include "scenes/light/transport/readout.hpp"

namespace luxodus {

namespace {

constexpr double lit_share_below_white = 0.98;
/// Corners closer than this are merged [m]; so are normals that differ by less.
constexpr float one_place_m = 1e-4f, same_normal = 1e-2f;

/// Reflected light of a patch: luminance as XYZ [cd/m2] of a surface that scatters evenly.
using PatchXyz = std::array<double, 3>;

/// XYZ of light with these watts in each band, Y in lumens.
template <class WattsOf>
std::array<double, 3> xyz_of_bands(const Bands& bands, const WattsOf& watts_of) {
  std::array<double, 3> out{};
  for (int b = 0; b < bands.count(); ++b) {
    const Band& band = bands[b];
    const double watts = watts_of(b);
    out[0] += watts * band.x_per_w;
    out[1] += watts * band.lm_per_w;
    out[2] += watts * band.z_per_w;
  }
  return out;
}

/// The corners of one side of a surface, merged by place and normal, with the light of their
/// patches.
class SideOfSurface {
 public:
  void add(const std::array<glm::vec3, 3>& corners, const glm::vec3& normal, const PatchXyz& light,
           double area_m2) {
    for (const glm::vec3& corner : corners) {
      const uint32_t index = index_of(corner, normal);
      for (size_t c = 0; c < 3; ++c) sums_[index][c] += area_m2 * light[c];
      areas_[index] += area_m2;
      triangles_.push_back(index);
    }
    sent_ += area_m2 * light[1];
  }

  bool sends_light() const { return sent_ > 0; }

  GlbMesh mesh(const std::string& name, double white_cd_m2) const {
    GlbMesh out;
    out.name = name;
    out.points = points_;
    out.triangles = triangles_;
    for (size_t i = 0; i < points_.size(); ++i) {
      PatchXyz mean = sums_[i];
      for (double& c : mean) c /= areas_[i] * white_cd_m2;
      const auto rgb = linear_srgb_from_xyz(mean);
      // Clamps colours outside the gamut of screens.
      out.colours.push_back(glm::clamp(glm::vec3(rgb[0], rgb[1], rgb[2]), 0.0f, 1.0f));
    }
    return out;
  }

 private:
  using Key = std::tuple<int64_t, int64_t, int64_t, int64_t, int64_t, int64_t>;

  uint32_t index_of(const glm::vec3& p, const glm::vec3& n) {
    const auto step = [](float value, float unit) { return std::llround(value / unit); };
    const Key key{step(p.x, one_place_m), step(p.y, one_place_m), step(p.z, one_place_m),
                  step(n.x, same_normal), step(n.y, same_normal), step(n.z, same_normal)};
    const auto [at, is_new] = indices_.try_emplace(key, static_cast<uint32_t>(points_.size()));
    if (is_new) {
      points_.push_back(p);
      sums_.push_back({});
      areas_.push_back(0);
    }
    return at->second;
  }

  std::map<Key, uint32_t> indices_;
  std::vector<glm::vec3> points_;
  std::vector<PatchXyz> sums_;  // weighted by area
  std::vector<double> areas_;   // [m2]
  std::vector<uint32_t> triangles_;
  double sent_ = 0;
};

/// Areas sorted by luminance.
class LitArea {
 public:
  void add(double luminance, double area_m2) {
    if (luminance > 0) parts_.push_back({luminance, area_m2});
  }
  /// The luminance that this share of the lit area stays below; 0 where nothing is lit.
  double luminance_above(double share) {
    std::sort(parts_.begin(), parts_.end());
    double all = 0, below = 0;
    for (const auto& [luminance, area] : parts_) all += area;
    for (const auto& [luminance, area] : parts_) {
      below += area;
      if (below >= share * all) return luminance;
    }
    return 0;
  }

 private:
  std::vector<std::pair<double, double>> parts_;
};

class Collector {
 public:
  explicit Collector(const LocalRun& run)
      : scene_(run.scene()), readout_(run.scene(), run.totals()), sides_(scene_.surfaces.size()) {}

  void add(const TriangleRecord& t) {
    const uint32_t n = t.subdivision, patches = n * n;
    const double area = scene_.surfaces[t.surface].patch_area_m2(t);
    const glm::vec3 a = t.corner[0], b = t.corner[1], c = t.corner[2];
    const glm::vec3 normal = glm::normalize(glm::cross(b - a, c - a));
    for (uint32_t k = 0; k < patches; ++k) {
      const auto uv = sub_triangle_corners(k, n);
      std::array<glm::vec3, 3> corners;
      for (size_t i = 0; i < 3; ++i) {
        const auto u = static_cast<float>(uv[i].x), v = static_cast<float>(uv[i].y);
        corners[i] = a * (1 - u - v) + b * u + c * v;
      }
      for (uint32_t side = 0; side < 2; ++side) {
        const PatchXyz light = xyz_of(t.first_patch + side * patches + k, area);
        lit_.add(light[1], area);
        if (side == 1) std::swap(corners[1], corners[2]);
        sides_[t.surface][side].add(corners, side == 0 ? normal : -normal, light, area);
      }
    }
  }

  double usual_white() { return lit_.luminance_above(lit_share_below_white); }

  std::vector<GlbMesh> meshes(double white_cd_m2) const {
    std::vector<GlbMesh> out;
    for (size_t i = 0; i < sides_.size(); ++i) {
      const auto& [front, back] = sides_[i];
      const std::string& name = scene_.surfaces[i].name;
      if (front.sends_light() || !back.sends_light()) give(front, name, white_cd_m2, out);
      if (back.sends_light())
        give(back, front.sends_light() ? name + " (back)" : name, white_cd_m2, out);
    }
    return out;
  }

 private:
  PatchXyz xyz_of(uint32_t patch, double area_m2) const {
    PatchXyz out = xyz_of_bands(scene_.bands, [&](int band) {
      return readout_.watts(scene_.blocks.patches, patch, band, 1).value;
    });
    for (double& c : out) c /= std::numbers::pi * area_m2;
    return out;
  }

  static void give(const SideOfSurface& side, const std::string& name, double white_cd_m2,
                   std::vector<GlbMesh>& out) {
    GlbMesh mesh = side.mesh(name, white_cd_m2);
    if (!mesh.triangles.empty()) out.push_back(std::move(mesh));
  }

  const CompiledScene& scene_;
  const Readout readout_;
  std::vector<std::array<SideOfSurface, 2>> sides_;
  LitArea lit_;
};

/// Linear RGB of an emitter's light, the largest component 1.
std::array<double, 3> colour_of(const CompiledScene& scene, const CompiledEmitter& emitter) {
  const auto xyz = xyz_of_bands(
      scene.bands, [&](int band) { return emitter.power_w[static_cast<size_t>(band)]; });
  std::array<double, 3> rgb = linear_srgb_from_xyz(xyz);
  const double most = std::max({rgb[0], rgb[1], rgb[2]});
  if (!(most > 0)) return {1, 1, 1};
  for (double& c : rgb) c = std::clamp(c / most, 0.0, 1.0);
  return rgb;
}

bool shines_one_way(const CompiledEmitter& emitter) {
  return emitter.distribution != Distribution::isotropic && emitter.medium == none_index &&
         emitter.kind != EmitterKind::sphere;
}

/// A punctual light has no intensity distribution: a cone of the same flux replaces it. In a cone
/// of 90 degrees the intensity of KHR_lights_punctual falls with the square of the cosine, whose
/// integral is 2 pi / 3 of the intensity on its axis.
GlbLight light_of(const CompiledScene& scene, const CompiledEmitter& emitter) {
  GlbLight out;
  out.name = emitter.name;
  out.position = glm::dvec3(emitter.origin);
  out.colour = colour_of(scene, emitter);
  out.extras = {{"flux_lm", emitter.luminous_flux_lm}};
  if (shines_one_way(emitter)) {
    out.direction = -glm::dvec3(emitter.axes[2]);
    out.outer_rad = std::numbers::pi / 2;
    out.intensity_cd = 3 * emitter.luminous_flux_lm / (2 * std::numbers::pi);
  } else {
    out.intensity_cd = emitter.luminous_flux_lm / (4 * std::numbers::pi);
  }
  return out;
}

GlbCamera camera_of(const CompiledScene& scene, const Camera& camera) {
  return {camera.name,
          camera.eye - scene.local_origin,
          camera.target - scene.local_origin,
          camera.up,
          glm::radians(camera.vertical_fov_deg),
          static_cast<double>(camera.width) / camera.height};
}

}  // namespace

Result<GlbScene> glb_scene_of(const LocalRun& run, const GlbOptions& options) {
  const CompiledScene& scene = run.scene();
  const SceneDescription& description = *scene.description;
  if (scene.patch_count / 2 > limits::triangles_drawn)
    return problem_in(description.file,
                      fmt::format("{} patches are more than programs take ({}): trace the scene "
                                  "with a larger patch_edge_m",
                                  scene.patch_count / 2, limits::triangles_drawn));
  Collector collector(run);
  const auto read = for_each_cell(scene, [&](const GeometryCell& cell) {
    for (const TriangleRecord& t : cell.triangles) collector.add(t);
  });
  if (!read) return read.problem();
  const double white = options.white_cd_m2 > 0 ? options.white_cd_m2 : collector.usual_white();
  if (!(white > 0))
    return problem_in(description.file,
                      "no surface of the run sends light back: there is nothing "
                      "to show");
  GlbScene out;
  out.generator = options.generator;
  out.title = description.title.empty() ? description.name : description.title;
  out.origin = scene.local_origin;
  out.meshes = collector.meshes(white);
  for (const CompiledEmitter& emitter : scene.emitters)
    if (emitter.sign == none_index && emitter.luminous_flux_lm > 0)
      out.lights.push_back(light_of(scene, emitter));
  for (const Camera& camera : description.cameras) out.cameras.push_back(camera_of(scene, camera));
  out.extras = {{"white_cd_m2", white}};
  return out;
}

}  // namespace luxodus
