// The order matters: light first (it decides the bands), then materials, surfaces, emitters (which
// refer to the surfaces they sit on), media, detectors, and last the layout of the tally and the
// batch size.
#include "scenes/light/transport/compile.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <set>

#include "runtime/core/hash.hpp"
#include "scenes/light/optics/offset_ray.hpp"
#include "scenes/light/transport/compile_detectors.hpp"
#include "scenes/light/transport/compile_surfaces.hpp"
#include "scenes/light/transport/emission.hpp"
#include "scenes/light/transport/error_target.hpp"
#include "scenes/light/transport/flame_points.hpp"
#include "scenes/light/transport/packed_scene.hpp"
#include "scenes/light/transport/value_scores.hpp"

namespace luxodus {

namespace limits {
inline constexpr int64_t smallest_batch = 1 << 13;
inline constexpr int64_t largest_batch =
    1 << 18;  // 2^18 particles of 2^32 leave room for 2^13 passes each
}  // namespace limits

namespace {

void add_unique(std::vector<Spectrum>& list, const Spectrum& s) {
  for (const Spectrum& known : list) {
    if (known.value == s.value) return;
  }
  list.push_back(s);
}

/// All spectra that may vary over wavelength and that light meets in this scenario.
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
  for (const Sign& s : scene.signs)
    for (const FaceColour& colour : s.colours) add_unique(out, colour.reflectance);
  for (const Medium& m : scene.media) {
    if (extinction_factor(scenario, m.name) <= 0) continue;
    const auto add_optics = [&](const SmokeOptics& o) {
      if (o.extinction.sigma_t > 0 || o.extinction.table) add_unique(out, o.extinction.spectrum());
      add_unique(out, o.albedo);
    };
    if (m.kind == MediumKind::layered) {
      for (const Layer& l : m.layers) add_optics(l.optics);
    } else {
      SmokeOptics optics = m.optics;
      if (m.kind == MediumKind::data_set)
        optics.extinction.sigma_t = 1;  // only the shape matters: the arrays hold the magnitude
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

/// Grids of one fire simulation share a name: the second is displayed as "smoke (2)".
std::string display_name(const std::vector<Medium>& media, size_t index) {
  const auto before = std::count_if(media.begin(), media.begin() + static_cast<ptrdiff_t>(index),
                                    [&](const Medium& m) { return m.name == media[index].name; });
  return before == 0 ? media[index].name
                     : media[index].name + " (" + std::to_string(before + 1) + ")";
}

Result<void> compile_media(CompiledScene& scene) {
  const SceneDescription& d = *scene.description;
  std::vector<MediumInput> inputs;
  for (size_t i = 0; i < d.media.size(); ++i) {
    const Medium& m = d.media[i];
    const bool stored = d.packed != nullptr && m.kind == MediumKind::data_set;
    inputs.push_back(
        {&m, factor_of_medium(scene.scenario, m), stored ? &d.packed->tables[i] : nullptr});
    scene.media_names.push_back(display_name(d.media, i));
  }
  auto media = MediaSet::compile(
      inputs, scene.bands.count(),
      [&](const Spectrum& s, int band) { return scene.bands.average(s, band); },
      scene.local_origin);
  if (!media) return media.problem();
  scene.media = std::move(media).value();
  for (const Phase& phase : scene.media.phases()) {
    auto made = PhaseFunction::make(phase, {d.file, 0});
    if (!made) return made.problem();
    scene.phases.push_back(std::move(made).value());
  }
  scene.features.media = scene.media.need();
  return {};
}

/// Places a flame by its points: at their mean, with their bounding box.
void place_flame(CompiledEmitter& e, const std::vector<glm::vec3>& points) {
  glm::dvec3 sum(0), low(points.front()), high = low;
  for (const glm::vec3& p : points) {
    sum += glm::dvec3(p);
    low = glm::min(low, glm::dvec3(p));
    high = glm::max(high, glm::dvec3(p));
  }
  e.origin = Vec3(sum / static_cast<double>(points.size()));
  e.size = Vec3(high - low);
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

/// Eye paths relative to the default, with which they take about half of the time. If error targets
/// are given, whatever is not among them gets an eighth of its paths.
double share_of_eyes(const ErrorTarget& judged) {
  if (judged.words.empty() || judged.asks_eyes() == judged.asks_bins()) return 1;
  return judged.asks_eyes() ? 8 : 1.0 / 8;
}

Result<void> choose_error_target(CompiledScene& scene, const std::vector<std::string>& wanted) {
  const RunSettings& run = scene.description->run;
  const bool own = wanted.empty();
  auto judged = error_target_of(scene, own ? run.error_of : wanted);
  if (!judged) {
    Problem problem = judged.problem();
    problem.where = own ? run.error_of_place : SourcePlace{};
    return problem;
  }
  scene.error_target = std::move(judged).value();
  return {};
}

void choose_batch(CompiledScene& scene) {
  const RunSettings& run = scene.description->run;
  // Merging a batch visits all its scores, some 3 ns each, against 250 ns per particle in clear air
  // and several times that in smoke. Yet a run should have many batches, since errors come from
  // their spread.
  // In media most scores are voxels. 160 keeps batches as large as they were before voxels counted
  // scattered light: with 64 scores per particle, short runs had one batch and so no error.
  const int64_t scores_per_particle = scene.features.media == MediaNeed::none ? 16 : 160;
  const auto wanted =
      std::bit_ceil(static_cast<uint64_t>(scene.layout.scores() / scores_per_particle));
  scene.batch_particles =
      run.batch_particles > 0
          ? run.batch_particles
          : std::clamp(static_cast<int64_t>(wanted), limits::smallest_batch, limits::largest_batch);
  const auto parts =
      static_cast<double>(3 * scene.eye_targets.size() + 2 * scene.description->probes.size());
  if (parts > 0) {
    // An eye path costs about as much as the rays of ten histories (each event also samples
    // emitters).
    const double paths = 0.1 * run.eye_path_factor * share_of_eyes(scene.error_target) *
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
      return problem_in(measure.place, "surface group \"" + measure.name +
                                           "\" holds no object: name an object or a tag of one");
    }
    scene.surface_groups.push_back(std::move(members));
  }
  return {};
}

/// How bright a scene is: its flux over the square of its size [lx], or a thousandth of the
/// luminance of its brightest sign, which may be small and far from all else.
double level_of(const CompiledScene& scene) {
  double lumens = 0, brightest = 0;
  for (const CompiledEmitter& e : scene.emitters) lumens += e.luminous_flux_lm;
  for (const CompiledSign& sign : scene.signs)
    for (const CompiledFaceColour& colour : sign.colours)
      brightest = std::max(brightest, colour.luminance_cd_m2);
  const auto size_m = static_cast<double>(scene.diagonal_m);
  return std::max(lumens / (size_m * size_m), brightest / 1000);
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
  for (const CompiledEmitter& e : scene.emitters) f.bodies |= e.body != 0;
  f.detectors = !scene.planes.empty() || !scene.counting_planes.empty() ||
                !scene.volume_groups.empty() || scene.voxels.edge > 0;
}

/// The sum of squared errors over all mixtures is smallest if paths choose an emitter by its light
/// times the root mean square of its factors. A group without any factor is never chosen, and so is
/// missing from what is scored beside mixtures: give each group a factor in some mixture.
void mix_groups(CompiledScene& scene, const std::vector<GroupMixture>& mixtures) {
  if (mixtures.empty()) return;
  std::vector<double> squares(scene.groups.size(), 0.0);
  for (const GroupMixture& mixture : mixtures) {
    std::vector<double>& factors = scene.mixtures.emplace_back();
    for (size_t g = 0; g < scene.groups.size(); ++g) {
      factors.push_back(mixture.factor_of(scene.groups[g].name));
      squares[g] += factors.back() * factors.back();
    }
  }
  for (CompiledEmitter& emitter : scene.emitters)
    emitter.wanted = std::sqrt(squares[static_cast<size_t>(emitter.group)] /
                               static_cast<double>(mixtures.size()));
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
  for (const std::vector<double>& factors : scene.mixtures)
    for (const double factor : factors) hash.add(std::bit_cast<uint64_t>(factor));
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

/// Errors: nothing with an extent.
Result<void> set_bounds(CompiledScene& scene) {
  scene.bounds = solid_bounds(*scene.description, scene.scenario);
  if (scene.bounds.empty()) {
    return problem_in(
        scene.description->file,
        "there is nothing but media in the scene, so it has no size: add an object, an "
        "emitter, a plane or an observer");
  }
  const glm::dvec3 centre = 0.5 * (scene.bounds.low + scene.bounds.high);
  scene.local_origin = centre;
  // Rounded outwards, so that no solid lies outside in single precision.
  scene.local_low = Vec3(scene.bounds.low - centre);
  scene.local_high = Vec3(scene.bounds.high - centre);
  scene.diagonal_m = glm::length(scene.local_high - scene.local_low);
  scene.min_offset_m = min_offset(scene.diagonal_m);
  return {};
}

/// Longest distance that light may fly in it; across it, if it is unbounded.
double extent_of(const VolumeGroupMeasure& group) {
  using GroupShape = VolumeGroupMeasure::Shape;
  if (group.shape == GroupShape::box) return glm::length(group.high - group.low);
  if (group.shape == GroupShape::layer) return group.high.z - group.low.z;
  return 2 * group.radius;
}

/// A voxel or a volume may be larger than everything solid in a scene, which may be a point.
void choose_length_unit(CompiledScene& scene) {
  double most =
      std::max(static_cast<double>(scene.diagonal_m), static_cast<double>(scene.voxels.edge));
  for (const VolumeGroupMeasure& group : scene.description->volume_groups)
    most = std::max(most, extent_of(group));
  scene.length_unit_m = std::exp2(std::ceil(std::log2(std::max(most, 1e-6))));
  scene.scores_per_metre = 1 / scene.length_unit_m;
}

/// Errors: a mesh whose triangles are all degenerate in single precision.
Result<void> compile_emitters(CompiledScene& scene, const std::vector<ActiveSource>& sources) {
  const SceneDescription& d = *scene.description;
  std::vector<std::string> groups;
  for (const ActiveSource& s : sources) {
    scene.emitters.push_back(compile_emitter(s, scene));
    if (scene.emitters.back().kind == EmitterKind::mesh && !(scene.emitters.back().area_m2 > 0))
      return problem_in(s.emitter->place, "emitter \"" + s.name +
                                              "\": its triangles are too small to be told from a "
                                              "point where they are: make them larger, or the "
                                              "emitter a point");
    groups.push_back(group_name(s, d.run.groups));
    if (s.sign == nullptr) continue;
    const CompiledEmitter& e = scene.emitters.back();
    CompiledSign& sign = scene.signs[e.sign];
    std::vector<double>& radiance = sign.colours[s.colour].radiance;
    // Fifteen digits of pi, kept: one more would change the last bits of eye results.
    for (const double p : e.power_w) {
      radiance.push_back(p * (static_cast<double>(e.exponent) + 1) /
                         (2 * 3.14159265358979 * e.area_m2));
    }
  }
  for (CompiledSign& sign : scene.signs)
    for (CompiledFaceColour& colour : sign.colours)
      colour.radiance.resize(static_cast<size_t>(scene.bands.count()), 0.0);
  compile_groups(scene, groups);
  for (uint32_t i = 0; i < scene.emitters.size(); ++i) {
    if (!has_own_face(scene.emitters[i])) continue;
    const EmitterBound bound = emitter_bound(scene, i);
    scene.emitters_with_faces.emitters.push_back(i);
    scene.emitters_with_faces.around.add(bound.centre, bound.radius);
  }
  for (size_t i = 0; i < sources.size(); ++i) {
    if (sources[i].sign == nullptr) continue;
    CompiledSign& sign = scene.signs[scene.emitters[i].sign];
    sign.colours[sources[i].colour].group = scene.emitters[i].group;
  }
  return {};
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
  return problem_in(description.file, "there is no scenario \"" + name + "\"; there " +
                                          (known.empty() ? "are none" : "are: " + known));
}

Result<std::shared_ptr<const CompiledScene>> compile_scene(
    std::shared_ptr<const SceneDescription> description, const Scenario& scenario,
    const CompileOptions& options) {
  auto scene = std::make_shared<CompiledScene>();
  scene->description = description;
  scene->scenario = scenario;
  const std::vector<ActiveSource> sources = active_sources(*description, scenario);
  if (sources.empty()) {
    return problem_in(description->file,
                      "nothing emits light in scenario \"" + scenario.name +
                          "\": add an emitter, a luminaire or a lit sign, or switch a circuit on");
  }
  scene->bands =
      options.bands_of == nullptr
          ? choose_bands(*description, scenario, sources)
          : choose_bands(*options.bands_of, scenario, active_sources(*options.bands_of, scenario));
  if (auto ok = set_bounds(*scene); !ok) return ok.problem();
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
  if (!solid) return solid.problem();
  compile_lambert_fractions(*scene);
  if (auto ok = compile_emitters(*scene, sources); !ok) return ok.problem();
  if (auto ok = compile_media(*scene); !ok) return ok.problem();
  scatter_volume_points(*scene);
  if (auto ok = compile_detectors(*scene); !ok) return ok.problem();
  if (auto ok = resolve_surface_groups(*scene); !ok) return ok.problem();
  if (auto ok = choose_voxels(*scene); !ok) return ok.problem();
  choose_length_unit(*scene);
  choose_eye_targets(*scene);
  mix_groups(*scene, options.mixtures);
  if (auto ok = choose_error_target(*scene, options.error_of); !ok) return ok.problem();
  scene->light_quantum = light_quantum_of(level_of(*scene));
  choose_features(*scene);
  lay_out_tally(*scene);
  choose_batch(*scene);
  scene->batch_shares = options.batch_shares;
  if (!scene->batch_shares.empty() && scene->batch_shares.size() != scene->groups.size())
    return problem_in(description->file, "batches were dealt to other source groups than it has");
  scene->scene_hash = hash_scene(*scene, packed != nullptr ? packed->partition : options.cells);
  return std::shared_ptr<const CompiledScene>(std::move(scene));
}

}  // namespace luxodus
