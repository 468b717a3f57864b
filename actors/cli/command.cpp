#include "actors/cli/command.hpp"

#include <spdlog/spdlog.h>
#include <unistd.h>

#include <atomic>
#include <charconv>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <thread>

#include "runtime/core/printable.hpp"
#include "scenes/format/scene_file.hpp"
#include "scenes/pack/scene_pack.hpp"
#include "scenes/transport/compile.hpp"

namespace luxodus::cli {

void tell(const Problem& problem) {
  std::fprintf(stderr, "%s\n", problem.text().c_str());
}

std::shared_ptr<const SceneDescription> load_scene(const std::string& file) {
  if (is_pack(file)) {
    auto packed = read_pack(file);
    if (packed.ok()) return packed.value();
    tell(packed.problem());
    return nullptr;
  }
  ReadScene read = read_scene(file);
  for (const Problem& p : read.problems.list()) tell(p);
  if (!read.scene) return nullptr;
  for (const Problem& w : read.scene->warnings) spdlog::warn("{}", w.text());
  return std::make_shared<const SceneDescription>(std::move(*read.scene));
}

Result<std::vector<Scenario>> chosen_scenarios(const SceneDescription& scene,
                                               const std::string& name) {
  if (name == "all" && !scene.scenarios.empty()) return scene.scenarios;
  auto one = find_scenario(scene, name == "all" ? "" : name);
  if (!one.ok()) return one.problem();
  return std::vector<Scenario>{one.value()};
}

namespace {

/// A number and what stands behind it.
bool split_number(const std::string& text, double& value, std::string& rest) {
  try {
    size_t used = 0;
    value = std::stod(text, &used);
    rest = text.substr(used);
  } catch (const std::exception&) {
    return false;
  }
  return std::isfinite(value);
}

Problem not_understood(const char* what, const std::string& text, const char* examples) {
  return {{},
          std::string(what) + " \"" + text + "\" is not understood; write for example " + examples};
}

}  // namespace

Result<int64_t> parse_count(const std::string& text) {
  const Problem problem = not_understood("the count", text, "1000000, 1e6, 250k, 10M or 2G");
  double value = 0;
  std::string rest;
  if (!split_number(text, value, rest)) return problem;
  if (rest == "k")
    value *= 1e3;
  else if (rest == "M")
    value *= 1e6;
  else if (rest == "G")
    value *= 1e9;
  else if (!rest.empty())
    return problem;
  if (!(value >= 1 && value <= 1e15)) return problem;
  return static_cast<int64_t>(std::ceil(value));
}

Result<double> parse_share(const std::string& text) {
  const Problem problem = not_understood("the error", text, "1% or 0.01");
  double value = 0;
  std::string rest;
  if (!split_number(text, value, rest)) return problem;
  if (rest == "%")
    value /= 100;
  else if (!rest.empty())
    return problem;
  if (!(value > 0 && value < 1)) return problem;
  return value;
}

Result<double> parse_seconds(const std::string& text) {
  const Problem problem = not_understood("the time", text, "90, 60s, 5m, 1h or 1ms");
  double value = 0;
  std::string rest;
  if (!split_number(text, value, rest)) return problem;
  if (rest == "ms")
    value *= 1e-3;
  else if (rest == "m")
    value *= 60;
  else if (rest == "h")
    value *= 3600;
  else if (!rest.empty() && rest != "s")
    return problem;
  if (!(value > 0 && value < 1e8)) return problem;
  return value;
}

CLI::Validator seed_number() {
  const auto check = [](std::string& text) -> std::string {
    uint64_t value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size())
      return Problem{{}, "\"" + text + "\" is no whole number from 0 to 18446744073709551615"}
          .text();
    text = std::to_string(value);
    return "";
  };
  return CLI::Validator(check, "");
}

int default_threads() {
  return std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

namespace {

std::atomic<bool> interrupted_flag{false};

void on_interrupt(int) {
  if (interrupted_flag.exchange(true)) std::_Exit(ExitCode::interrupted);
}

}  // namespace

namespace {

std::atomic<bool> preview_wanted{false};
static_assert(std::atomic<bool>::is_always_lock_free);

void on_preview(int) {
  preview_wanted = true;
}

}  // namespace

std::atomic<bool>& preview_flag() {
  return preview_wanted;
}

void install_preview_handler() {
  std::signal(SIGUSR1, on_preview);
}

const std::atomic<bool>& interrupt_flag() {
  return interrupted_flag;
}

void install_interrupt_handler() {
  std::signal(SIGINT, on_interrupt);
  std::signal(SIGTERM, on_interrupt);
}

std::string short_number(double v) {
  const char* unit = "";
  if (v >= 1e9) {
    v /= 1e9;
    unit = " G";
  } else if (v >= 1e6) {
    v /= 1e6;
    unit = " M";
  } else if (v >= 1e3) {
    v /= 1e3;
    unit = " k";
  }
  return fmt::format("{:.3g}{}", v, unit);
}

ProgressLine::ProgressLine(std::string title)
    : title_(printable(title)), terminal_(isatty(STDERR_FILENO) != 0) {}

ProgressLine::~ProgressLine() {
  if (terminal_) std::fputs("\n", stderr);
}

void ProgressLine::put(const std::string& text, bool last) {
  if (terminal_) {
    std::fprintf(stderr, "\r%s: %s\033[K", title_.c_str(), text.c_str());
    std::fflush(stderr);
    return;
  }
  constexpr double log_every_s = 10;
  const double now =
      std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
  if (!last && now - logged_at_ < log_every_s) return;
  logged_at_ = now;
  spdlog::info("{}: {}", title_, text);
}

void ProgressLine::show(const Progress& p) {
  std::string text =
      fmt::format("{}particles, {}/s", short_number(static_cast<double>(p.particles)) + " ",
                  short_number(p.particles_per_second));
  if (std::isfinite(p.relative_error))
    text += fmt::format(", error {:.2g} %", 100 * p.relative_error);
  text += fmt::format(", {:.0f} s", p.seconds);
  if (std::isfinite(p.seconds_left)) text += fmt::format(", {:.0f} s left", p.seconds_left);
  put(text, p.seconds_left == 0);
}

void ProgressLine::show_share(double share) {
  put(fmt::format("{:.0f} %", 100 * share), share >= 1);
}

Result<Json> write_report_aloud(const std::filesystem::path& folder, const LocalRun& run,
                                const RunRecord& record) {
  constexpr auto moment = std::chrono::seconds(2);
  const auto began = std::chrono::steady_clock::now();
  std::optional<ProgressLine> line;
  return write_report(folder, run, record, [&](double share) {
    if (!line && std::chrono::steady_clock::now() - began > moment) line.emplace("direct light");
    if (line) line->show_share(share);
  });
}

}  // namespace luxodus::cli
