// random_scenes: tries any number of random scenes, or random scene files, and reports each that
// the program handles wrongly; tests/random/README.md defines that. A scene is identified by its
// number: when the process dies, it prints the scenes in progress.
#include <signal.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdio>
#include <map>
#include <mutex>
#include <thread>

#include "runtime/core/isolated_job.hpp"
#include "tests/kit/temporary_folder.hpp"
#include "tests/random/check_scene.hpp"
#include "tests/random/features.hpp"
#include "tests/random/random_text.hpp"

// Defined by sanitizers, if the program is built with them: registers a function to call before
// exit.
extern "C" __attribute__((weak)) void __sanitizer_set_death_callback(void (*callback)());

using namespace luxodus;
using namespace luxodus::test;

namespace {

constexpr int max_jobs = 256;
constexpr uint64_t idle = ~uint64_t{0};

// Readable by a signal handler.
std::array<std::atomic<uint64_t>, max_jobs> under_way;

void write_number(uint64_t n) {
  char text[24];
  char* at = text + sizeof text;
  *--at = ' ';
  do {
    *--at = static_cast<char>('0' + n % 10);
    n /= 10;
  } while (n > 0);
  [[maybe_unused]] const auto written =
      ::write(STDERR_FILENO, at, static_cast<size_t>(text + sizeof text - at));
}

void tell_under_way() {
  constexpr char words[] = "\nrandom_scenes: ended while at the numbers ";
  [[maybe_unused]] auto written = ::write(STDERR_FILENO, words, sizeof words - 1);
  for (const auto& number : under_way)
    if (number.load() != idle) write_number(number.load());
  written = ::write(STDERR_FILENO, "\n", 1);
}

void on_signal(int signal) {
  tell_under_way();
  ::signal(signal, SIG_DFL);
  ::raise(signal);
}

void watch_for_the_end() {
  for (auto& number : under_way) number = idle;
  if (__sanitizer_set_death_callback != nullptr)
    return __sanitizer_set_death_callback(tell_under_way);
  for (const int signal : {SIGSEGV, SIGABRT, SIGFPE, SIGBUS, SIGILL}) ::signal(signal, on_signal);
}

struct Options {
  uint64_t first = 0;
  uint64_t count = 10'000;
  int jobs = 1;
  bool texts = false;
  bool print = false;
  double patience_s = 300;
};

struct Summary {
  uint64_t done = 0, accepted = 0, rays = 0;
  std::vector<uint64_t> found;
  std::map<std::string, uint64_t> refusals;
  FeatureCounts features;

  void add(const Summary& s) {
    done += s.done;
    accepted += s.accepted;
    rays += s.rays;
    found.insert(found.end(), s.found.begin(), s.found.end());
    for (const auto& [why, count] : s.refusals) refusals[why] += count;
    features.resize(test::features().size());
    for (size_t i = 0; i < s.features.size(); ++i) features[i] += s.features[i];
  }
};

class Tries {
 public:
  explicit Tries(const Options& options) : options_(options), next_(options.first) {}

  Summary run() {
    std::vector<std::thread> threads;
    for (int job = 0; job < options_.jobs; ++job) threads.emplace_back([this, job] { work(job); });
    tell_progress();
    for (std::thread& t : threads) t.join();
    return total_;
  }

 private:
  uint64_t end() const { return options_.first + options_.count; }

  void work(int job) {
    const EmbreeDevice device(BuildThreads::calling);
    // The file's name may affect the scene: one folder for each.
    const auto file = folder_ / std::to_string(job) / "scene.toml";
    if (options_.texts) std::filesystem::create_directories(file.parent_path());
    Summary own;
    for (uint64_t number = next_++; number < end(); number = next_++) {
      under_way[static_cast<size_t>(job)] = number;
      try_one(number, file, device, own);
      const std::lock_guard lock(mutex_);
      if (++finished_ >= options_.count) ended_.notify_one();
    }
    under_way[static_cast<size_t>(job)] = idle;
    const std::lock_guard lock(mutex_);
    total_.add(own);
  }

  void try_one(uint64_t number, const std::filesystem::path& file, const EmbreeDevice& device,
               Summary& own) {
    Verdict verdict;
    if (options_.texts) {
      verdict = check_text(number, file, device);
    } else {
      const RandomScene scene = random_scene(number);
      count_features(scene, own.features);
      verdict = check_scene(scene, number, device);
    }
    ++own.done;
    own.accepted += verdict.accepted ? 1 : 0;
    own.rays += verdict.rays;
    if (!verdict.refusal.empty()) ++own.refusals[verdict.refusal];
    if (verdict.findings.empty()) return;
    own.found.push_back(number);
    const std::lock_guard lock(mutex_);
    for (const std::string& finding : verdict.findings)
      std::printf("\n%llu: %s\n", static_cast<unsigned long long>(number), finding.c_str());
    std::printf("  again: random_scenes %s--first %llu --count 1\n",
                options_.texts ? "--texts " : "", static_cast<unsigned long long>(number));
    std::fflush(stdout);
  }

  /// Runs until all is done. Ends the program if a scene exceeds the time limit.
  void tell_progress() {
    using Clock = std::chrono::steady_clock;
    const auto seconds_since = [](Clock::time_point t) {
      return std::chrono::duration<double>(Clock::now() - t).count();
    };
    const auto start = Clock::now();
    auto moved = start;
    uint64_t before = 0;
    std::unique_lock lock(mutex_);
    const auto all_done = [this] { return finished_ >= options_.count; };
    while (!ended_.wait_for(lock, std::chrono::seconds(2), all_done)) {
      if (finished_ != before) moved = Clock::now();
      before = finished_;
      if (seconds_since(moved) > options_.patience_s) {
        tell_under_way();
        std::fprintf(stderr, "random_scenes: none of these has ended in %.0f s\n",
                     options_.patience_s);
        std::_Exit(1);
      }
      const double rate = static_cast<double>(before) / seconds_since(start);
      const double left = static_cast<double>(options_.count - before) / std::max(rate, 1e-9);
      std::fprintf(stderr, "\r%llu of %llu, %.0f a second, %.0f s left   ",
                   static_cast<unsigned long long>(before),
                   static_cast<unsigned long long>(options_.count), rate, left);
    }
    std::fprintf(stderr, "\n");
  }

  const Options options_;
  std::atomic<uint64_t> next_;
  const TemporaryFolder folder_;
  std::mutex mutex_;  // guards the members below, and printing
  std::condition_variable ended_;
  uint64_t finished_ = 0;
  Summary total_;
};

void print_row(uint64_t count, uint64_t of, const std::string& what) {
  std::printf("%10llu  %6.2f %%  %s\n", static_cast<unsigned long long>(count),
              of == 0 ? 0.0 : 100.0 * static_cast<double>(count) / static_cast<double>(of),
              what.c_str());
}

void print_summary(const Summary& s, const Options& options) {
  std::printf("\n%10llu  %s, numbers %llu and on\n", static_cast<unsigned long long>(s.done),
              options.texts ? "scene files" : "scenes",
              static_cast<unsigned long long>(options.first));
  print_row(s.accepted, s.done, "taken and traced");
  std::printf("%10.4g  rays of particles\n", static_cast<double>(s.rays));
  if (!options.texts) {
    std::printf("\nHow many had\n");
    for (size_t i = 0; i < s.features.size(); ++i)
      print_row(static_cast<uint64_t>(s.features[i]), s.done, features()[i].name);
  }
  std::printf("\nRefused, by what was said first\n");
  std::vector<std::pair<uint64_t, std::string>> by_count;
  for (const auto& [why, count] : s.refusals) by_count.emplace_back(count, why);
  std::sort(by_count.rbegin(), by_count.rend());
  constexpr size_t max_rows = 60;
  for (size_t i = 0; i < std::min(max_rows, by_count.size()); ++i)
    print_row(by_count[i].first, s.done, by_count[i].second);
  if (by_count.size() > max_rows) std::printf("%16zu more kinds\n", by_count.size() - max_rows);
  std::printf("\n%zu findings", s.found.size());
  std::vector<uint64_t> found = s.found;
  std::sort(found.begin(), found.end());
  for (const uint64_t number : found) std::printf(" %llu", static_cast<unsigned long long>(number));
  std::printf("\n");
}

}  // namespace

int main(int argc, char** argv) {
  if (const auto served = luxodus::serve_isolated_job(argc, argv)) return *served;
  Options options;
  CLI::App app{"Tries random scenes; ends with 1 and their numbers where one shows a mistake."};
  app.add_option("--first", options.first, "number of the first scene")->capture_default_str();
  app.add_option("--count", options.count, "how many")->capture_default_str();
  app.add_option("--jobs", options.jobs, "threads")
      ->check(CLI::Range(1, max_jobs))
      ->capture_default_str();
  app.add_flag("--texts", options.texts, "scene files through the reader, instead of descriptions");
  app.add_flag("--print", options.print, "only print the scene file of the first number");
  app.add_option("--patience", options.patience_s, "seconds without progress that mean a hang")
      ->capture_default_str();
  CLI11_PARSE(app, argc, argv);
  if (options.print) {
    std::fputs(random_text(options.first).c_str(), stdout);
    return 0;
  }
  watch_for_the_end();
  const Summary summary = Tries(options).run();
  print_summary(summary, options);
  return summary.found.empty() ? 0 : 1;
}
