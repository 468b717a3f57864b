// The Python module luxodus: load() gives a Scene, whose run() and assess() give a Run and an
// Assessment. It logs to standard error, as the program does.
#include <dlfcn.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <spdlog/sinks/stdout_sinks.h>
#include <spdlog/spdlog.h>

#include <cstring>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "actors/apps/python/assessed.hpp"
#include "actors/apps/python/errors.hpp"
#include "actors/apps/python/scene.hpp"
#include "actors/apps/python/shown.hpp"
#include "actors/apps/python/traced.hpp"
#include "runtime/core/isolated_job.hpp"

namespace {

namespace py = pybind11;

/// Checked first: the module is compiled for a processor generation.
void check_processor() {
  __builtin_cpu_init();
  if (std::strcmp(LUX_ARCH, "x86-64-v3") == 0 && !__builtin_cpu_supports("x86-64-v3"))
    throw py::import_error(
        "this build of luxodus needs a processor with AVX2 and FMA (x86-64-v3); build it with "
        "-DLUX_ARCH=x86-64-v2");
}

/// The file of this module; "" if unknown. Python knows it only once the module is loaded.
std::string file_of_module() {
  Dl_info found{};
  if (::dladdr(reinterpret_cast<const void*>(&check_processor), &found) == 0) return {};
  return std::filesystem::absolute(found.dli_fname).string();
}

/// Reads untrusted files in a separate process (runtime/core/isolated_job.hpp): Python again, with
/// only this module.
void have_jobs_begun() {
  constexpr const char* code =
      "import importlib.util as u, sys\n"
      "s = u.spec_from_file_location('luxodus', sys.argv[1])\n"
      "u.module_from_spec(s)._serve_job(sys.argv[2:])\n";
  const py::object python = py::module_::import("sys").attr("executable");
  const std::string file = file_of_module();
  if (!py::isinstance<py::str>(python) || file.empty()) return;  // then such files are refused
  luxodus::begin_isolated_jobs_by({python.cast<std::string>(), "-I", "-S", "-c", code, file});
}

/// Does the job and ends the process. Returns if the words are not those of a job.
void serve_job(std::vector<std::string> words) {
  std::string program = "luxodus";
  std::vector<char*> argv{program.data()};
  for (std::string& word : words) argv.push_back(word.data());
  luxodus::serve_isolated_job(static_cast<int>(argv.size()), argv.data());
}

/// Standard output is the caller's, and so is progress.
void log_to_standard_error() {
  spdlog::set_default_logger(std::make_shared<spdlog::logger>(
      "luxodus", std::make_shared<spdlog::sinks::stderr_sink_mt>()));
  spdlog::set_level(spdlog::level::warn);
}

}  // namespace

PYBIND11_MODULE(luxodus, module) {
  using namespace luxodus::python;
  check_processor();
  log_to_standard_error();
  have_jobs_begun();
  module.doc() =
      "Light in smoke-filled buildings by Monte Carlo particle tracing.\n\n"
      "load() reads a scene file; Scene.run() traces it, Scene.assess() judges its signs and "
      "escape routes. What is wrong raises Error.";
  module.attr("__version__") = LUX_VERSION;
  module.def("_serve_job", serve_job);
  add_error(module);
  add_shown(module);
  add_run(module);
  add_assessment(module);
  add_scene(module);
}
