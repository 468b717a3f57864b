// luxodus info: prints the program's components, and whether this machine can run it.
#include <fmt/format.h>

#include <sstream>
#include <string>

#include "actors/apps/cli/command.hpp"
#include "actors/apps/cli/commands.hpp"
#include "actors/apps/cli/version.hpp"
#include "actors/results/formats/json_out.hpp"
#include "scenes/light/intersect/embree_scene.hpp"

namespace luxodus::cli {

namespace {

const char* instruction_set() {
  __builtin_cpu_init();
  if (__builtin_cpu_supports("x86-64-v4")) return "x86-64-v4 (AVX-512)";
  if (__builtin_cpu_supports("x86-64-v3")) return "x86-64-v3 (AVX2, FMA)";
  if (__builtin_cpu_supports("x86-64-v2")) return "x86-64-v2 (SSE4.2)";
  return "x86-64";
}

Json info() {
  Json packages = {{"Embree", EmbreeDevice::library_version()}};
  std::istringstream built_with(build.packages);
  for (std::string line; std::getline(built_with, line);) {
    const size_t blank = line.rfind(' ');
    packages[line.substr(0, blank)] = line.substr(blank + 1);
  }
  return {{"version", build.version},
          {"commit", build.commit},
          {"build", build.type},
          {"compiler", fmt::format("GCC {}", __VERSION__)},
          {"built_for", build.built_for},
          {"this_processor", instruction_set()},
          {"embree_instruction_sets", EmbreeDevice::instruction_sets()},
          {"threads", default_threads()},
          {"packages", packages}};
}

void print_tree(const Json& j, int indent) {
  for (const auto& [key, value] : j.items()) {
    if (value.is_object()) {
      std::printf("%s\n", key.c_str());
      print_tree(value, indent + 2);
      continue;
    }
    const std::string text = value.is_string() ? value.get<std::string>() : value.dump();
    std::printf("%*s%-24s %s\n", indent, "", key.c_str(), text.c_str());
  }
}

}  // namespace

Command info_command() {
  const auto json = std::make_shared<bool>(false);
  return {.name = "info",
          .summary = "Show version, commit, build, packages, instruction set",
          .heading = "Tools",
          .options = {{"--json", json.get(), "Output as JSON"}},
          .notes = "Flux files agree bit for bit between machines whose instruction sets agree.",
          .run = [json] {
            const Json j = info();
            if (*json)
              std::fputs(json_text(j).c_str(), stdout);
            else
              print_tree(j, 0);
            return ExitCode::success;
          }};
}

}  // namespace luxodus::cli
