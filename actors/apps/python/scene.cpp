#include "actors/apps/python/scene.hpp"

#include <fmt/format.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include "actors/apps/python/apart.hpp"
#include "actors/apps/python/assessed.hpp"
#include "actors/apps/python/changes.hpp"
#include "actors/apps/python/errors.hpp"
#include "actors/apps/python/traced.hpp"
#include "actors/judge/inspect/inspect.hpp"
#include "actors/results/run/default_threads.hpp"
#include "actors/results/run/open_scene.hpp"

namespace luxodus::python {

namespace py = pybind11;

namespace {

namespace fs = std::filesystem;

/// The names of a list of the scene, in its order.
template <class List>
std::vector<std::string> names_of(const List& list) {
  std::vector<std::string> out;
  for (const auto& one : list) out.push_back(one.name);
  return out;
}

template <class Member>
void add_names(py::class_<OpenScene>& scene, const char* name, Member list, const char* what) {
  scene.def_property_readonly(
      name, [list](const OpenScene& s) { return names_of((*s.description()).*list); }, what);
}

py::list findings_of(const OpenScene& scene, const std::string& scenario, int threads) {
  std::vector<Finding> found;
  work_apart(py::none(), [&](WaitingThread&) {
    const auto chosen = taken(chosen_scenarios(*scene.description(), scenario));
    found = taken(inspect(scene.description(), chosen, threads));
  });
  py::list out;
  for (const Finding& finding : found) {
    py::dict one;
    one["severity"] = word_of(finding.severity);
    one["kind"] = finding.kind;
    one["file"] = finding.problem.where.file;
    one["line"] = finding.problem.where.line;
    one["what"] = finding.problem.what;
    out.append(one);
  }
  return out;
}

std::vector<std::string> warnings_of(const OpenScene& scene) {
  std::vector<std::string> out;
  for (const Problem& warning : scene.description()->warnings) out.push_back(warning.text());
  return out;
}

void add_lists(py::class_<OpenScene>& scene) {
  using Scene = SceneDescription;
  add_names(scene, "scenarios", &Scene::scenarios, "Names of the scenarios.");
  add_names(scene, "luminaires", &Scene::emitters, "Names of luminaires and other emitters.");
  add_names(scene, "signs", &Scene::signs, "Names of the signs.");
  add_names(scene, "media", &Scene::media, "Names of smoke and other media.");
  add_names(scene, "materials", &Scene::materials, "Names of the materials.");
  add_names(scene, "objects", &Scene::objects, "Names of the objects.");
  add_names(scene, "planes", &Scene::planes, "Names of the planes of illuminance.");
  add_names(scene, "probes", &Scene::probes, "Names of the probes.");
  add_names(scene, "observers", &Scene::observers, "Names of the observers.");
  add_names(scene, "cameras", &Scene::cameras, "Names of the cameras.");
  add_names(scene, "routes", &Scene::routes, "Names of the escape routes.");
  add_names(scene, "open_areas", &Scene::open_areas, "Names of the open areas.");
  add_names(scene, "task_areas", &Scene::task_areas, "Names of the task areas.");
}

}  // namespace

OpenScene OpenScene::load(const fs::path& file, const py::list& changes,
                          std::optional<double> at_s) {
  OpenScene out;
  out.file_ = fs::absolute(file).string();
  out.changes_ = changes_text(changes);
  out.at_s_ = at_s;
  OpenedScene opened;
  work_apart(py::none(),
             [&](WaitingThread&) { opened = open_scene(out.file_, at_s, out.changes_); });
  if (!opened.scene) throw Refused(opened.problems.list());
  out.description_ = std::move(opened.scene);
  return out;
}

SceneAtTime OpenScene::reader() const {
  return reader_at_times(*description_, file_, FireFrames::nearest, changes_);
}

std::shared_ptr<const SceneDescription> OpenScene::at_frames() const {
  const auto& media = description_->media;
  if (description_->packed ||
      std::none_of(media.begin(), media.end(), [](const Medium& m) { return m.simulation; }))
    return description_;
  return taken(reopen_scene(*description_, file_, at_s_, FireFrames::nearest, changes_));
}

void add_scene(py::module_& module) {
  py::class_<OpenScene> scene(module, "Scene", "A scene that was read: what load() returns.");
  scene
      .def_property_readonly(
          "name", [](const OpenScene& s) { return s.description()->name; }, "Its name.")
      .def_property_readonly(
          "title", [](const OpenScene& s) { return s.description()->title; }, "Its title.")
      .def_property_readonly(
          "file", [](const OpenScene& s) { return s.file(); }, "Path of its file, absolute.")
      .def_property_readonly(
          "at_s", [](const OpenScene& s) { return s.description()->at_s; },
          "Time of the state that it is in [s]; None where nothing changes in time.")
      .def_property_readonly(
          "content_hash",
          [](const OpenScene& s) { return fmt::format("{:016x}", s.description()->content_hash); },
          "Of every byte of every file that was read, as text.")
      .def_property_readonly("warnings", warnings_of, "What the reader found odd, a text each.")
      .def("check", findings_of, py::arg("scenario") = "all",
           py::arg("threads") = default_threads(),
           "Probable mistakes, as `luxodus check` finds them: a list of dicts with severity, kind, "
           "file, line and what; errors first.")
      .def("__repr__", [](const OpenScene& s) {
        return fmt::format("<luxodus.Scene {} of {}>", s.description()->name, s.file());
      });
  add_lists(scene);
  add_tracing(scene);
  add_assessing(scene);
  module.def("load", &OpenScene::load, py::arg("path"), py::kw_only(),
             py::arg("changes") = py::list(), py::arg("at_s") = py::none(),
             "Reads a scene file or a pack, and all that it names.\n\n"
             "changes: dicts with the keys of [[change]], such as {\"kind\": \"medium\", \"of\": "
             "\"smoke\", \"factor\": 2}.\n"
             "at_s: time of the state of a scene that changes in time [s], instead of its own.\n"
             "Raises Error with all problems of the file.");
}

}  // namespace luxodus::python
