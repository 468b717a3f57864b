#include "actors/apps/python/traced.hpp"

#include <fmt/format.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <optional>

#include "actors/apps/python/apart.hpp"
#include "actors/apps/python/errors.hpp"
#include "actors/apps/python/fallback.hpp"
#include "actors/apps/python/numbers.hpp"
#include "actors/apps/python/shown.hpp"
#include "actors/apps/python/values.hpp"
#include "actors/cast/process/in_process.hpp"
#include "actors/results/files/maps.hpp"
#include "actors/results/pictures/view_files.hpp"
#include "actors/results/run/adaptive_shares.hpp"
#include "actors/results/run/default_threads.hpp"
#include "actors/results/run/open_scene.hpp"

namespace luxodus::python {

namespace py = pybind11;

namespace {

/// The arguments of a run from Python.
struct RunWish {
  std::string scenario;
  std::optional<double> particles, error, time_s;
  std::vector<std::string> error_of;
  std::optional<uint64_t> seed;
  int threads = 1;
  int cells = 1;
  bool adaptive = false;
  int nodes = 0;
};

StopRule stop_rule(const std::optional<double>& particles, const std::optional<double>& error,
                   const std::optional<double>& time_s) {
  StopRule rule;
  if (particles) rule.particles = whole_between("particles", *particles, 1, 1e18);
  if (error) rule.relative_error = between("error", *error, 0, 1);
  if (time_s) rule.seconds = between("time_s", *time_s, 0, 1e9);
  if (!particles && !error && !time_s) rule.particles = usual_particles;
  return rule;
}

WaitingThread::Said said_of(const Progress& p) {
  return [p] {
    py::dict said;
    said["particles"] = p.particles;
    said["seconds"] = p.seconds;
    said["particles_per_second"] = p.particles_per_second;
    said["relative_error"] = p.relative_error;
    said["seconds_left"] = p.seconds_left;
    return shown_as("Values", said);
  };
}

/// Refuses to guess which scenario is meant.
void check_named(const SceneDescription& scene, const std::string& scenario) {
  if (!scenario.empty() || scene.scenarios.size() < 2) return;
  std::string names;
  for (const Scenario& one : scene.scenarios)
    names += (names.empty() ? "\"" : ", \"") + one.name + "\"";
  throw Refused(problem_in(scene.file, "name one of its scenarios: " + names));
}

std::unique_ptr<TracedRun> run_of(const OpenScene& scene, const RunWish& wish,
                                  const py::object& progress) {
  const StopRule rule = stop_rule(wish.particles, wish.error, wish.time_s);
  whole_between("threads", wish.threads, 1, limits::threads);
  whole_between("cells", wish.cells, 1, 1'000'000);
  whole_between("nodes", wish.nodes, 0, limits::nodes_in_process);
  std::unique_ptr<LocalRun> run;
  work_apart(progress, [&](WaitingThread& waiting) {
    const auto& description = scene.description();
    const uint64_t seed = wish.seed.value_or(description->run.seed);
    check_named(*description, wish.scenario);
    const Scenario scenario = taken(find_scenario(*description, wish.scenario));
    const auto first_round = [&](const Progress& p) { waiting.say(said_of(p)); };
    const CompileOptions options{wish.cells, wish.error_of};
    auto compiled = taken(compile_scene(description, scenario, options));
    if (wish.adaptive)
      compiled = taken(dealt_adaptively(compiled, options, seed, wish.threads, waiting.interrupt(),
                                        first_round));
    run = std::make_unique<LocalRun>(std::move(compiled), seed, wish.threads);
  });
  RunRecord record;
  record.scene_file = scene.file();
  record.at_s = scene.at_s();
  record.cells = wish.cells;
  auto out = std::make_unique<TracedRun>(std::move(run), nodes_that_trace(wish.nodes), record);
  out->trace(rule, progress);
  return out;
}

/// The arrays of a plane, cells by [v, u], and its values in result.json.
py::object plane_of(const PlaneMap& map, const PlaneMeasure& plane, const py::dict& values) {
  const std::vector<py::ssize_t> shape{plane.cells_v, plane.cells_u};
  std::vector<double> total, error, indirect, at_points;
  for (size_t cell = 0; cell < map.centres().size(); ++cell) {
    total.push_back(map.total(cell).value);
    error.push_back(map.total(cell).standard_error);
    indirect.push_back(map.indirect_lx[cell].value);
    at_points.push_back(map.at_point(cell).value);
  }
  py::dict out = values.attr("copy")();
  out["grid_m"] = places_of(map.centres(), shape);
  out["illuminance_lx"] = array_of(total, shape);
  out["standard_error_lx"] = array_of(error, shape);
  out["indirect_illuminance_lx"] = array_of(indirect, shape);
  out["direct_illuminance_lx"] = array_of(map.light.mean_lx, shape);
  out["luminaires_direct_in_clear_air_lx"] = array_of(map.light.mean_clear_lx, shape);
  out["illuminance_at_grid_points_lx"] = array_of(at_points, shape);
  out["luminaires_direct_in_clear_air_at_grid_points_lx"] =
      array_of(map.light.point_clear_lx, shape);
  return shown_as("Plane", out);
}

py::array_t<float> luminance_of(const XyzPicture& picture) {
  std::vector<float> out;
  for (size_t i = 0; i < picture.pixels(); ++i) out.push_back(picture.xyz[3 * i + 1]);
  return array_of(out, {picture.height, picture.width});
}

py::object view_of(const Camera& camera, const ShownView& view) {
  const std::vector<py::ssize_t> shape{camera.height, camera.width};
  py::dict out;
  out["name"] = camera.name;
  out["paths"] = view.paths;
  out["luminance_cd_m2"] = luminance_of(view.traced.light);
  out["standard_error_cd_m2"] = array_of(view.traced.standard_error_y, shape);
  out["xyz_cd_m2"] = array_of(view.traced.light.xyz, {camera.height, camera.width, 3});
  if (view.filtered) {
    out["filtered_luminance_cd_m2"] = luminance_of(view.filtered->light);
    out["filtered_standard_error_cd_m2"] = array_of(view.filtered->standard_error_y, shape);
  }
  return shown_as("View", out);
}

}  // namespace

/// Keeps other Python threads from using the run.
class TracedRun::Claim {
 public:
  explicit Claim(TracedRun& run) : run_(run) {
    if (run_.taken_.exchange(true))
      throw Refused(problem("another thread is tracing or reading this run: wait for it"));
  }
  ~Claim() { run_.taken_ = false; }
  Claim(const Claim&) = delete;

 private:
  TracedRun& run_;
};

TracedRun::TracedRun(std::unique_ptr<LocalRun> run, std::unique_ptr<RunExecutor> executor,
                     RunRecord record)
    : run_(std::move(run)), executor_(std::move(executor)), record_(std::move(record)) {}

void TracedRun::trace(const StopRule& stop, const py::object& progress) {
  const Claim claim(*this);
  computed_ = false;
  std::string stopped_by = record_.stopped_by;
  // Other Python threads may read the members below while the work goes on: only here they change.
  const auto note = [&] {
    record_.stopped_by = stopped_by;
    record_.stop = stop;
    particles_ = run_->particles();
  };
  try {
    work_apart(progress, [&](WaitingThread& waiting) {
      RunThreads threads;
      RunExecutor& executor = executor_ ? *executor_ : threads;
      const auto report = [&](const Progress& p) { waiting.say(said_of(p)); };
      stopped_by = name_of(taken(executor.run(*run_, stop, waiting.interrupt(), report)));
    });
  } catch (...) {
    note();
    throw;
  }
  note();
}

void TracedRun::compute() {
  const Claim claim(*this);
  if (computed_) return;
  PlaneMaps maps;
  Json json;
  work_apart(py::none(), [&](WaitingThread&) {
    maps = make_plane_maps(*run_);
    json = result_json(*run_, record_, maps);
  });
  const auto& description = *run_->scene().description;
  result_ = to_python(json);
  py::dict planes;
  const py::list values = result_["planes"];
  for (size_t i = 0; i < maps.planes.size(); ++i)
    planes[py::str(description.planes[i].name)] =
        plane_of(maps.planes[i], description.planes[i], py::dict(values[i]));
  planes_ = names_of("plane", planes);
  computed_ = true;
}

const py::dict& TracedRun::result() {
  compute();
  return result_;
}

const py::dict& TracedRun::planes() {
  compute();
  return planes_;
}

py::object TracedRun::patches() {
  const Claim claim(*this);
  VtkSurface surface;
  work_apart(py::none(), [&](WaitingThread&) { surface = taken(surface_flux(*run_)); });
  const auto triangles = static_cast<py::ssize_t>(surface.triangles.size());
  std::vector<uint32_t> corners;
  for (const glm::uvec3& t : surface.triangles) corners.insert(corners.end(), {t.x, t.y, t.z});
  py::dict out;
  out["points_m"] = places_of(surface.points, {static_cast<py::ssize_t>(surface.points.size())});
  out["triangles"] = array_of(corners, {triangles, 3});
  add_arrays(out, surface.cell_data, {triangles});
  return shown_as("Values", out);
}

py::object TracedRun::voxels() {
  const Claim claim(*this);
  if (!(run_->scene().voxels.edge > 0)) return py::none();
  VtkVolume volume;
  work_apart(py::none(), [&](WaitingThread&) { volume = volume_flux(*run_); });
  py::dict out;
  out["origin_m"] = array_of(std::vector{volume.origin.x, volume.origin.y, volume.origin.z}, {3});
  out["edge_m"] = volume.spacing.x;
  add_arrays(out, volume.cell_data, {volume.cells[2], volume.cells[1], volume.cells[0]});
  return shown_as("Values", out);
}

py::dict TracedRun::energy_balance() {
  py::dict out;
  for (const auto& [key, value] : result()["ledger"].cast<py::dict>()) {
    const bool is_text =
        py::isinstance<py::str>(value) && py::str(key).cast<std::string>() != "unit";
    out[key] = is_text ? whole_number(value.cast<std::string>())
                       : py::reinterpret_borrow<py::object>(value);
  }
  return out;
}

py::object TracedRun::render(const std::string& camera, int paths, const py::object& progress) {
  const Claim claim(*this);
  const auto& cameras = run_->scene().description->cameras;
  std::optional<ShownView> view;
  const Camera* shown = nullptr;
  work_apart(progress, [&](WaitingThread& waiting) {
    PictureOptions options;
    options.paths_per_pixel = paths;
    options.interrupt = &waiting.interrupt();
    succeed(check_views(*run_->scene().description, camera, options));
    const auto at = std::find_if(cameras.begin(), cameras.end(),
                                 [&](const Camera& one) { return one.name == camera; });
    if (at == cameras.end()) throw Refused(problem("say the name of a camera"));
    shown = &*at;
    const auto flux = run_->particles() > 0 ? flux_radiance(*run_) : nullptr;
    TracedPicture traced = trace_picture(
        *run_, static_cast<size_t>(at - cameras.begin()), options, flux.get(),
        [&](double share) { waiting.say([share] { return py::object(py::float_(share)); }); });
    if (options.interrupted()) throw Refused(problem("interrupted: there is no picture"));
    view.emplace(std::move(traced), paths, options, run_->threads());
  });
  return view_of(*shown, *view);
}

void add_run(py::module_& module) {
  py::class_<TracedRun> run(
      module, "Run",
      "A traced scenario: what Scene.run() returns. Besides the attributes below it has every key "
      "of result.json.");
  run.def_property_readonly("result", &TracedRun::result, "All of result.json, as a dict.")
      .def_property_readonly(
          "planes", &TracedRun::planes,
          "Planes by name. Each has the values of result.json, and arrays [cells_v, cells_u]: "
          "illuminance_lx and standard_error_lx (means over cells), direct_illuminance_lx, "
          "indirect_illuminance_lx, luminaires_direct_in_clear_air_lx, and at the cells' centres "
          "illuminance_at_grid_points_lx and luminaires_direct_in_clear_air_at_grid_points_lx; "
          "grid_m: the centres [cells_v, cells_u, 3]. NaN in cells within bodies.")
      .def_property_readonly(
          "patches", &TracedRun::patches,
          "Flux on surfaces: points_m [points, 3], triangles [patches, 3] (numbers of points), and "
          "a value for each patch: incident_front_lx, outgoing_front_lm_m2, the same of the back, "
          "their standard errors such as incident_front_standard_error_lx, surface, triangle.")
      .def_property_readonly(
          "voxels", &TracedRun::voxels,
          "Light in the air, None without voxels: origin_m [3], edge_m, and arrays [z, y, x]: "
          "fluence_lm_m2, fluence_standard_error_lm_m2, vector_flux_lm_m2 [z, y, x, 3], "
          "absorbed_lm_m3, scattered_lm_m3.")
      .def_property_readonly("energy_balance", &TracedRun::energy_balance,
                             "The ledger of result.json with its sums as whole numbers.")
      .def_property_readonly(
          "particles", [](const TracedRun& r) { return r.particles(); },
          "Number of particles traced.")
      .def_property_readonly(
          "stopped_by", [](const TracedRun& r) { return r.stopped_by(); },
          "Why it stopped: particles, error, time or interrupted.")
      .def(
          "go_on",
          [](TracedRun& r, std::optional<double> particles, std::optional<double> error,
             std::optional<double> time_s, const py::object& progress) {
            r.trace(stop_rule(particles, error, time_s), progress);
          },
          py::kw_only(), py::arg("particles") = py::none(), py::arg("error") = py::none(),
          py::arg("time_s") = py::none(), py::arg("progress") = py::none(),
          "Traces more, until as many particles in all, the error or the time.")
      .def("render", &TracedRun::render, py::arg("camera"), py::kw_only(), py::arg("paths") = 28,
           py::arg("progress") = py::none(),
           "The picture of a camera from this run's light: luminance_cd_m2 and "
           "standard_error_cd_m2 [height, width], top row first, xyz_cd_m2 [height, width, 3]; "
           "from 4 paths per pixel on filtered_luminance_cd_m2 and "
           "filtered_standard_error_cd_m2. progress: a callable of the share done.")
      .def("__getattr__",
           [](TracedRun& r, const std::string& name) {
             return value_of([&]() -> const py::dict& { return r.result(); }, name, "Run");
           })
      .def(
          "__dir__",
          [](const py::object& self) { return names_with(self, self.cast<TracedRun&>().result()); })
      .def("__repr__", [](const TracedRun& r) {
        return fmt::format("<luxodus.Run of {}, scenario {}: {} particles>",
                           r.run().scene().description->name, r.run().scene().scenario.name,
                           r.particles());
      });
}

void add_tracing(py::class_<OpenScene>& scene) {
  scene.def(
      "run",
      [](const OpenScene& s, const std::string& scenario, std::optional<double> particles,
         std::optional<double> error, std::optional<double> time_s,
         std::vector<std::string> error_of, std::optional<uint64_t> seed, int threads, int cells,
         bool adaptive, int nodes, const py::object& progress) {
        return run_of(s,
                      {scenario, particles, error, time_s, std::move(error_of), seed, threads,
                       cells, adaptive, nodes},
                      progress);
      },
      py::arg("scenario") = "", py::kw_only(), py::arg("particles") = py::none(),
      py::arg("error") = py::none(), py::arg("time_s") = py::none(),
      py::arg("error_of") = std::vector<std::string>(), py::arg("seed") = py::none(),
      py::arg("threads") = default_threads(), py::arg("cells") = 1, py::arg("adaptive") = false,
      py::arg("nodes") = 0, py::arg("progress") = py::none(),
      "Traces a scenario, which must be named where the scene has several, and returns a Run.\n\n"
      "particles, error, time_s: when it stops, the first that holds: number of particles, "
      "relative standard error, seconds. 4 million particles unless one is said.\n"
      "error_of: what the error is of, as --error-of of `luxodus run`.\n"
      "seed: of the random numbers, the scene's unless said. Equal scene, seed, particles and "
      "cells "
      "give equal results, bit for bit, whatever the threads and nodes.\n"
      "threads, nodes: who traces; with nodes they are of this process, a thread each.\n"
      "adaptive: particles go where error_of needs them.\n"
      "progress: a callable, called some times a second on this thread with particles, seconds, "
      "particles_per_second, relative_error, seconds_left. Where it returns False the run stops "
      "with what it has; what it raises stops the run, too, and is raised here.");
}

}  // namespace luxodus::python
