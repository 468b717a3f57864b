// Order matters: light first (it decides the bands), then materials, surfaces, emitters (which know
// the surfaces they sit on), media, detectors, and last the layout of the tally and the size of a
// batch.
#include "scenes/transport/compile.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <fstream>
#include <iomanip>
#include <set>
#include <sstream>

#include "runtime/core/hash.hpp"
#include "scenes/optics/offset_ray.hpp"
#include "scenes/transport/compile_surfaces.hpp"
#include "scenes/transport/emission.hpp"
#include "scenes/transport/error_target.hpp"
#include "scenes/transport/flame_points.hpp"
#include "scenes/transport/media_bounds.hpp"
#include "scenes/transport/packed_scene.hpp"

namespace luxodus {

namespace limits {
inline constexpr int64_t voxels = 50'000'000;
inline constexpr int64_t all_plane_cells = 1 << 28;  // 17 GB of totals; bins are told by 32 bits
inline constexpr int64_t default_voxels =
    20'000;  // of the grid a scene gets unless it says an edge
inline constexpr int64_t smallest_batch = 1 << 13;
inline constexpr int64_t largest_batch =
    1 << 18;  // 2^18 particles of 2^32 leave 2^13 passes of head-room
}  // namespace limits

namespace {

void add_unique(std::vector<Spectrum>& list, const Spectrum& s) {
  for (const Spectrum& known : list) {
    if (known.value == s.value) return;
  }
  list.push_back(s);
}

/// Everything that may vary over wavelength and is met by light in this scenario.
std::vector<Spectrum> scene_properties(const SceneDescription& scene, const Scenario& scenario) {
  std::vector<Spectrum> out;
  for (const Material& m : scene.materials) {
    add_unique(out, m.reflectance);
    add_unique(out, m.specular);
    add_unique(out, m.internal_transmittance);
    if (m.reflectance_image && m.reflectance_image->channels >= 3) {
      add_unique(out, reflectance_from_linear_srgb(1, 0, 0));
      add_unique(out, reflectance_from_linear_srgb(0, 0, 1));
    }
  }
  for (const Sign& s : scene.signs) {
    add_unique(out, s.white_reflectance);
    add_unique(out, s.green_reflectance);
  }
  for (const Medium& m : scene.media) {
    if (factor_of(scenario.media, m.name, scenario.smoke_factor) <= 0) continue;
    const auto add_optics = [&](const SmokeOptics& o) {
      if (o.extinction.sigma_t > 0 || o.extinction.table) add_unique(out, o.extinction.spectrum());
      add_unique(out, o.albedo);
    };
    if (m.kind == MediumKind::layered) {
      for (const Layer& l : m.layers) add_optics(l.optics);
    } else {
      SmokeOptics optics = m.optics;
      if (m.kind == MediumKind::data_set)
        optics.extinction.sigma_t = 1;  // the arrays carry the size
      add_optics(optics);
    }
  }
  return out;
}

Bands choose_bands(const SceneDescription& scene, const Scenario& scenario,
                   const std::vector<ActiveSource>& sources) {
  std::vector<Spectrum> shapes;
  Spectrum total;
  for (const ActiveSource& s : sources) {
    add_unique(shapes, s.shape);
    total = total + s.shape * s.watts;
  }
  std::vector<double> edges = scene.run.band_edges_nm;
  if (edges.empty()) {
    edges = told_apart(scene_properties(scene, scenario), shapes, scene.run.band_tolerance,
                       scene.run.max_bands);
  }
  return Bands(edges, total);
}

/// How much of a medium a scenario leaves.
double factor_in(const Scenario& scenario, const Medium& medium) {
  const double named = factor_of(scenario.media, medium.name, -1);
  if (named >= 0) return named;
  // A flame is no smoke: the general factor leaves it alone.
  return medium.emission ? 1.0 : scenario.smoke_factor;
}

Result<void> compile_media(CompiledScene& scene) {
  const SceneDescription& d = *scene.description;
  std::vector<MediumInput> inputs;
  for (size_t i = 0; i < d.media.size(); ++i) {
    const Medium& m = d.media[i];
    const bool stored = d.packed != nullptr && m.kind == MediumKind::data_set;
    inputs.push_back({&m, factor_in(scene.scenario, m), stored ? &d.packed->tables[i] : nullptr});
    scene.media_names.push_back(m.name);
  }
  auto media = MediaSet::compile(
      inputs, scene.bands.count(),
      [&](const Spectrum& s, int band) { return scene.bands.average(s, band); },
      scene.local_origin);
  if (!media.ok()) return media.problem();
  scene.media = std::move(media).value();
  for (const Phase& phase : scene.media.phases()) {
    auto made = PhaseFunction::make(phase, {d.file, 0});
    if (!made.ok()) return made.problem();
    scene.phases.push_back(std::move(made).value());
  }
  scene.features.media = scene.media.need();
  return {};
}

/// A flame is where its points are: their middle, and the box around them.
void place_flame(CompiledEmitter& e, const std::vector<glm::vec3>& points) {
  glm::dvec3 sum(0), low(points.front()), high = low;
  for (const glm::vec3& p : points) {
    sum += glm::dvec3(p);
    low = glm::min(low, glm::dvec3(p));
    high = glm::max(high, glm::dvec3(p));
  }
  e.origin = Vec3(sum / static_cast<double>(points.size()));
  e.size = Vec3(high - low);
  e.near_m = 0.5_r * std::max({e.size.x, e.size.y, e.size.z});
}

void scatter_volume_points(CompiledScene& scene) {
  ResidentBricks bricks(scene.media);
  const PackedScene* packed = scene.description->packed.get();
  for (CompiledEmitter& e : scene.emitters) {
    if (e.kind != EmitterKind::volume) continue;
    const bool stored = packed != nullptr && !packed->flame_points[e.medium].empty();
    std::vector<glm::vec3>& points = scene.volume_points[e.medium];
    points = stored ? packed->flame_points[e.medium] : flame_points(scene.media, e.medium, bricks);
    place_flame(e, points);
  }
}

CompiledPlane make_plane(const glm::dvec3& corner, const glm::dvec3& u, const glm::dvec3& v, int nu,
                         int nv, const glm::dvec3& origin) {
  CompiledPlane out;
  const glm::dvec3 cross = glm::cross(u, v);
  const glm::dvec3 n = glm::normalize(cross);
  out.corner = Vec3(corner - origin);
  out.normal = Vec3(n);
  // Dual edges: coordinates along u and v also where the two are not perpendicular.
  out.dual_u = Vec3(glm::cross(v, n) / glm::dot(u, glm::cross(v, n)));
  out.dual_v = Vec3(glm::cross(n, u) / glm::dot(v, glm::cross(n, u)));
  out.cells_u = nu;
  out.cells_v = nv;
  out.cell_area_m2 = glm::length(cross) / (nu * nv);
  return out;
}

/// Reach beyond a flight's end, as a share of the step by which rays leave surfaces: a plane that
/// lies in a wall or on a floor is crossed by the flights that end there, whichever way their ends
/// are rounded (two ulps of the largest coordinate), and what comes back crosses from behind.
constexpr Real plane_reach_share = 0.5_r;

void compile_detectors(CompiledScene& scene) {
  const SceneDescription& d = *scene.description;
  uint32_t bin = 0;
  for (const PlaneMeasure& p : d.planes) {
    CompiledPlane plane =
        make_plane(p.corner, p.edge_u, p.edge_v, p.cells_u, p.cells_v, scene.local_origin);
    plane.first_bin = bin;
    bin += static_cast<uint32_t>(p.cells_u * p.cells_v);
    scene.planes.push_back(plane);
  }
  for (const CountingPlaneMeasure& p : d.counting_planes) {
    scene.counting_planes.push_back(
        make_plane(p.corner, p.edge_u, p.edge_v, 1, 1, scene.local_origin));
  }
  for (const auto* list : {&scene.planes, &scene.counting_planes}) {
    for (const CompiledPlane& p : *list)
      scene.plane_tests.push_back({p.normal, glm::dot(p.normal, p.corner)});
  }
  scene.plane_reach_m = scene.least_offset_m * plane_reach_share;
  for (const VolumeGroupMeasure& v : d.volume_groups) {
    CompiledVolumeGroup out;
    out.shape = v.shape;
    out.low = Vec3(v.low - scene.local_origin);
    out.high = Vec3(v.high - scene.local_origin);
    if (v.shape == VolumeGroupMeasure::Shape::layer) {
      out.low.x = out.low.y = -1e30_r;
      out.high.x = out.high.y = 1e30_r;
    }
    out.centre = Vec3(v.centre - scene.local_origin);
    out.radius = static_cast<Real>(v.radius);
    out.inner_radius = static_cast<Real>(v.inner_radius);
    scene.volume_groups.push_back(out);
  }
}

/// Those that this scenario leaves some of.
std::vector<const Medium*> active_media(const CompiledScene& scene) {
  std::vector<const Medium*> out;
  for (const Medium& m : scene.description->media) {
    if (factor_in(scene.scenario, m) > 0) out.push_back(&m);
  }
  return out;
}

/// Only where a medium is: elsewhere nobody asks for the light in the air.
void choose_voxels(CompiledScene& scene) {
  const RunSettings& run = scene.description->run;
  if (!run.voxels || scene.features.media == MediaNeed::none) return;
  const Bounds box = media_bounds(active_media(scene), scene.bounds);
  if (box.empty()) return;
  double edge = run.voxel_edge_m;
  if (edge <= 0) {
    // By the whole scene: a small cloud needs no finer light than a large one.
    const glm::dvec3 size = scene.bounds.high - scene.bounds.low;
    const double volume = std::max(size.x, 1e-6) * std::max(size.y, 1e-6) * std::max(size.z, 1e-6);
    edge = std::cbrt(volume / static_cast<double>(limits::default_voxels));
  }
  // The cells of one lattice over the whole scene, so that other smoke has the same voxels.
  const glm::dvec3 first = glm::floor((box.low - scene.bounds.low) / edge);
  const glm::dvec3 end = glm::ceil((box.high - scene.bounds.low) / edge);
  // Beyond the limit a side's cells need not be told apart: the grid is refused anyway.
  const auto cells = [&](int axis) {
    const double most = static_cast<double>(limits::voxels) + 1;
    return static_cast<int>(std::clamp(end[axis] - first[axis], 1.0, most));
  };
  scene.voxels.edge = static_cast<float>(edge);
  scene.voxels.low = glm::vec3(scene.bounds.low + first * edge - scene.local_origin);
  scene.voxels.nx = cells(0);
  scene.voxels.ny = cells(1);
  scene.voxels.nz = cells(2);
}

void choose_eye_targets(CompiledScene& scene) {
  const SceneDescription& d = *scene.description;
  uint32_t bin = 0;
  for (uint32_t o = 0; o < d.observers.size(); ++o) {
    const auto& wanted = d.observers[o].signs;
    for (uint32_t s = 0; s < scene.signs.size(); ++s) {
      if (wanted && std::count(wanted->begin(), wanted->end(), scene.signs[s].sign) == 0) continue;
      const glm::dvec3 to_eye = d.observers[o].eye - scene.signs[s].frame.origin;
      if (glm::dot(to_eye, scene.signs[s].frame.axes[2]) <= 0) continue;  // sees its back
      scene.eye_targets.push_back({o, s, bin});
      bin += 3;  // white, green, surround
    }
  }
}

void lay_out_tally(CompiledScene& scene) {
  scene.layout = TallyLayout(scene.bands.count());
  TallyLayout& l = scene.layout;
  TallyBlocks& b = scene.blocks;
  const auto size = [](const auto& list) { return static_cast<uint32_t>(list.size()); };
  b.patches = l.add_block({"patches", scene.patch_count, 2, ScoreUnit::weight});
  b.surfaces = l.add_block({"surfaces", size(scene.surfaces), 3, ScoreUnit::weight});
  b.escape = l.add_block({"escape", 6, 1, ScoreUnit::weight});
  for (uint32_t i = 0; i < scene.surfaces.size(); ++i) {
    l.add_aggregate(
        {b.patches, scene.surfaces[i].first_patch, scene.surfaces[i].patches, b.surfaces, i});
  }
  if (!scene.surface_groups.empty()) {
    b.surface_groups =
        l.add_block({"surface_groups", size(scene.surface_groups), 3, ScoreUnit::weight});
    for (uint32_t g = 0; g < scene.surface_groups.size(); ++g) {
      for (const uint32_t s : scene.surface_groups[g]) {
        l.add_aggregate({b.surfaces, s, 1, b.surface_groups, g});
      }
    }
  }
  if (!scene.planes.empty()) {
    const CompiledPlane& last = scene.planes.back();
    const uint32_t cells = last.first_bin + static_cast<uint32_t>(last.cells_u * last.cells_v);
    b.plane_cells = l.add_block({"plane_cells", cells, 2, ScoreUnit::weight});
    b.planes = l.add_block({"planes", size(scene.planes), 2, ScoreUnit::weight});
    for (uint32_t i = 0; i < scene.planes.size(); ++i) {
      const CompiledPlane& p = scene.planes[i];
      l.add_aggregate(
          {b.plane_cells, p.first_bin, static_cast<uint32_t>(p.cells_u * p.cells_v), b.planes, i});
    }
  }
  if (!scene.counting_planes.empty())
    b.counting = l.add_block({"counting", size(scene.counting_planes), 4, ScoreUnit::weight});
  if (!scene.volume_groups.empty()) {
    b.volume_length =
        l.add_block({"volume_length", size(scene.volume_groups), 1, ScoreUnit::weight_length});
    b.volume_power = l.add_block({"volume_power", size(scene.volume_groups), 2, ScoreUnit::weight});
  }
  if (!scene.media_names.empty())
    b.media_power = l.add_block({"media_power", size(scene.media_names), 2, ScoreUnit::weight});
  if (scene.voxels.edge > 0) {
    b.voxels = l.add_block({"voxels", scene.voxels.count(), 4, ScoreUnit::weight_length});
    b.voxel_power = l.add_block({"voxel_power", scene.voxels.count(), 2, ScoreUnit::weight});
  }
  const uint32_t groups = size(scene.groups);
  if (const uint32_t probes = size(scene.description->probes); probes > 0) {
    b.probes = l.add_block({"probes", probes, 2, ScoreUnit::value, false});
    if (groups > 1) {
      b.probes_by_group =
          l.add_block({"probes_by_group", probes * groups, 2, ScoreUnit::value, false});
    }
  }
  if (const uint32_t parts = 3 * size(scene.eye_targets); parts > 0) {
    b.views = l.add_block({"views", parts, eye_quantities, ScoreUnit::value, false});
    if (groups > 1) {
      b.views_by_group = l.add_block(
          {"views_by_group", parts * groups, group_eye_quantities, ScoreUnit::value, false});
    }
  }
}

/// Paths from eyes relative to the usual, by which they take about half of the time. Where somebody
/// has said what is judged, what is not gets an eighth of the paths.
double share_of_eyes(const ErrorTarget& judged) {
  if (judged.words.empty() || judged.asks_eyes() == judged.asks_bins()) return 1;
  return judged.asks_eyes() ? 8 : 1.0 / 8;
}

Result<void> choose_error_target(CompiledScene& scene, const std::vector<std::string>& wanted) {
  const RunSettings& run = scene.description->run;
  const bool own = wanted.empty();
  auto judged = error_target_of(scene, own ? run.error_of : wanted);
  if (!judged.ok()) {
    Problem problem = judged.problem();
    problem.where = own ? run.error_of_place : SourcePlace{};
    return problem;
  }
  scene.error_target = std::move(judged).value();
  return {};
}

void choose_batch(CompiledScene& scene) {
  const RunSettings& run = scene.description->run;
  // A batch ends with a walk over all its scores, some 3 ns each, against 250 ns a particle in
  // clear air and several times that in smoke; yet a run should have many batches, since they carry
  // its errors.
  const int64_t scores_per_particle = scene.features.media == MediaNeed::none ? 16 : 64;
  const auto wanted =
      std::bit_ceil(static_cast<uint64_t>(scene.layout.scores() / scores_per_particle));
  scene.batch_particles =
      run.batch_particles > 0
          ? run.batch_particles
          : std::clamp(static_cast<int64_t>(wanted), limits::smallest_batch, limits::largest_batch);
  const auto parts =
      static_cast<double>(3 * scene.eye_targets.size() + 2 * scene.description->probes.size());
  if (parts > 0) {
    // A path from the eye costs some ten histories' rays (each event asks the lights as well).
    const double paths = 0.1 * run.eye_share * share_of_eyes(scene.error_target) *
                         static_cast<double>(scene.batch_particles) / parts;
    scene.eye_paths_per_batch = std::clamp(static_cast<int>(paths), 1, 1024);
  }
}

Result<void> resolve_surface_groups(CompiledScene& scene) {
  const SceneDescription& d = *scene.description;
  for (const SurfaceGroupMeasure& measure : d.surface_groups) {
    std::vector<uint32_t> members;
    for (uint32_t s = 0; s < scene.surfaces.size(); ++s) {
      const bool is_object = s < d.objects.size();
      const bool named =
          std::any_of(measure.objects.begin(), measure.objects.end(), [&](const auto& name) {
            if (scene.surfaces[s].name == name) return true;
            if (!is_object) return false;
            const auto& tags = d.objects[s].tags;
            return std::find(tags.begin(), tags.end(), name) != tags.end();
          });
      if (named || (is_object && d.objects[s].group == measure.name)) members.push_back(s);
    }
    if (members.empty()) {
      return Problem{measure.place, "surface group \"" + measure.name +
                                        "\" holds no object: name an object or a tag of one"};
    }
    scene.surface_groups.push_back(std::move(members));
  }
  return {};
}

void choose_features(CompiledScene& scene) {
  Features& f = scene.features;
  f.bands = scene.bands.count() > 1;
  for (const CompiledSurface& s : scene.surfaces) {
    for (const uint32_t m : s.material) {
      const CompiledMaterial& material = scene.materials[m];
      f.surfaces |= material.kind != MaterialKind::lambertian || material.image != none_index;
    }
    f.surfaces |= s.sign != none_index;
  }
  f.detectors = !scene.planes.empty() || !scene.counting_planes.empty() ||
                !scene.volume_groups.empty() || scene.voxels.edge > 0;
}

uint64_t hash_scene(const CompiledScene& scene, int cells) {
  Hasher hash;
  hash.add(scene.description->content_hash);
  hash.add(scene.scenario.name);
  hash.add(static_cast<uint64_t>(std::max(cells, 1)));
  hash.add(scene.triangles);
  hash.add(static_cast<uint64_t>(scene.batch_particles));
  hash.add(static_cast<uint64_t>(scene.eye_paths_per_batch));
  for (int b = 0; b < scene.bands.count(); ++b)
    hash.add(std::bit_cast<uint64_t>(scene.bands[b].high_nm));
  for (const Group& g : scene.groups) {
    for (const double p : g.power_w) hash.add(std::bit_cast<uint64_t>(p));
  }
  for (const double share : scene.batch_shares) hash.add(std::bit_cast<uint64_t>(share));
  return hash.value();
}

std::string group_name(const ActiveSource& s, GroupRule rule) {
  switch (rule) {
    case GroupRule::one:
      return "all";
    case GroupRule::by_circuit:
      return s.group.empty() ? "other" : s.group;
    case GroupRule::by_emitter:
      return s.name;
  }
  return "all";
}

/// Errors: nothing that has a place.
Result<void> set_bounds(CompiledScene& scene) {
  scene.bounds = solid_bounds(*scene.description, scene.scenario);
  if (scene.bounds.empty()) {
    return Problem{{scene.description->file, 0},
                   "there is nothing but media in the scene, so it has no size: add an object, an "
                   "emitter, a plane or an observer"};
  }
  const glm::dvec3 centre = 0.5 * (scene.bounds.low + scene.bounds.high);
  scene.local_origin = centre;
  // Rounded outwards, so that nothing solid lies outside in single precision.
  scene.local_low = Vec3(scene.bounds.low - centre);
  scene.local_high = Vec3(scene.bounds.high - centre);
  scene.diagonal_m = glm::length(scene.local_high - scene.local_low);
  scene.least_offset_m = least_offset(scene.diagonal_m);
  return {};
}

/// How far light may go within it; across, where it has no end.
double extent_of(const VolumeGroupMeasure& group) {
  using Shape = VolumeGroupMeasure::Shape;
  if (group.shape == Shape::box) return glm::length(group.high - group.low);
  if (group.shape == Shape::layer) return group.high.z - group.low.z;
  return 2 * group.radius;
}

/// A voxel or a volume may be larger than all that stands in a scene, which may be a point.
void choose_length_unit(CompiledScene& scene) {
  double most =
      std::max(static_cast<double>(scene.diagonal_m), static_cast<double>(scene.voxels.edge));
  for (const VolumeGroupMeasure& group : scene.description->volume_groups)
    most = std::max(most, extent_of(group));
  scene.length_unit_m = std::exp2(std::ceil(std::log2(std::max(most, 1e-6))));
  scene.scores_per_metre = 1 / scene.length_unit_m;
}

/// Errors: a mesh without a triangle that can be told from a point.
Result<void> compile_emitters(CompiledScene& scene, const std::vector<ActiveSource>& sources) {
  const SceneDescription& d = *scene.description;
  std::vector<std::string> groups;
  for (const ActiveSource& s : sources) {
    scene.emitters.push_back(compile_emitter(s, scene));
    if (scene.emitters.back().kind == EmitterKind::mesh && !(scene.emitters.back().area_m2 > 0))
      return Problem{s.emitter->place, "emitter \"" + s.name +
                                           "\": its triangles are too small to be told from a "
                                           "point where they are: make them larger, or the "
                                           "emitter a point"};
    groups.push_back(group_name(s, d.run.groups));
    if (s.sign == nullptr) continue;
    const CompiledEmitter& e = scene.emitters.back();
    CompiledSign& sign = scene.signs[e.sign];
    auto& radiance = s.colour == SignColour::white ? sign.white_radiance : sign.green_radiance;
    for (const double p : e.power_w) {
      radiance.push_back(p * (static_cast<double>(e.exponent) + 1) /
                         (2 * 3.14159265358979 * e.area_m2));
    }
  }
  for (CompiledSign& sign : scene.signs) {
    sign.white_radiance.resize(static_cast<size_t>(scene.bands.count()), 0.0);
    sign.green_radiance.resize(static_cast<size_t>(scene.bands.count()), 0.0);
  }
  compile_groups(scene, groups);
  for (uint32_t i = 0; i < scene.emitters.size(); ++i) {
    if (has_own_face(scene.emitters[i])) scene.emitter_bounds.push_back(emitter_bound(scene, i));
  }
  for (size_t i = 0; i < sources.size(); ++i) {
    if (sources[i].sign == nullptr) continue;
    CompiledSign& sign = scene.signs[scene.emitters[i].sign];
    const bool white = sources[i].colour == SignColour::white;
    (white ? sign.white_group : sign.green_group) = scene.emitters[i].group;
  }
  return {};
}

}  // namespace

namespace {

/// Where a key stands in a scene's main file; line 0 where it does not, or where that is a pack.
/// Values carry no place of their own that far.
SourcePlace place_of_key(const std::string& file, const std::string& key) {
  std::ifstream in(file);
  std::string line;
  for (int number = 1; std::getline(in, line); ++number) {
    const size_t at = line.find_first_not_of(" \t");
    if (at == std::string::npos || line.compare(at, key.size(), key) != 0) continue;
    const size_t next = line.find_first_not_of(" \t", at + key.size());
    if (next != std::string::npos && line[next] == '=') return {file, number};
  }
  return {file, 0};
}

Problem too_many_voxels(const CompiledScene& scene) {
  const Bounds box = media_bounds(active_media(scene), scene.bounds);
  const glm::dvec3 size = box.high - box.low;
  // A little more than the cube root says: a side has whole voxels.
  const double least =
      1.1 * std::cbrt(size.x * size.y * size.z / static_cast<double>(limits::voxels));
  std::ostringstream what;
  what << "the voxel grid would have more than " << limits::voxels / 1'000'000
       << " million voxels: set voxel_edge_m in [run] to about " << std::setprecision(2) << least
       << " or more";
  return {place_of_key(scene.description->file, "voxel_edge_m"), what.str()};
}

}  // namespace

Result<Scenario> find_scenario(const SceneDescription& description, const std::string& name) {
  if (description.scenarios.empty() && name.empty()) {
    Scenario plain;
    plain.name = "as written";
    return plain;
  }
  if (name.empty()) return description.scenarios.front();
  std::string known;
  for (const Scenario& s : description.scenarios) {
    if (s.name == name) return s;
    known += (known.empty() ? "\"" : ", \"") + s.name + "\"";
  }
  return Problem{{description.file, 0},
                 "there is no scenario \"" + name + "\"; there " +
                     (known.empty() ? "are none" : "are: " + known)};
}

Result<std::shared_ptr<const CompiledScene>> compile_scene(
    std::shared_ptr<const SceneDescription> description, const Scenario& scenario,
    const CompileOptions& options) {
  auto scene = std::make_shared<CompiledScene>();
  scene->description = description;
  scene->scenario = scenario;
  const std::vector<ActiveSource> sources = active_sources(*description, scenario);
  if (sources.empty()) {
    return Problem{{description->file, 0},
                   "nothing emits light in scenario \"" + scenario.name +
                       "\": add an emitter, a luminaire or a lit sign, or switch a circuit on"};
  }
  scene->bands =
      options.bands_of == nullptr
          ? choose_bands(*description, scenario, sources)
          : choose_bands(*options.bands_of, scenario, active_sources(*options.bands_of, scenario));
  if (auto ok = set_bounds(*scene); !ok.ok()) return ok.problem();
  for (const ActiveSource& s : sources) {
    if (s.emitter != nullptr && s.emitter->web &&
        std::find(scene->webs.begin(), scene->webs.end(), s.emitter->web) == scene->webs.end()) {
      scene->webs.push_back(s.emitter->web);
    }
  }
  compile_materials(*scene);
  compile_sign_faces(*scene);
  const PackedScene* packed = description->packed.get();
  auto solid =
      packed != nullptr ? adopt_packed_geometry(*scene) : compile_triangles(*scene, options.cells);
  if (!solid.ok()) return solid.problem();
  compile_lambert_fractions(*scene);
  if (auto ok = compile_emitters(*scene, sources); !ok.ok()) return ok.problem();
  if (auto ok = compile_media(*scene); !ok.ok()) return ok.problem();
  scatter_volume_points(*scene);
  int64_t plane_cells = 0;
  for (const PlaneMeasure& p : description->planes) plane_cells += int64_t{p.cells_u} * p.cells_v;
  if (plane_cells > limits::all_plane_cells) {
    return Problem{{description->file, 0},
                   "the planes have " + std::to_string(plane_cells) +
                       " cells in all: make their cells larger"};
  }
  compile_detectors(*scene);
  if (auto ok = resolve_surface_groups(*scene); !ok.ok()) return ok.problem();
  choose_voxels(*scene);
  if (1.0 * scene->voxels.nx * scene->voxels.ny * scene->voxels.nz >
      static_cast<double>(limits::voxels)) {
    return too_many_voxels(*scene);
  }
  choose_length_unit(*scene);
  choose_eye_targets(*scene);
  if (auto ok = choose_error_target(*scene, options.error_of); !ok.ok()) return ok.problem();
  choose_features(*scene);
  lay_out_tally(*scene);
  choose_batch(*scene);
  scene->batch_shares = options.batch_shares;
  if (!scene->batch_shares.empty() && scene->batch_shares.size() != scene->groups.size())
    return Problem{{description->file, 0}, "batches were dealt to other source groups than it has"};
  scene->scene_hash = hash_scene(*scene, packed != nullptr ? packed->partition : options.cells);
  return std::shared_ptr<const CompiledScene>(std::move(scene));
}

}  // namespace luxodus
