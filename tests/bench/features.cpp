// Cost of each scene feature: absent, present but unused, used. Measured in instructions under
// callgrind (tests/tools/feature_costs.sh), otherwise in CPU time.
#include <fmt/core.h>

#include <array>
#include <functional>
#include <stdexcept>

#include "actors/cast/parts/scene_objects.hpp"
#include "actors/cast/process/in_process.hpp"
#include "actors/judge/validate/scene_kit.hpp"
#include "actors/lab/simulate/simulation.hpp"
#include "scenes/light/transport/compile.hpp"
#include "tests/bench/bench_scenes.hpp"
#include "tests/bench/measure.hpp"
#include "tests/bench/tables.hpp"

#if __has_include(<valgrind/callgrind.h>)
#include <valgrind/callgrind.h>
#else
#define CALLGRIND_ZERO_STATS
#define CALLGRIND_DUMP_STATS_AT(name) (void)(name)
#define RUNNING_ON_VALGRIND 0
#endif

namespace luxodus::bench {

namespace {

constexpr uint64_t seed = 1;
constexpr int64_t batches_counted = 2;
constexpr int64_t batches_of_node = 32;
constexpr double seconds_per_turn = 0.15;

/// How batches are run.
enum class By { loop, loop_without_statistics, node, node_by_turns };

struct Variant {
  const char* feature;
  const char* state;
  std::function<void(SceneDescription&)> change;
  By by = By::loop;
  int cells = 1;
  // For node_by_turns:
  uint64_t trace_every = 0;  // sampling interval of traced particles
  bool rare_ways = false;    // taken on purpose
  size_t room = 0;           // budget in largest cells; 0: all are resident
};

void nothing(SceneDescription&) {}

Material& material_named(SceneDescription& d, const char* name) {
  d.materials.emplace_back().name = name;
  return d.materials.back();
}

/// Gives the first boxes of the room, a tenth of all, the last material.
void use_last_material(SceneDescription& d) {
  for (size_t i = 6; i < 6 + 13; ++i) {
    d.objects[i].material = d.objects[i].back_material = static_cast<int>(d.materials.size()) - 1;
    // Maps the corners of a quad to the corners of the picture.
    Mesh& mesh = d.objects[i].mesh;
    mesh.texture_uv.resize(mesh.positions.size());
    for (size_t k = 0; k < mesh.texture_uv.size(); ++k)
      mesh.texture_uv[k] = glm::vec2(k % 4 == 1 || k % 4 == 2, k % 4 >= 2);
  }
}

void add_glossy(SceneDescription& d) {
  Material& m = material_named(d, "glossy");
  m.kind = MaterialKind::glossy;
  m.reflectance = Spectrum::constant(0.4);
  m.specular = Spectrum::constant(0.1);
}

/// Reflectance as of the boxes: perfect mirrors would make histories longer.
void add_mirror(SceneDescription& d) {
  Material& m = material_named(d, "mirror");
  m.kind = MaterialKind::mirror;
  m.specular = Spectrum::constant(0.5);
}

void add_pane(SceneDescription& d) {
  material_named(d, "pane").kind = MaterialKind::glass_pane;
}

void add_texture(SceneDescription& d) {
  Image image{64, 64, 1, std::vector<float>(64 * 64)};
  for (size_t i = 0; i < image.texels.size(); ++i) image.texels[i] = i % 2 == 0 ? 1.0f : 0.5f;
  material_named(d, "chequered").reflectance_image =
      std::make_shared<const Image>(std::move(image));
}

void add_web(SceneDescription& d) {
  auto web = PhotometricWeb::make({0, 90, 180, 270, 360}, {0, 30, 60, 90, 180},
                                  {100, 90, 40,  0,  0,  100, 80, 30,  0,  0,  100, 90, 40,
                                   0,   0,  100, 80, 30, 0,   0,  100, 90, 40, 0,   0},
                                  glm::dmat3(1));
  d.emitters[0].shape = EmitterShape::point;
  d.emitters[0].distribution = Distribution::web;
  d.emitters[0].web = std::make_shared<const PhotometricWeb>(std::move(web).value());
}

/// A lamp that is lit only in an emergency.
void add_dark_lamp(SceneDescription& d) {
  Emitter lamp = d.emitters[0];
  lamp.name = "dark lamp";
  lamp.mains_flux = 0;
  lamp.emergency_flux = 1;
  d.emitters.push_back(std::move(lamp));
}

void add_second_lamp(SceneDescription& d) {
  Emitter lamp = d.emitters[0];
  lamp.name = "second lamp";
  lamp.frame.origin.x -= 5;
  d.emitters.push_back(std::move(lamp));
}

void add_reddish(SceneDescription& d) {
  Spectrum& reddish = material_named(d, "reddish").reflectance;
  for (int i = 0; i < spectrum_samples; ++i)
    reddish.value[static_cast<size_t>(i)] = 0.2 + 0.6 * i / (spectrum_samples - 1);
  d.run.max_bands = 8;
}

void without_voxels(SceneDescription& d) {
  d.run.voxels = false;
}

void homogeneous(SceneDescription& d) {
  without_voxels(d);
  light::add_homogeneous(d, light::smoke(0.1, 0.8));
}

/// A flame; particles start in it by its share of the light.
void add_flame(SceneDescription& d, double sigma_t) {
  without_voxels(d);
  Medium& flame = light::add_ball(d, {5, 5, 0.5}, 0.4, light::smoke(sigma_t, 0.5));
  flame.emission = MediumEmission{};
  flame.emission->power_w = 1;
}

void put_flames_out(SceneDescription& d) {
  Scenario out;
  out.name = "no fire";
  out.smoke_factor = 0;
  out.emission_factor = 0;
  d.scenarios.push_back(out);
}

void add_observer(SceneDescription& d) {
  Observer observer;
  observer.name = "observer";
  observer.eye = {10, 7, 1.6};
  d.observers.push_back(observer);
}

void add_probe(SceneDescription& d) {
  ProbeMeasure probe;
  probe.name = "probe";
  probe.position = {10, 7, 1.2};
  d.probes.push_back(probe);
}

void switch_smoke_off(SceneDescription& d) {
  Scenario clear;
  clear.name = "clear";
  clear.smoke_factor = 0;
  d.scenarios.push_back(clear);
}

void add_plane(SceneDescription& d, double z) {
  PlaneMeasure plane;
  plane.name = "plane";
  plane.corner = {0, 0, z};
  plane.edge_u = {20, 0, 0};
  plane.edge_v = {0, 15, 0};
  plane.cells_u = 20;
  plane.cells_v = 15;
  d.planes.push_back(plane);
}

/// The first of a feature's rows is the reference of the others.
const std::vector<Variant>& variants() {
  static const std::vector<Variant> all = {
      {"media", "absent", nothing},
      {"", "unused (factor 0)",
       [](SceneDescription& d) {
         homogeneous(d);
         switch_smoke_off(d);
       }},
      {"", "homogeneous", homogeneous},
      {"", "six layers",
       [](SceneDescription& d) {
         without_voxels(d);
         light::add_layers(
             d, 0, std::vector<double>(6, 0.5),
             {light::smoke(0.05, 0.8), light::smoke(0.08, 0.8), light::smoke(0.1, 0.8),
              light::smoke(0.1, 0.8), light::smoke(0.12, 0.8), light::smoke(0.15, 0.8)});
       }},
      {"", "over an outline",
       [](SceneDescription& d) {
         homogeneous(d);
         d.media.back().footprint.polygon = {{1, 1}, {19, 1}, {19, 14}, {10, 9}, {1, 14}};
       }},
      {"", "a quadric",
       [](SceneDescription& d) {
         without_voxels(d);
         light::add_ball(d, {10, 7.5, 1.5}, 12, light::smoke(0.1, 0.8));
       }},
      {"", "a data set of 32^3",
       [](SceneDescription& d) {
         without_voxels(d);
         light::add_cells(
             d, {0, 0, 0}, {20, 15, 3}, 32, [](const glm::dvec3&) { return 0.1; }, 0.8);
       }},
      {"flames", "absent", nothing},
      {"", "unused (out)",
       [](SceneDescription& d) {
         add_flame(d, 0);
         put_flames_out(d);
       }},
      {"", "a ball of fire", [](SceneDescription& d) { add_flame(d, 0.5); }},
      {"volume flux", "absent (medium)", homogeneous},
      {"", "unused (no medium)", [](SceneDescription& d) { d.run.voxels = true; }},
      {"", "20 000 voxels",
       [](SceneDescription& d) {
         homogeneous(d);
         d.run.voxels = true;
       }},
      {"planes", "absent", nothing},
      {"", "unused (below)", [](SceneDescription& d) { add_plane(d, -1); }},
      {"", "300 cells", [](SceneDescription& d) { add_plane(d, 0.85); }},
      {"bands", "absent", nothing},
      {"", "unused (grey)", [](SceneDescription& d) { d.run.max_bands = 8; }},
      {"", "8 bands",
       [](SceneDescription& d) {
         add_reddish(d);
         use_last_material(d);
       }},
      {"glossy lobes", "absent", nothing},
      {"", "unused", add_glossy},
      {"", "a tenth of boxes",
       [](SceneDescription& d) {
         add_glossy(d);
         use_last_material(d);
       }},
      {"mirrors, glass", "absent", nothing},
      {"", "unused",
       [](SceneDescription& d) {
         add_mirror(d);
         add_pane(d);
       }},
      {"", "a tenth mirrors",
       [](SceneDescription& d) {
         add_mirror(d);
         use_last_material(d);
       }},
      {"", "a tenth panes",
       [](SceneDescription& d) {
         add_pane(d);
         use_last_material(d);
       }},
      {"textures", "absent", nothing},
      {"", "unused", add_texture},
      {"", "a tenth of boxes",
       [](SceneDescription& d) {
         add_texture(d);
         use_last_material(d);
       }},
      {"webs", "absent", nothing},
      {"", "unused (dark)",
       [](SceneDescription& d) {
         add_dark_lamp(d);
         std::swap(d.emitters[0], d.emitters[1]);
         add_web(d);
         std::swap(d.emitters[0], d.emitters[1]);
       }},
      {"", "a lamp's", add_web},
      {"eyes", "absent", nothing},
      {"", "unused (no sign)", add_observer},
      {"", "a probe", add_probe},
      {"source groups", "absent", nothing},
      {"", "unused (one lamp)", [](SceneDescription& d) { d.run.groups = GroupRule::by_emitter; }},
      {"", "two groups",
       [](SceneDescription& d) {
         d.run.groups = GroupRule::by_emitter;
         add_second_lamp(d);
       }},
      {"low discrepancy", "absent", [](SceneDescription& d) { d.run.stratified = false; }},
      {"", "used", nothing},
      {"statistics", "absent (not merged)", nothing, By::loop_without_statistics},
      {"", "of batches", nothing},
      {"residency", "absent (merged)", nothing},
      {"", "64 cells, resident", nothing, By::loop, 64},
      {"nodes and hooks", "absent (the loop)", nothing},
      {"", "one node", nothing, By::node},
      {"", "one node, 64 cells", nothing, By::node, 64},
      {"nodes by turns", "absent (the loop)", nothing},
      {"", "hooks unused", nothing, By::node_by_turns},
      {"", "1 of 100 traced", nothing, By::node_by_turns, 1, 100},
      {"", "rare ways taken", nothing, By::node_by_turns, 1, 0, true},
      {"nodes and cells", "absent (the loop)", nothing, By::loop, 64},
      {"", "64 cells, resident", nothing, By::node_by_turns, 64},
      {"", "room for all", nothing, By::node_by_turns, 64, 0, false, 256},
  };
  return all;
}

std::shared_ptr<const CompiledScene> compiled(const Variant& variant) {
  SceneDescription d = furnished(Air::clear, {false, false});
  variant.change(d);
  const Scenario scenario = find_scenario(d, "").value();
  auto scene = compile_scene(std::make_shared<const SceneDescription>(std::move(d)), scenario,
                             {variant.cells});
  if (!scene.ok()) throw std::logic_error(scene.problem().text());
  return scene.value();
}

/// Batches of one variant, as many as requested.
class Batches {
 public:
  explicit Batches(const Variant& variant)
      : by_(variant.by),
        scene_(compiled(variant)),
        run_(scene_, seed, 1),
        tracer_(make_batch_tracer(*scene_, GeometryAccess::resident(run_.index()), seed)),
        plan_(*scene_) {}

  /// Returns the number of particles.
  int64_t trace(int64_t count) {
    if (by_ == By::node) {
      trace_on_node(count);
    } else {
      for (int64_t i = 0; i < count; ++i) trace_one();
    }
    return count * scene_->batch_particles;
  }

 private:
  void trace_one() {
    const Batch batch = plan_.next();
    scores_.reset(scene_->layout);
    tracer_->trace(batch.group, batch.first_particle, scene_->batch_particles, scores_);
    for (uint32_t unit = 0; unit < tracer_->look_units(); ++unit)
      tracer_->look(batch.number, unit, scores_);
    if (by_ == By::loop) run_.totals().merge(scores_, batch.group);
  }

  void trace_on_node(int64_t count) {
    NodesOptions options;
    options.nodes = 1;
    options.profile_share = 0;
    StopRule stop;
    stop.particles = (run_.batches() + count) * scene_->batch_particles;
    const std::atomic<bool> never{false};
    const auto done = run_on_nodes(run_, options, stop, never, [](const Progress&) {});
    if (!done.ok()) throw std::runtime_error(done.problem().text());
  }

  By by_;
  std::shared_ptr<const CompiledScene> scene_;
  LocalRun run_;
  std::unique_ptr<BatchTracer> tracer_;
  BatchPlan plan_;
  BatchScores scores_;
};

/// Particles per second of the process's CPU time.
double speed(Batches& batches, By by) {
  const double start = process_seconds();
  double particles = 0, seconds = 0;
  do {
    // Amortises a node's start and end over many batches.
    particles += static_cast<double>(batches.trace(by == By::node ? 64 : 1));
    seconds = process_seconds() - start;
  } while (seconds < seconds_per_turn);
  return particles / seconds;
}

/// A node and its controller in a simulated world, on this thread: there are no waits, so
/// instruction counts are meaningful. They include the node's start and the world's links.
int64_t trace_by_turns(const Variant& variant) {
  const auto scene = compiled(variant);
  const int64_t particles = batches_of_node * scene->batch_particles;
  const SimScene whole(scene, seed, particles);
  ObserveOptions observe;
  observe.trace_every = variant.trace_every;
  const auto seen = Observation::start(observe);
  SimOptions options;
  options.nodes = 1;
  options.draw_nodes = options.faults = false;
  options.rare_ways = variant.rare_ways;
  options.work = particles * microseconds(10);
  if (variant.trace_every > 0) options.fixed.observation = seen.value().get();
  if (variant.room > 0) {
    const std::array holders{NodeId{0}};
    options.fixed.object_bytes =
        variant.room * SceneObjects(*scene, holders, 1).largest_build_bytes();
  }
  CALLGRIND_ZERO_STATS;
  const auto report = simulate(whole, options);
  if (!report.ok()) throw std::runtime_error(report.problem().text());
  if (!report->failure.empty()) throw std::runtime_error(report->failure);
  return particles;
}

/// One dump for each variant, in this order, with the counts since the previous one.
void count_instructions() {
  for (const Variant& variant : variants()) {
    if (variant.by == By::node) continue;  // threads that wait have no meaningful count
    int64_t particles = 0;
    if (variant.by == By::node_by_turns) {
      particles = trace_by_turns(variant);
    } else {
      Batches batches(variant);
      batches.trace(1);
      CALLGRIND_ZERO_STATS;
      particles = batches.trace(batches_counted);
    }
    const std::string name = fmt::format("{}|{}|{}", variant.feature, variant.state, particles);
    CALLGRIND_DUMP_STATS_AT(name.c_str());
  }
}

}  // namespace

void print_features(int repeats) {
  if (RUNNING_ON_VALGRIND != 0) return count_instructions();
  fmt::print(
      "\nProcessor time of a particle, against a feature's first row; {} pairs\n{:<16} {:<20} "
      "{:>10} {:>7} {:>13}\n",
      repeats, "feature", "state", "ns", "ratio", "spread");
  std::optional<Batches> base;
  const Variant* first = nullptr;
  for (const Variant& variant : variants()) {
    if (variant.by == By::node_by_turns) continue;  // only their instructions are counted
    const bool begins = *variant.feature != '\0';
    if (begins) {
      first = &variant;
      base.emplace(variant);
      base->trace(1);
    }
    std::optional<Batches> own;
    if (!begins) own.emplace(variant);
    std::vector<double> ns, ratio;
    for (int i = 0; i < repeats; ++i) {
      const double reference = speed(*base, first->by);
      const double is = begins ? reference : speed(*own, variant.by);
      ns.push_back(1e9 / is);
      ratio.push_back(reference / is);
    }
    const Summary s = summarise(ratio);
    fmt::print("{:<16} {:<20} {:>10.0f} {:>7.3f} {:>6.3f}-{:.3f}\n", variant.feature, variant.state,
               summarise(ns).median, s.median, s.low, s.high);
    std::fflush(stdout);
  }
}

}  // namespace luxodus::bench
