#include "actors/apps/python/assessed.hpp"

#include <fmt/format.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <cmath>

#include "actors/apps/python/apart.hpp"
#include "actors/apps/python/errors.hpp"
#include "actors/apps/python/fallback.hpp"
#include "actors/apps/python/numbers.hpp"
#include "actors/apps/python/shown.hpp"
#include "actors/apps/python/values.hpp"
#include "actors/cast/process/in_process.hpp"
#include "actors/judge/assess/over_time.hpp"
#include "actors/judge/assess/record_assessment.hpp"
#include "actors/results/run/default_threads.hpp"
#include "actors/results/run/open_scene.hpp"

namespace luxodus::python {

namespace py = pybind11;

namespace {

/// assessment.json for Python.
struct MadeAssessment {
  py::dict result;
};

/// Ascending, each once; those of the scene if none is given.
std::vector<double> times_wanted(const OpenScene& scene, std::vector<double> asked) {
  const auto& own = scene.description()->time;
  if (asked.empty() && own && !scene.at_s()) return times_of(*own);
  constexpr size_t max_times = 10'000;
  if (asked.size() > max_times)
    throw Refused(
        problem(fmt::format("times_s has {} times: at most {}", asked.size(), max_times)));
  for (const double time : asked)
    if (!(std::abs(time) < 1e8))
      throw Refused(problem(fmt::format("times_s has {}: write seconds below 1e8", time)));
  std::sort(asked.begin(), asked.end());
  asked.erase(std::unique(asked.begin(), asked.end()), asked.end());
  return asked;
}

MadeAssessment assess_scene(const OpenScene& scene, AssessOptions options, int nodes,
                            const std::vector<double>& times_asked, const py::object& progress) {
  whole_between("threads", options.threads, 1, limits::threads);
  whole_between("rounds", options.rounds, 1, limits::sight_rounds);
  whole_between("nodes", nodes, 0, limits::nodes_in_process);
  for (const double factor : options.smoke_factors)
    if (!(factor >= 0 && factor <= 1e6))
      throw Refused(problem(fmt::format("smoke_factors has {}: write 0 to 1e6", factor)));
  const auto executor = nodes_that_trace(nodes);
  options.executor = executor.get();
  const std::vector<double> times = times_wanted(scene, times_asked);
  Json json;
  work_apart(progress, [&](WaitingThread& waiting) {
    const auto tell = [&](const std::string& what, double share) {
      waiting.say([what, share] {
        py::dict said;
        said["what"] = what;
        said["share"] = share;
        return shown_as("Values", said);
      });
    };
    const SceneAtTime reader = scene.reader();
    const auto last = times.empty() ? scene.at_frames() : taken(reader(times.back()));
    const Assessment made =
        taken(assess_states({last, times, reader}, options, waiting.interrupt(), tell, tell));
    json = assessment_json(record_of(*last, made, LUX_VERSION));
  });
  return {to_python(json)};
}

}  // namespace

void add_assessment(py::module_& module) {
  py::class_<MadeAssessment>(
      module, "Assessment",
      "Signs and escape routes assessed: what Scene.assess() returns. It has every key of "
      "assessment.json as an attribute: verdict, state, counts, checks, sights, signs, luminaires, "
      "places, sweep, over_time and others.")
      .def_readonly("result", &MadeAssessment::result, "All of assessment.json, as a dict.")
      .def("__getattr__",
           [](const MadeAssessment& a, const std::string& name) {
             return value_of([&]() -> const py::dict& { return a.result; }, name, "Assessment");
           })
      .def("__dir__",
           [](const py::object& self) {
             return names_with(self, self.cast<const MadeAssessment&>().result);
           })
      .def("__repr__", [](const MadeAssessment& a) {
        const py::dict counts = a.result["counts"];
        return fmt::format("<luxodus.Assessment of {}: {} checks pass, {} fail>",
                           py::str(a.result["scene"]["name"]).cast<std::string>(),
                           counts["pass"].cast<int64_t>(), counts["fail"].cast<int64_t>());
      });
}

void add_assessing(py::class_<OpenScene>& scene) {
  scene.def(
      "assess",
      [](const OpenScene& s, const std::string& scenario, std::vector<std::string> rules,
         std::vector<std::string> deviations, uint64_t seed, int threads, int nodes, int rounds,
         bool codes_alone, bool place_known, std::vector<double> smoke_factors,
         const std::vector<double>& times_s, const py::object& progress) {
        AssessOptions options;
        options.scenario = scenario;
        options.rules = std::move(rules);
        options.deviations = std::move(deviations);
        options.seed = seed;
        options.threads = threads;
        options.rounds = rounds;
        options.reality = !codes_alone;
        options.place_unknown = !place_known;
        options.smoke_factors = std::move(smoke_factors);
        return assess_scene(s, std::move(options), nodes, times_s, progress);
      },
      py::arg("scenario") = "", py::kw_only(), py::arg("rules") = std::vector<std::string>(),
      py::arg("deviations") = std::vector<std::string>(), py::arg("seed") = 1,
      py::arg("threads") = default_threads(), py::arg("nodes") = 0,
      py::arg("rounds") = AssessOptions().rounds, py::arg("codes_alone") = false,
      py::arg("place_known") = true, py::arg("smoke_factors") = std::vector<double>(),
      py::arg("times_s") = std::vector<double>(), py::arg("progress") = py::none(),
      "Assesses signs and escape routes and returns an Assessment.\n\n"
      "scenario: by name; else the one in emergency operation, with smoke where any has it.\n"
      "rules, deviations: names of rule sets and national deviations; else those of the scene.\n"
      "rounds: largest number of rounds of paths for what is undecided.\n"
      "codes_alone: no smoke and no reflections.\n"
      "place_known: whether people know where the signs are; else a sign is seen at 5 times the\n"
      "contrast.\n"
      "smoke_factors: signs are assessed again with all smoke times each of them.\n"
      "times_s: of the states of a scene that changes in time [s]; else those of [time].\n"
      "progress: a callable, called on this thread with what and share. Where it returns False the "
      "assessment ends with an Error; what it raises ends it, too, and is raised here.");
}

}  // namespace luxodus::python
