#include "actors/apps/view/frames.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <glm/gtc/packing.hpp>
#include <numbers>
#include <unordered_map>

#include "scenes/light/geometry/patches.hpp"
#include "scenes/light/optics/media_set.hpp"
#include "scenes/light/optics/spectrum.hpp"
#include "scenes/light/transport/detectors.hpp"
#include "scenes/light/transport/flame_points.hpp"
#include "scenes/light/transport/packed_scene.hpp"
#include "scenes/light/transport/resolver.hpp"

namespace luxodus {

namespace {

enum class FrameKind : uint32_t { geometry = 1, light = 2, smoke = 3, smoke_light = 4 };

/// Front and back, r g b and illuminance each, as half floats.
constexpr size_t triangle_light_bytes = 2 * 4 * sizeof(uint16_t);
/// A white surface in the light, behind that of triangles: three halves.
constexpr size_t white_light_bytes = 3 * sizeof(uint16_t);
constexpr double pi = std::numbers::pi;
/// The largest half float: brighter patches are shown as bright as this [cd/m2, lx].
constexpr float max_half = 65504;

/// Writes values in wire order, little endian like every supported machine.
class Writer {
 public:
  Writer(FrameKind kind, uint32_t generation, uint32_t a, uint32_t b = 0) {
    for (const uint32_t word : {static_cast<uint32_t>(kind), generation, a, b}) put(word);
  }
  template <class T>
  void put(T value) {
    char bytes[sizeof value];
    std::memcpy(bytes, &value, sizeof value);
    text_.append(bytes, sizeof value);
  }
  void half(double value) {
    put(glm::packHalf1x16(glm::clamp(static_cast<float>(value), -max_half, max_half)));
  }
  LiveFrame take() { return std::make_shared<const std::string>(std::move(text_)); }

 private:
  std::string text_;
};

/// A bin whose relative error exceeds this blends its own colour into its group's mean: a path
/// carries one band, so with few paths luminances are right but colours are wrong.
constexpr double colour_known_at = 0.1;

using Colour = std::array<double, 3>;

/// A block of bins, and the factor that converts their values.
struct LightBins {
  uint32_t block = 0, quantity = 0;
  const std::vector<float>* factors = nullptr;  // by bin and band; null: 1
};

/// One source group's light in the bins of a block as linear sRGB, whose weighted sum is the
/// luminance.
class GroupColours {
 public:
  GroupColours(const Readout& readout, const CompiledScene& scene, const LightBins& bins, int group)
      : readout_(readout), scene_(scene), bins_(bins), group_(group) {}

  /// Adds a bin to the group's mean colour.
  void learn(uint32_t bin) {
    const Colour xyz = xyz_of(bin);
    for (size_t i = 0; i < 3; ++i) mean_[i] += xyz[i];
  }
  /// The colour of a bin, with `per_watt`. Requires: every bin was learned.
  Colour of(uint32_t bin, double per_watt) const {
    const Colour own = xyz_of(bin);
    if (own[1] <= 0 || mean_[1] <= 0) return {};
    const double error = lumens(bin).relative_error();
    const double known =
        std::isfinite(error) ? 1 / (1 + error * error / (colour_known_at * colour_known_at)) : 0;
    Colour mixed;
    for (size_t i = 0; i < 3; ++i)
      mixed[i] = per_watt * (known * own[i] + (1 - known) * own[1] * mean_[i] / mean_[1]);
    return linear_srgb_from_xyz(mixed);
  }

 private:
  Estimate lumens(uint32_t bin) const {
    return readout_.lumens(bins_.block, bin, bins_.quantity, group_);
  }
  Colour xyz_of(uint32_t bin) const {
    Colour xyz{};
    const auto bands = static_cast<size_t>(scene_.bands.count());
    for (int b = 0; b < scene_.bands.count(); ++b) {
      const double factor =
          bins_.factors == nullptr
              ? 1
              : static_cast<double>((*bins_.factors)[bin * bands + static_cast<size_t>(b)]);
      if (factor == 0) continue;
      const double watts =
          factor * readout_.watts(bins_.block, bin, b, bins_.quantity, group_).value;
      const Band& band = scene_.bands[b];
      xyz[0] += watts * band.x_per_w;
      xyz[1] += watts * band.lm_per_w;
      xyz[2] += watts * band.z_per_w;
    }
    return xyz;
  }

  const Readout& readout_;
  const CompiledScene& scene_;
  const LightBins bins_;
  int group_;
  Colour mean_{};
};

double luminance_of(const Colour& rgb) {
  return 0.2126 * rgb[0] + 0.7152 * rgb[1] + 0.0722 * rgb[2];
}

void put_colour(Writer& out, const Colour& rgb) {
  for (const double channel : rgb) out.half(channel);
}

/// A white surface in the light that a group casts on the scene's surfaces: the mean over their
/// area on the sides that it reaches, as linear sRGB. Eyes among them take it as white.
Colour light_on_surfaces(const Readout& readout, const CompiledScene& scene,
                         const std::vector<LivePatch>& patches, int group) {
  Colour lumens{};
  double area_m2 = 0;
  for (const LivePatch& patch : patches)
    for (const uint32_t bin : {patch.front, patch.back}) {
      bool reached = false;
      for (int b = 0; b < scene.bands.count(); ++b) {
        const double watts = readout.watts(scene.blocks.patches, bin, b, 0, group).value;
        reached |= watts > 0;
        lumens[0] += watts * scene.bands[b].x_per_w;
        lumens[1] += watts * scene.bands[b].lm_per_w;
        lumens[2] += watts * scene.bands[b].z_per_w;
      }
      if (reached) area_m2 += patch.area_m2;
    }
  if (!(area_m2 > 0)) return {};
  for (double& v : lumens) v /= pi * area_m2;
  return linear_srgb_from_xyz(lumens);
}

/// Luminance and illuminance of both sides of each triangle; then the light on all of them.
LiveFrame surface_light(const CompiledScene& scene, const Readout& readout,
                        const std::vector<LivePatch>& patches, uint32_t generation, int group) {
  Writer out(FrameKind::light, generation, static_cast<uint32_t>(group));
  GroupColours colours(readout, scene, {scene.blocks.patches, 1}, group);
  for (const LivePatch& patch : patches)
    for (const uint32_t bin : {patch.front, patch.back}) colours.learn(bin);
  for (const LivePatch& patch : patches) {
    const double per_watt = 1 / (pi * patch.area_m2);
    for (const uint32_t bin : {patch.front, patch.back}) {
      put_colour(out, colours.of(bin, per_watt));
      out.half(readout.lumens(scene.blocks.patches, bin, 0, group).value / patch.area_m2);
    }
  }
  put_colour(out, light_on_surfaces(readout, scene, patches, group));
  return out.take();
}

/// Light emitted by those flames of a group that are not shown separately, by voxel: X, Y, Z.
std::unordered_map<uint32_t, Colour> flames_in_voxels(const CompiledScene& scene,
                                                      const SceneIndex& index,
                                                      const std::vector<LiveFlame>& apart,
                                                      int group) {
  std::unordered_map<uint32_t, Colour> out;
  for (const CompiledEmitter& e : scene.emitters) {
    if (e.group != group || e.kind != EmitterKind::volume) continue;
    if (std::any_of(apart.begin(), apart.end(),
                    [&](const LiveFlame& flame) { return flame.medium == e.medium; }))
      continue;
    Colour each{};  // of a point
    for (int b = 0; b < scene.bands.count(); ++b) {
      const double watts = e.power_w[static_cast<size_t>(b)] / limits::flame_points;
      each[0] += watts * scene.bands[b].x_per_w;
      each[1] += watts * scene.bands[b].lm_per_w;
      each[2] += watts * scene.bands[b].z_per_w;
    }
    MergedResolver resolver(scene, index);
    for (const glm::vec3& at : flame_points(scene.media, e.medium, resolver)) {
      const uint32_t voxel = voxel_of(scene.voxels, at);
      if (voxel == none_index) continue;
      for (size_t i = 0; i < each.size(); ++i) out[voxel][i] += each[i];
    }
  }
  return out;
}

/// Net flux of a group's light in a voxel relative to its fluence: its direction, and its degree.
glm::dvec3 drift(const Readout& readout, const CompiledScene& scene, uint32_t voxel, int group) {
  const auto lumens = [&](uint32_t quantity) {
    return readout.lumens(scene.blocks.voxels, voxel, quantity, group).value;
  };
  const double fluence = lumens(0);
  if (!(fluence > 0)) return glm::dvec3(0);
  const glm::dvec3 out = glm::dvec3(lumens(1), lumens(2), lumens(3)) / fluence;
  return out / std::max(1.0, glm::length(out));
}

/// Light emitted by a metre of each voxel, from scattering and flames, as the mean over directions;
/// and the scattered part as a vector along the light that it is scattered from.
LiveFrame smoke_light(const CompiledScene& scene, const SceneIndex& index, const Readout& readout,
                      const LiveSmoke& air, uint32_t generation, int group) {
  Writer out(FrameKind::smoke_light, generation, static_cast<uint32_t>(group));
  const auto edge = static_cast<double>(scene.voxels.edge);
  const double per_watt = 1 / (4 * pi * edge * edge * edge);
  const auto flames = flames_in_voxels(scene, index, *air.flames, group);
  GroupColours colours(readout, scene, {scene.blocks.voxels, 0, air.scattering.get()}, group);
  for (uint32_t i = 0; i < scene.voxels.count(); ++i) colours.learn(i);
  for (uint32_t i = 0; i < scene.voxels.count(); ++i) {
    Colour light = colours.of(i, per_watt);
    const double scattered = luminance_of(light);
    if (const auto flame = flames.find(i); flame != flames.end()) {
      const Colour own = linear_srgb_from_xyz(flame->second);
      for (size_t k = 0; k < light.size(); ++k) light[k] += own[k] * per_watt;
    }
    put_colour(out, light);
    const glm::dvec3 beam =
        scattered > 0 ? scattered * drift(readout, scene, i, group) : glm::dvec3(0);
    put_colour(out, {beam.x, beam.y, beam.z});
  }
  return out.take();
}

/// Extinction and mean cosine of scattering in the middle band, closest to the eye's best, and
/// scattering coefficients of all bands. Means over points of the voxel.
struct VoxelMedium {
  double extinction = 0;           // [1/m]
  double cosine = 0;               // 0 if nothing scatters
  std::vector<double> scattering;  // [1/m], by band
};

VoxelMedium medium_of(const CompiledScene& scene, const glm::vec3& low, ResidentData& data) {
  constexpr int points_a_side = 2;
  constexpr double share = 1.0 / (points_a_side * points_a_side * points_a_side);
  const int middle = scene.bands.count() / 2;
  VoxelMedium out;
  out.scattering.resize(static_cast<size_t>(scene.bands.count()));
  double cosines = 0;
  for (int point = 0; point < points_a_side * points_a_side * points_a_side; ++point) {
    const glm::vec3 at(point % points_a_side, point / points_a_side % points_a_side,
                       point / points_a_side / points_a_side);
    const glm::vec3 place = low + (at + 0.5f) * (scene.voxels.edge / points_a_side);
    for (int b = 0; b < scene.bands.count(); ++b)
      for_each_medium_at(scene.media, b, place, data,
                         [&](int, int phase, double sigma_t, double albedo) {
                           const double scatters = share * sigma_t * albedo;
                           out.scattering[static_cast<size_t>(b)] += scatters;
                           if (b != middle) return;
                           out.extinction += share * sigma_t;
                           const PhaseFunction& how = scene.phases[static_cast<size_t>(phase)];
                           cosines += scatters * static_cast<double>(how.mean_cosine());
                         });
  }
  const double scatters = out.scattering[static_cast<size_t>(middle)];
  out.cosine = scatters > 0 ? cosines / scatters : 0;
  return out;
}

}  // namespace

Result<LiveGeometry> geometry_of(const CompiledScene& scene, uint32_t generation) {
  LiveGeometry out;
  std::vector<float> corners;
  const auto read = for_each_cell(scene, [&](const GeometryCell& cell) {
    for (const TriangleRecord& t : cell.triangles) {
      const uint32_t n = t.subdivision, patches = n * n;
      const bool whole = scene.surfaces[t.surface].one_patch;
      for (uint32_t k = 0; k < (whole ? 1 : patches); ++k) {
        const auto at = sub_triangle_corners(k, whole ? 1 : n);
        for (const glm::dvec2& uv : at) {
          const glm::dvec3 place = scene.local_origin +
                                   glm::dvec3(t.corner[0]) * (1 - uv.x - uv.y) +
                                   glm::dvec3(t.corner[1]) * uv.x + glm::dvec3(t.corner[2]) * uv.y;
          for (int i = 0; i < 3; ++i) corners.push_back(static_cast<float>(place[i]));
        }
        const uint32_t back = t.first_patch + (whole ? 1 : patches) + k;
        out.patches.push_back(
            {t.first_patch + k, back, t.surface, scene.surfaces[t.surface].patch_area_m2(t)});
      }
    }
  });
  if (!read) return read.problem();
  Writer frame(FrameKind::geometry, generation, static_cast<uint32_t>(out.patches.size()));
  for (const float coordinate : corners) frame.put(coordinate);
  for (const LivePatch& patch : out.patches) frame.put(patch.surface);
  out.frame = frame.take();
  return out;
}

std::vector<LiveFrame> light_frames(const LiveRun& run, const std::vector<LivePatch>& patches,
                                    const LiveSmoke& air, uint32_t generation,
                                    const std::vector<int>& groups) {
  const CompiledScene& scene = run.scene();
  const bool smoke = air.scattering != nullptr;
  const size_t count = groups.size();
  std::vector<LiveFrame> out(smoke ? 2 * count : count);
  run.rows().run(static_cast<int64_t>(out.size()), [&](const GeometryAccess&) {
    return [&](int64_t row) {
      const auto at = static_cast<size_t>(row);
      const int group = groups[at % count];
      const Readout readout(scene, run.shown(group));
      out[at] = at < count ? surface_light(scene, readout, patches, generation, group)
                           : smoke_light(scene, run.index(), readout, air, generation, group);
    };
  });
  return out;
}

FrameHead head_of(const LiveFrame& frame) {
  FrameHead head;
  std::memcpy(&head, frame->data(), sizeof head);
  return head;
}

bool is_surface_light(const FrameHead& head) {
  return head.kind == static_cast<uint32_t>(FrameKind::light);
}

bool is_light(const FrameHead& head) {
  return is_surface_light(head) || head.kind == static_cast<uint32_t>(FrameKind::smoke_light);
}

LiveFrame readdressed(const LiveFrame& frame, uint32_t generation, uint32_t a) {
  FrameHead head = head_of(frame);
  head.generation = generation;
  if (is_light(head)) head.a = a;
  std::string text = *frame;
  std::memcpy(text.data(), &head, sizeof head);
  return std::make_shared<const std::string>(std::move(text));
}

std::shared_ptr<const std::vector<uint32_t>> triangles_from(const std::vector<LivePatch>& before,
                                                            const std::vector<LivePatch>& now,
                                                            const BinMap& bins) {
  std::unordered_map<uint32_t, uint32_t> triangle;  // triangle by the bin of its front
  for (uint32_t i = 0; i < before.size(); ++i) triangle.try_emplace(before[i].front, i);
  auto out = std::make_shared<std::vector<uint32_t>>();
  out->reserve(now.size());
  for (const LivePatch& patch : now) {
    const auto at = triangle.find(bins.patch_before(patch.front));
    out->push_back(at == triangle.end() ? none_index : at->second);
  }
  return out;
}

LiveFrame relaid(const LiveFrame& light, const std::vector<uint32_t>& triangles_before) {
  std::string out = light->substr(0, sizeof(FrameHead));
  out.resize(sizeof(FrameHead) + triangles_before.size() * triangle_light_bytes);
  const size_t end = light->size() - std::min(white_light_bytes, light->size());
  for (size_t i = 0; i < triangles_before.size(); ++i)
    if (const size_t from = sizeof(FrameHead) + triangles_before[i] * triangle_light_bytes;
        triangles_before[i] != none_index && from + triangle_light_bytes <= end)
      std::memcpy(out.data() + sizeof(FrameHead) + i * triangle_light_bytes, light->data() + from,
                  triangle_light_bytes);
  out.append(*light, end);
  return std::make_shared<const std::string>(std::move(out));
}

LiveSmoke smoke_of(const CompiledScene& scene, const SceneIndex& index, uint32_t generation) {
  const VoxelGrid& grid = scene.voxels;
  if (!(grid.edge > 0)) return {};
  Writer out(FrameKind::smoke, generation, grid.count());
  ResidentData data(scene, index);
  std::vector<float> scattering;
  scattering.reserve(size_t{grid.count()} * static_cast<size_t>(scene.bands.count()));
  for (int z = 0; z < grid.nz; ++z)
    for (int y = 0; y < grid.ny; ++y)
      for (int x = 0; x < grid.nx; ++x) {
        const VoxelMedium medium =
            medium_of(scene, grid.low + glm::vec3(x, y, z) * grid.edge, data);
        out.half(medium.extinction);
        out.half(medium.cosine);
        for (const double sigma : medium.scattering)
          scattering.push_back(static_cast<float>(sigma));
      }
  return {out.take(), std::make_shared<const std::vector<float>>(std::move(scattering)),
          std::make_shared<const std::vector<LiveFlame>>(flames_of(scene, index))};
}

}  // namespace luxodus
