#include "tests/bench/peers/processes.hpp"

#include <poll.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include <cstdio>
#include <functional>
#include <thread>

#include "tests/bench/measure.hpp"

namespace luxodus::bench {

namespace {

constexpr Nanoseconds patience = seconds(20);  // until work begins, beside other programs

/// A process that runs a function, whose answers come through a pipe. It is killed at the end.
class Process {
 public:
  explicit Process(const std::function<void(int answers)>& body) {
    int ends[2];
    if (::pipe(ends) != 0) return;
    pid_ = ::fork();
    if (pid_ == 0) {
      ::prctl(PR_SET_PDEATHSIG, SIGKILL);
      ::close(ends[0]);
      body(ends[1]);
      ::_exit(0);
    }
    ::close(ends[1]);
    answers_ = ends[0];
  }
  ~Process() {
    kill();
    ::close(answers_);
  }
  Process(const Process&) = delete;
  Process& operator=(const Process&) = delete;

  pid_t pid() const { return pid_; }
  void kill() {
    if (pid_ <= 0) return;
    ::kill(pid_, SIGKILL);
    ::waitpid(pid_, nullptr, 0);
    pid_ = 0;
  }
  template <class Answer>
  std::optional<Answer> answer(Nanoseconds within) {
    pollfd ready{answers_, POLLIN, 0};
    Answer answer;
    if (::poll(&ready, 1, static_cast<int>(within / milliseconds(1))) != 1) return std::nullopt;
    if (::read(answers_, &answer, sizeof answer) != sizeof answer) return std::nullopt;
    return answer;
  }

 private:
  pid_t pid_ = 0;
  int answers_ = -1;
};

template <class Answer>
void tell(int pipe, const Answer& answer) {
  (void)!::write(pipe, &answer, sizeof answer);
}

double processor_seconds(const std::vector<pid_t>& others) {
  double sum = process_seconds();
  for (const pid_t other : others)
    if (clockid_t clock{}; ::clock_getcpuclockid(other, &clock) == 0) sum += clock_seconds(clock);
  return sum;
}

/// Does work that never ends until it was measured; for processes of their own.
void work_until_measured(int answers, Nanoseconds span, uint64_t warm,
                         const std::vector<pid_t>& others,
                         const std::function<void(Count&)>& work) {
  static Count count;
  std::thread measuring([&] {
    if (const auto taken = sample(count, warm, span, others)) tell(answers, *taken);
    ::_exit(0);
  });
  work(count);
  measuring.join();
}

std::optional<Sample> printed_by(const std::string& command) {
  FILE* out = ::popen(command.c_str(), "r");
  if (out == nullptr) return std::nullopt;
  Sample taken;
  const int read = std::fscanf(out, "%lf %lf %lf", &taken.count, &taken.wall_s, &taken.processor_s);
  ::pclose(out);
  return read == 3 ? std::optional(taken) : std::nullopt;
}

}  // namespace

void let_pass(Nanoseconds span) {
  std::this_thread::sleep_for(std::chrono::nanoseconds(span));
}

std::optional<Sample> sample(const Count& work, uint64_t warm, Nanoseconds span,
                             const std::vector<pid_t>& others) {
  const double began = wall_seconds();
  while (work.done() < warm) {
    if (wall_seconds() - began > seconds_in(patience)) return std::nullopt;
    let_pass(milliseconds(1));
  }
  let_pass(span / 5);
  const uint64_t done = work.done();
  const double processor = processor_seconds(others), wall = wall_seconds();
  let_pass(span);
  return Sample{static_cast<double>(work.done() - done), wall_seconds() - wall,
                processor_seconds(others) - processor};
}

std::optional<Sample> transfer(const Peer& peer, const Transfer& work, Nanoseconds span) {
  if (peer.command != nullptr) return printed_by(peer.command(work, span));
  Process holder([&](int) { peer.serve(work); });
  Process asker([&](int answers) {
    work_until_measured(answers, span, 2 * work.objects(), {holder.pid()},
                        [&](Count& objects) { peer.ask(work, objects); });
  });
  return asker.answer<Sample>(patience + 2 * span);
}

std::optional<Sample> play(void (*plays)(Count&), Nanoseconds span) {
  Process player([&](int answers) { work_until_measured(answers, span, 1000, {}, plays); });
  return player.answer<Sample>(patience + 2 * span);
}

std::optional<double> bytes_of_each(void (*holds)(size_t, const std::function<void()>&),
                                    size_t count) {
  Process holder([&](int answers) {
    const int64_t before = process_bytes("VmRSS");
    holds(count, [&] {
      tell(answers,
           static_cast<double>(process_bytes("VmRSS") - before) / static_cast<double>(count));
      ::_exit(0);
    });
  });
  return holder.answer<double>(patience);
}

std::optional<double> known_after(const Peer& peer, const Transfer& link, Nanoseconds idle) {
  Process holder([&](int) { peer.serve(link); });
  Process watcher([&](int answers) {
    peer.watch(link, {[&] { tell(answers, wall_seconds()); },
                      [&] {
                        tell(answers, wall_seconds());
                        ::_exit(0);
                      }});
  });
  if (!watcher.answer<double>(patience)) return std::nullopt;
  let_pass(idle);
  const double killed = wall_seconds();
  holder.kill();
  const auto known = watcher.answer<double>(patience);
  return known ? std::optional(*known - killed) : std::nullopt;
}

}  // namespace luxodus::bench
