// luxodus: light in smoke-filled buildings. Wires the subcommands together and nothing else.
#include <fcntl.h>
#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <cstring>
#include <exception>
#include <string>

#include "actors/apps/cli/command.hpp"
#include "actors/apps/cli/commands.hpp"
#include "actors/apps/cli/terminal.hpp"
#include "actors/apps/cli/version.hpp"
#include "runtime/core/isolated_job.hpp"

namespace luxodus::cli {

Command luxodus_command() {
  return {
      .name = "luxodus",
      .summary =
          "Simulates the light in a smoke-filled building by Monte Carlo particle "
          "tracing: what reaches the\nescape routes, and what an eye receives from "
          "the exit signs",
      .notes =
          "First steps:\n"
          "  luxodus check scenes/library/office_floor.toml\n"
          "  luxodus run scenes/library/office_floor.toml --out out/floor --time 30s\n"
          "`luxodus COMMAND --help` tells more, `luxodus keys` what files may say. The documents "
          "explain scene files: docs/reference/scene-file.md.",
      .commands = {check_command(),    pack_command(),
                   import_command(),   run_command(),
                   render_command(),   export_command(),
                   converge_command(), assess_command(),
                   compare_command(),  report_command(),
                   design_command(),   spacing_command(),
                   walk_command(),     people_command(),
                   view_command(),     cluster_command(),
                   node_command(),     status_command(),
                   topology_command(), keygen_command(),
                   profile_command(),  deploy_command(),
                   sim_command(),      study_command(),
                   validate_command(), keys_command(),
                   info_command(),     completion_command(luxodus_command)}};
}

}  // namespace luxodus::cli

namespace {

/// The release is built for a processor generation: an older machine gets a message instead of a
/// crash.
bool processor_is_good_enough() {
  __builtin_cpu_init();
  if (std::strcmp(luxodus::cli::build.architecture, "x86-64-v3") == 0 &&
      !__builtin_cpu_supports("x86-64-v3")) {
    std::fputs(
        "luxodus: this build needs a processor with AVX2 and FMA (x86-64-v3). Build with\n"
        "  cmake --preset release -DLUX_ARCH=x86-64-v2\n",
        stderr);
    return false;
  }
  return true;
}

/// If a standard stream is closed, the next opened file would get its number, and printed text
/// would go into a result.
void hold_standard_streams() {
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    if (::fcntl(stream, F_GETFD) >= 0) continue;
    // The lowest free number is this one. Nothing can be written to standard output then, which
    // when_printed() detects.
    (void)::open("/dev/null", stream == STDERR_FILENO ? O_WRONLY : O_RDONLY);
  }
}

/// Checks that all output was written, and else returns an error code: a script must not take a
/// report for complete that a full disk has cut off.
int when_printed(int exit_code) {
  const bool whole = std::fflush(stdout) == 0 && std::ferror(stdout) == 0;
  if (whole) return exit_code;
  std::fputs(
      "luxodus: standard output could not be written in full (a full disk, or a reader that has "
      "gone)\n",
      stderr);
  return exit_code == luxodus::cli::ExitCode::success ? luxodus::cli::ExitCode::failure : exit_code;
}

}  // namespace

int main(int argc, char** argv) {
  using namespace luxodus::cli;
  if (const auto served = luxodus::serve_isolated_job(argc, argv)) return *served;
  if (!processor_is_good_enough()) return ExitCode::failure;
  hold_standard_streams();
  // A closed pipe is a write error, and must not end a run that has yet to be saved.
  std::signal(SIGPIPE, SIG_IGN);
  spdlog::set_default_logger(spdlog::stderr_color_mt("luxodus"));
  guard_terminal();

  int exit_code = ExitCode::success;
  try {
    const std::string version = std::string("luxodus ") + build.version + " (" + build.commit + ")";
    exit_code = run_command_line(luxodus_command(), version, argc, argv);
  } catch (const std::exception& e) {
    // Printed at every level of logging.
    exit_code = exit_code_of(luxodus::problem(e.what(), luxodus::ProblemKind::system));
  }
  return when_printed(exit_code);
}
