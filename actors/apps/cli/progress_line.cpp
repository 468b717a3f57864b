#include "actors/apps/cli/progress_line.hpp"

#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>

#include "actors/apps/cli/quantities.hpp"
#include "actors/results/run/local_run.hpp"
#include "runtime/core/log.hpp"
#include "runtime/core/printable.hpp"
#include "runtime/core/reading_share.hpp"

namespace luxodus::cli {

namespace {

double now_s() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// The part of a line that fits into one row of the terminal: a wrapped line cannot be rewritten.
std::string in_one_row(std::string text) {
  winsize size{};
  if (::ioctl(STDERR_FILENO, TIOCGWINSZ, &size) != 0 || size.ws_col < 2) return text;
  const size_t columns = size.ws_col - size_t{1};
  if (text.size() <= columns) return text;
  size_t end = columns;
  // Does not cut a character of several bytes.
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
  // Without a known amount of work, a log of a day still has less than 300 lines.
  constexpr double soonest_s = 30, unknown_s = 300;
  const double waited = now_s() - logged_s_;
  const int tenths = share ? static_cast<int>(10 * *share) : 0;
  tenths_ = std::min(tenths_, tenths);  // the amount of work may grow
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
  shown_ = !last;  // the last line is printed once, however often it is set
  log_info("{}: {}", title_, text);
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

void ProgressLine::show_share(double share, const std::string& what) {
  std::string text = fmt::format("{:.0f} %{}", 100 * share, what);
  const double passed = now_s() - began_s_;
  if (share > 0.01 && share < 1 && passed > 1)
    text += ", about " + time_text(passed * (1 - share) / share) + " left";
  put(text, share >= 1, share);
}

WaitingLine::WaitingLine(const std::string& what, const ReadingShare* share)
    : line_(what), share_(share), thread_([this] { tell(); }) {}

WaitingLine::~WaitingLine() {
  {
    const std::lock_guard lock(mutex_);
    over_ = true;
  }
  changed_.notify_one();
  thread_.join();
}

void WaitingLine::tell() {
  constexpr std::chrono::seconds first{2}, next{1};
  const double began_s = now_s();
  std::unique_lock lock(mutex_);
  for (auto pause = first; !changed_.wait_for(lock, pause, [this] { return over_; });
       pause = next) {
    const std::string since = time_text(now_s() - began_s);
    const auto share = share_ == nullptr ? std::nullopt : share_->share();
    // All bytes are read, and other work of unknown length goes on.
    if (!share || *share >= 1)
      line_.put(since, false);
    else if (share_->all_known())
      line_.show_share(*share, ", " + since);
    else
      line_.put(fmt::format("{:.0f} % of what is known so far, {}", 100 * *share, since), false,
                share);
  }
}

}  // namespace luxodus::cli
