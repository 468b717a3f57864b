#include "actors/cli/command.hpp"

#include <spdlog/spdlog.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <atomic>
#include <charconv>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <ctime>
#include <thread>

#include "runtime/core/printable.hpp"
#include "scenes/pack/scene_pack.hpp"
#include "scenes/scene_file/scene_file.hpp"
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
std::atomic<int64_t> interrupted_at{0};
static_assert(std::atomic<int64_t>::is_always_lock_free);

/// The second time ends at once, if it is meant: one Ctrl-C may come twice, to the process and to
/// its group.
void on_interrupt(int) {
  constexpr int64_t one_press_ns = 300'000'000;
  timespec now{};
  ::clock_gettime(CLOCK_MONOTONIC, &now);
  const int64_t now_ns = int64_t{now.tv_sec} * 1'000'000'000 + now.tv_nsec;
  if (!interrupted_flag.exchange(true)) {
    interrupted_at = now_ns;
  } else if (now_ns - interrupted_at > one_press_ns) {
    std::_Exit(ExitCode::interrupted);
  }
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

std::string time_text(double seconds) {
  if (seconds < 100) return fmt::format("{:.0f} s", seconds);
  if (seconds < 100 * 60) return fmt::format("{:.0f} min", seconds / 60);
  return fmt::format("{:.1f} h", seconds / 3600);
}

namespace {

double now_s() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// As much of a line as the terminal shows in one row: what wraps cannot be rewritten.
std::string in_one_row(std::string text) {
  winsize size{};
  if (::ioctl(STDERR_FILENO, TIOCGWINSZ, &size) != 0 || size.ws_col < 2) return text;
  const size_t columns = size.ws_col - size_t{1};
  if (text.size() <= columns) return text;
  size_t end = columns;
  // Not within a character of several bytes.
  while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0) == 0x80) --end;
  return text.substr(0, end);
}

}  // namespace

ProgressLine::ProgressLine(const std::string& title)
    : title_(printable(title)),
      terminal_(isatty(STDERR_FILENO) != 0),
      began_s_(now_s()),
      logged_s_(began_s_) {}

ProgressLine::~ProgressLine() {
  if (terminal_ && shown_) std::fputs("\n", stderr);
}

bool ProgressLine::is_worth_a_line(bool last, std::optional<double> share) {
  // Where nobody knows how much there is to do, a log of a day still has less than 300 lines.
  constexpr double soonest_s = 30, unknown_s = 300;
  const double waited = now_s() - logged_s_;
  const int tenths = share ? static_cast<int>(10 * *share) : 0;
  const bool due = last ? shown_ || waited >= soonest_s
                        : waited >= (share ? soonest_s : unknown_s) && (!share || tenths > tenths_);
  if (!due) return false;
  tenths_ = tenths;
  logged_s_ = now_s();
  return true;
}

void ProgressLine::put(const std::string& text, bool last, std::optional<double> share) {
  if (terminal_) {
    std::fprintf(stderr, "\r%s\033[K", in_one_row(title_ + ": " + text).c_str());
    std::fflush(stderr);
    shown_ = true;
    return;
  }
  if (!is_worth_a_line(last, share)) return;
  shown_ = !last;  // one line at the end, however often it is said
  spdlog::info("{}: {}", title_, text);
}

void ProgressLine::show(const Progress& p) {
  std::string text =
      fmt::format("{}particles, {}/s", short_number(static_cast<double>(p.particles)) + " ",
                  short_number(p.particles_per_second));
  if (std::isfinite(p.relative_error))
    text += fmt::format(", error {:.2g} %", 100 * p.relative_error);
  text += ", " + time_text(p.seconds);
  std::optional<double> share;
  if (std::isfinite(p.seconds_left)) {
    text += ", about " + time_text(p.seconds_left) + " left";
    share = p.seconds / std::max(p.seconds + p.seconds_left, 1e-9);
  }
  put(text, p.seconds_left == 0, share);
}

void ProgressLine::show_share(double share) {
  std::string text = fmt::format("{:.0f} %", 100 * share);
  const double passed = now_s() - began_s_;
  if (share > 0.01 && share < 1 && passed > 1)
    text += ", about " + time_text(passed * (1 - share) / share) + " left";
  put(text, share >= 1, share);
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
