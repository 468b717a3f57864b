// luxodus: light in smoke-filled buildings. Wires the subcommands together and nothing else.
#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>

#include <cstring>
#include <exception>

#include "actors/cli/command.hpp"
#include "actors/cli/terminal.hpp"
#include "runtime/core/isolated_job.hpp"

namespace {

/// The release is built for a processor generation; a machine that lacks it is told so, not crashed
/// on.
bool processor_is_good_enough() {
  __builtin_cpu_init();
  if (std::strcmp(LUX_ARCH, "x86-64-v3") == 0 && !__builtin_cpu_supports("x86-64-v3")) {
    std::fputs(
        "luxodus: this build needs a processor with AVX2 and FMA (x86-64-v3). Build with\n"
        "  cmake --preset release -DLUX_ARCH=x86-64-v2\n",
        stderr);
    return false;
  }
  return true;
}

}  // namespace

int main(int argc, char** argv) {
  using namespace luxodus::cli;
  if (const auto served = luxodus::serve_isolated_job(argc, argv)) return *served;
  if (!processor_is_good_enough()) return ExitCode::failure;
  spdlog::set_default_logger(spdlog::stderr_color_mt("luxodus"));
  guard_terminal();

  CLI::App app{
      "Luxodus simulates the light in a smoke-filled building by Monte Carlo particle tracing and "
      "says\n"
      "what reaches the escape routes and what an eye receives from the exit signs."};
  app.require_subcommand(1);
  app.set_version_flag("--version", LUX_VERSION);
  app.footer(
      "First steps:\n"
      "  luxodus check scenes/library/office_floor.toml\n"
      "  luxodus run scenes/library/office_floor.toml --out out/floor --time 30s\n"
      "`luxodus COMMAND --help` tells more; scenes/format/README.md explains scene files.");
  int exit_code = ExitCode::success;
  add_run(app, exit_code);
  add_check(app, exit_code);
  add_pack(app, exit_code);
  add_render(app, exit_code);
  add_converge(app, exit_code);
  add_validate(app, exit_code);
  add_info(app, exit_code);
  add_topology(app, exit_code);
  add_node(app, exit_code);
  add_cluster(app, exit_code);
  add_status(app, exit_code);
  add_keygen(app, exit_code);
  add_profile(app, exit_code);
  add_deploy(app, exit_code);
  add_sim(app, exit_code);
  add_study(app, exit_code);
  add_assess(app, exit_code);
  add_report(app, exit_code);
  add_compare(app, exit_code);
  add_view(app, exit_code);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    return app.exit(e) == 0 ? ExitCode::success : ExitCode::bad_input;
  } catch (const std::exception& e) {
    spdlog::error("{}", e.what());
    return ExitCode::failure;
  }
  return exit_code;
}
