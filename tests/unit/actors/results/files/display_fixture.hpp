// A small traced scene for tests of its results.
#pragma once

#include <catch2/catch.hpp>
#include <fstream>
#include <iterator>
#include <memory>
#include <string>

#include "actors/results/files/run_results.hpp"
#include "actors/results/run/local_run.hpp"
#include "scenes/formats/scene_file/scene_file.hpp"
#include "scenes/light/transport/compile.hpp"
#include "tests/kit/described.hpp"
#include "tests/kit/temporary_folder.hpp"

namespace luxodus::test {

/// Reads and compiles a scene, first scenario; a problem fails the test with its text.
inline std::shared_ptr<const CompiledScene> scene_of(const std::string& toml, int cells = 1) {
  const auto description = described_text(toml);
  const auto scenario = find_scenario(*description, "");
  REQUIRE(scenario.ok());
  auto compiled = compile_scene(description, scenario.value(), {cells});
  if (!compiled.ok()) FAIL(compiled.problem().text());
  return compiled.value();
}

/// Traces this many particles.
inline std::unique_ptr<LocalRun> traced(const std::string& toml, int64_t particles, int threads = 1,
                                        int cells = 1) {
  auto run = std::make_unique<LocalRun>(scene_of(toml, cells), 11, threads);
  StopRule stop;
  stop.particles = particles;
  run->run(stop, std::atomic<bool>{false}, [](const Progress&) {});
  return run;
}

/// The report of a run, from begin to finish.
inline Result<Json> write_report(const std::filesystem::path& folder, const LocalRun& run,
                                 const RunRecord& record) {
  if (auto ok = begin_results(folder, run, record); !ok) return ok.problem();
  return finish_results(folder, run, record);
}

inline std::string file_text(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

}  // namespace luxodus::test
