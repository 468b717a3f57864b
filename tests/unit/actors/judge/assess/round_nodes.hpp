// Nodes that trace rounds of an assessment, for tests.
#pragma once

#include <catch2/catch.hpp>
#include <memory>

#include "actors/cast/process/process_executor.hpp"
#include "actors/judge/assess/round_state.hpp"

namespace luxodus::test {

/// Nodes of this process that trace the rounds of a scene.
struct RoundNodes {
  explicit RoundNodes(const std::shared_ptr<const SceneDescription>& scene) : states(scene) {
    auto compiled = compile_scene(scene, find_scenario(*scene, "failed").value(), {1});
    REQUIRE(compiled.ok());
    auto started = ProcessExecutor::start(compiled.value(), states, NodesOptions{});
    REQUIRE(started.ok());
    nodes = std::move(started).value();
  }

  RoundStates states;
  std::unique_ptr<ProcessExecutor> nodes;
};

}  // namespace luxodus::test
