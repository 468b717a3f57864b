// Shows progress on standard error. One thread at a time.
#pragma once

#include <condition_variable>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

namespace luxodus {
struct Progress;
class ReadingShare;
}  // namespace luxodus

namespace luxodus::cli {

/// On a terminal one line that is rewritten; elsewhere a line in the log for each tenth of the
/// work, at most every half minute, and a last one if the work took longer.
class ProgressLine {
 public:
  explicit ProgressLine(const std::string& title);
  ~ProgressLine();
  void show(const Progress& progress);
  /// Shows the share, `what` beside it (", 12 paths"), and an estimate of the remaining time.
  void show_share(double share, const std::string& what = "");
  /// `last`: all is done. `share`: of the work, if known.
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

/// Shows for how long some work has been going on, from two seconds on and as long as this lives:
/// for work that is done elsewhere, or does not know its share. Nothing else may be written to
/// standard error meanwhile.
class WaitingLine {
 public:
  /// `what`: "reading office.toml". `share`, which outlives this: the known progress in bytes; the
  /// line then has the share, and an estimate of the remaining time if all files are known.
  explicit WaitingLine(const std::string& what, const ReadingShare* share = nullptr);
  ~WaitingLine();
  WaitingLine(const WaitingLine&) = delete;
  WaitingLine& operator=(const WaitingLine&) = delete;

 private:
  void tell();

  ProgressLine line_;
  const ReadingShare* share_;
  std::mutex mutex_;
  std::condition_variable changed_;
  bool over_ = false;
  std::thread thread_;  // declared last: it starts when all other members exist
};

}  // namespace luxodus::cli
