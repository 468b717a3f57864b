// luxodus: light in smoke-filled buildings. Wires the subcommands together and nothing else.
#include <fcntl.h>
#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <exception>
#include <iostream>
#include <numeric>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

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

/// A standard stream that is closed would have its number given to the next file that is opened,
/// and what is printed would go into a result.
void hold_standard_streams() {
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    if (::fcntl(stream, F_GETFD) >= 0) continue;
    // The lowest free number is this one. Nothing can be written to standard output then, which
    // when_printed() finds out.
    (void)::open("/dev/null", stream == STDERR_FILENO ? O_WRONLY : O_RDONLY);
  }
}

/// Changes of one character that make one word of the other.
size_t distance(std::string_view a, std::string_view b) {
  std::vector<size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), size_t{0});
  for (size_t i = 1; i <= a.size(); ++i) {
    size_t diagonal = row[0];
    row[0] = i;
    for (size_t j = 1; j <= b.size(); ++j) {
      const size_t replaced = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
      diagonal = row[j];
      row[j] = std::min({row[j] + 1, row[j - 1] + 1, replaced});
    }
  }
  return row.back();
}

/// A first word that is no command, with the command that was likely meant; nothing where all is
/// well or the parser says it better.
std::optional<std::string> unknown_command(const CLI::App& app, int argc, char** argv) {
  if (argc < 2 || argv[1][0] == '-') return std::nullopt;
  const std::string word = argv[1];
  std::string nearest;
  size_t least = word.size() / 3 + 2;  // farther is another word
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; })) {
    const std::string& name = command->get_name();
    if (name == word) return std::nullopt;
    if (const size_t d = distance(word, name); d < least) {
      least = d;
      nearest = name;
    }
  }
  return "there is no command \"" + word + "\"" +
         (nearest.empty() ? "; " : ": did you mean " + nearest + "? ") +
         "luxodus --help lists all commands";
}

/// What was printed has arrived, or the exit code says that it has not: a script that reads a
/// report cut off by a full disk must not take it for whole.
int when_printed(int exit_code) {
  std::cout.flush();
  const bool whole = std::fflush(stdout) == 0 && std::ferror(stdout) == 0 && std::cout.good();
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
  // A reader that goes away is an error of writing, not the end of a run that has yet to be saved.
  std::signal(SIGPIPE, SIG_IGN);
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
      "`luxodus COMMAND --help` tells more; scenes/scene_file/README.md explains scene files.");
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
  if (const auto unknown = unknown_command(app, argc, argv)) {
    tell({{}, *unknown});
    return ExitCode::bad_input;
  }
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    return when_printed(app.exit(e) == 0 ? ExitCode::success : ExitCode::bad_input);
  } catch (const std::exception& e) {
    spdlog::error("{}", e.what());
    return when_printed(ExitCode::failure);
  }
  return when_printed(exit_code);
}
