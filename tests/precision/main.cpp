// luxodus_precision: `trace SCENE SCENARIO PARTICLES THREADS FILE` writes the scores of each batch
// of a scene; `compare SINGLE DOUBLE [SINGLE DOUBLE ...]` compares files of the two builds.
// tests/tools/precision.sh calls both.
#include <fmt/core.h>

#include <cstdlib>
#include <stdexcept>

#include "runtime/core/isolated_job.hpp"
#include "scenes/formats/scene_file/scene_file.hpp"
#include "scenes/light/transport/compile.hpp"
#include "tests/precision/batches.hpp"
#include "tests/precision/compare.hpp"

namespace luxodus::precision {
namespace {

std::shared_ptr<const CompiledScene> compiled(const char* file, const char* scenario) {
  ReadScene read = read_scene(file);
  if (!read.scene) throw std::runtime_error(std::string("cannot read ") + file);
  read.scene->run.groups = GroupRule::one;
  auto description = std::make_shared<SceneDescription>(std::move(*read.scene));
  auto chosen = find_scenario(*description, scenario);
  if (!chosen.ok()) throw std::runtime_error(chosen.problem().text());
  auto scene = compile_scene(description, chosen.value(), {});
  if (!scene.ok()) throw std::runtime_error(scene.problem().text());
  return scene.value();
}

void trace(char** arguments) {
  const auto scene = compiled(arguments[0], arguments[1]);
  const auto batches =
      static_cast<int64_t>(std::atof(arguments[2]) / static_cast<double>(scene->batch_particles));
  const auto columns = columns_of(*scene);
  Traced traced;
  traced.precision = computes_in_double ? "double" : "single";
  traced.scene = fmt::format("{}, {} triangles", scene->description->name, scene->triangles);
  traced.batch_particles = static_cast<double>(scene->batch_particles);
  for (const Column& column : columns) {
    traced.kinds.push_back(column.kind);
    traced.names.push_back(column.name);
  }
  traced.rows = trace_batches(*scene, columns, batches, 1, std::atoi(arguments[3]));
  write(traced, arguments[4]);
}

int run(int count, char** words) {
  const std::string command = count > 1 ? words[1] : "";
  if (command == "trace" && count == 7) {
    trace(words + 2);
    return 0;
  }
  if (command == "compare" && count >= 4 && count % 2 == 0) {
    bool passes = true;
    for (int i = 2; i < count; i += 2)
      passes = compare(read(words[i]), read(words[i + 1])) && passes;
    fmt::print("\n{}\n", passes ? "far below the statistical error of 1e9 particles"
                                : "NOT far below the statistical error of 1e9 particles");
    return passes ? 0 : 1;
  }
  fmt::print(stderr,
             "luxodus_precision trace SCENE SCENARIO PARTICLES THREADS FILE\n"
             "luxodus_precision compare SINGLE DOUBLE [SINGLE DOUBLE ...]\n");
  return 2;
}

}  // namespace
}  // namespace luxodus::precision

int main(int count, char** words) {
  if (const auto served = luxodus::serve_isolated_job(count, words)) return *served;
  try {
    return luxodus::precision::run(count, words);
  } catch (const std::exception& e) {
    fmt::print(stderr, "luxodus_precision: {}\n", e.what());
    return 2;
  }
}
