// luxodus info: what this program is made of, and whether this machine can run it.
#include <fmt/format.h>

#include <sstream>
#include <string>

#include "actors/cli/command.hpp"
#include "actors/output/json_out.hpp"
#include "scenes/intersect/embree_scene.hpp"

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
  std::istringstream built_with(LUX_PACKAGES);
  for (std::string line; std::getline(built_with, line);) {
    const size_t blank = line.rfind(' ');
    packages[line.substr(0, blank)] = line.substr(blank + 1);
  }
  return {{"version", LUX_VERSION},
          {"build", LUX_BUILD},
          {"compiler", fmt::format("GCC {}", __VERSION__)},
          {"built_for", LUX_BUILT_FOR},
          {"this_processor", instruction_set()},
          {"embree_instruction_sets", EmbreeDevice::instruction_sets()},
          {"threads", default_threads()},
          {"packages", packages}};
}

void print(const Json& j, int indent) {
  for (const auto& [key, value] : j.items()) {
    if (value.is_object()) {
      std::printf("%s\n", key.c_str());
      print(value, indent + 2);
      continue;
    }
    const std::string text = value.is_string() ? value.get<std::string>() : value.dump();
    std::printf("%*s%-24s %s\n", indent, "", key.c_str(), text.c_str());
  }
}

}  // namespace

void add_info(CLI::App& app, int& exit_code) {
  auto json = std::make_shared<bool>(false);
  CLI::App* command = app.add_subcommand("info", "Version, build, packages, instruction set");
  command->footer("Compare flux files bit for bit between machines whose instruction sets agree.");
  command->add_flag("--json", *json, "machine-readable");
  command->callback([json, &exit_code] {
    const Json j = info();
    if (*json)
      std::fputs(json_text(j).c_str(), stdout);
    else
      print(j, 0);
    exit_code = ExitCode::success;
  });
}

}  // namespace luxodus::cli
