// The options of `luxodus run`, and which of them can be combined. One thread.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "actors/apps/cli/command.hpp"
#include "actors/apps/cli/options.hpp"
#include "actors/apps/cli/picture_choices.hpp"
#include "actors/results/run/local_run.hpp"
#include "runtime/core/clock.hpp"

namespace luxodus::cli {

struct RunOptions {
  std::string scene;
  std::string out;
  std::string scenario;
  std::string at;
  std::string particles, error, time;
  std::vector<std::string> error_of;
  std::string preview;
  std::optional<uint64_t> seed;
  int threads = default_threads();
  int cells = 1;
  int nodes = 0;  // 0: the plain loop
  uint64_t fibers = 1;
  double part_cache_mib = 0;
  double tally_mib = 0;
  int tally_shards = 1;
  uint32_t fan_out = 0;
  std::string profile = "1%";
  bool no_sharing = false;
  uint64_t prefetch = 0;
  std::string link_delay;
  std::optional<uint16_t> metrics_port;
  uint64_t trace_every = 0;
  bool plan = false;
  std::string checkpoint = "5m";
  bool resume = false;
  bool overwrite = false;
  bool adaptive = false;
  bool no_views = false;
  bool raw = false;
  bool json = false;
  bool verbose = false;
  PictureChoices picture;

  size_t part_cache_bytes() const { return static_cast<size_t>(part_cache_mib * 1024 * 1024); }
};

/// The table of options. Requires: `options` outlives it.
std::vector<Option> options_of(RunOptions& options);
/// The notes below it in the help.
const char* run_notes();

/// Errors: options that need another one, or exclude each other.
Result<void> fit_together(const RunOptions& options);

/// When the run ends. Errors: an invalid count, share or time.
Result<StopRule> stop_rule(const RunOptions& options);

/// Errors: an invalid time span, or one that is longer than links tolerate.
Result<Nanoseconds> link_delay_of(const RunOptions& options);

}  // namespace luxodus::cli
