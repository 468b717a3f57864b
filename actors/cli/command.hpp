// What the subcommands share: exit codes, reading a scene with all its problems told, numbers with
// units.
#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "actors/display/report.hpp"
#include "actors/run/local_run.hpp"
#include "scenes/world/description.hpp"

namespace luxodus::cli {

enum ExitCode : int { success = 0, failure = 1, bad_input = 2, interrupted = 130 };

/// Adds a subcommand to the program; its action sets `exit_code`.
void add_run(CLI::App& app, int& exit_code);
void add_check(CLI::App& app, int& exit_code);
void add_pack(CLI::App& app, int& exit_code);
void add_render(CLI::App& app, int& exit_code);
void add_converge(CLI::App& app, int& exit_code);
void add_info(CLI::App& app, int& exit_code);
void add_topology(CLI::App& app, int& exit_code);
void add_node(CLI::App& app, int& exit_code);
void add_cluster(CLI::App& app, int& exit_code);
void add_status(CLI::App& app, int& exit_code);
void add_keygen(CLI::App& app, int& exit_code);
void add_profile(CLI::App& app, int& exit_code);
void add_deploy(CLI::App& app, int& exit_code);
void add_sim(CLI::App& app, int& exit_code);
void add_study(CLI::App& app, int& exit_code);
void add_assess(CLI::App& app, int& exit_code);
void add_report(CLI::App& app, int& exit_code);
void add_compare(CLI::App& app, int& exit_code);
void add_view(CLI::App& app, int& exit_code);
void add_validate(CLI::App& app, int& exit_code);

/// One line "file:line: sentence" on standard error.
void tell(const Problem& problem);

/// The scene of a scene file or a pack, or null after every problem was told.
std::shared_ptr<const SceneDescription> load_scene(const std::string& file);

/// The scenarios that a name stands for: one, all of them for "all", the first for "".
Result<std::vector<Scenario>> chosen_scenarios(const SceneDescription& scene,
                                               const std::string& name);

/// "1e6", "250k", "10M", "2G" -> a count; "1%", "0.01" -> a share; "90", "60s", "5m", "1h" ->
/// seconds.
Result<int64_t> parse_count(const std::string& text);
Result<double> parse_share(const std::string& text);
Result<double> parse_seconds(const std::string& text);

/// For --seed: whole decimal numbers of 64 bits pass, all else is refused with a sentence. By
/// itself CLI11 takes -1 and 99999999999999999999 for 2^64 - 1, and 010 for 8.
CLI::Validator seed_number();

/// Threads to use when the caller names none.
int default_threads();

/// Set by Ctrl-C (and SIGTERM) once installed; the second Ctrl-C ends the program at once.
const std::atomic<bool>& interrupt_flag();
void install_interrupt_handler();
/// Set by SIGUSR1 once installed: somebody wants to see pictures now.
std::atomic<bool>& preview_flag();
void install_preview_handler();

/// How far some work is. On a terminal one line that is rewritten; elsewhere a line in the log for
/// each tenth of the work, not more often than every half minute, and one at the end of what took
/// longer.
class ProgressLine {
 public:
  explicit ProgressLine(const std::string& title);
  ~ProgressLine();
  void show(const Progress& progress);
  /// Adds an estimate of the time that is left.
  void show_share(double share);
  /// `last`: all is done. `share`: of the work, where it is known.
  void put(const std::string& text, bool last, std::optional<double> share = {});

 private:
  bool is_worth_a_line(bool last, std::optional<double> share);

  std::string title_;
  bool terminal_;
  bool shown_ = false;
  double began_s_;
  double logged_s_;
  int tenths_ = 0;
};

/// "45 s", "12 min", "3.4 h".
std::string time_text(double seconds);

/// write_report, with its progress shown where that takes more than a moment.
Result<Json> write_report_aloud(const std::filesystem::path& folder, const LocalRun& run,
                                const RunRecord& record);

/// "1.23 M", "45.6 k".
std::string short_number(double v);

}  // namespace luxodus::cli
