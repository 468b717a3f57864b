#include "runtime/core/isolated_job.hpp"

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <numeric>
#include <stdexcept>
#include <thread>

#include "runtime/core/reading_share.hpp"

using namespace luxodus;

namespace {

/// What the other process should do with its question.
enum class ChildTask {
  answer,
  crash,
  take_memory,
  loop,
  throw_up,
  write_much,
  lie,
  tell,
  print,
  count
};

volatile uint64_t spun = 0;

void work(PlainReader& question, PlainWriter& answer) {
  auto task = ChildTask::answer;
  std::string text;
  std::vector<uint32_t> numbers;
  if (!question.get(task) || !question.get(text) || !question.get(numbers))
    throw std::runtime_error("no question");
  std::vector<std::string> taken;
  switch (task) {
    case ChildTask::crash:
      std::raise(SIGSEGV);
      break;
    case ChildTask::take_memory:
      for (;;) taken.emplace_back(size_t{1} << 20, 'x');
    case ChildTask::loop:
      for (;;) spun = spun + 1;
    case ChildTask::throw_up:
      throw std::runtime_error("no");
    case ChildTask::write_much:
      for (;;) answer.put(std::string(size_t{1} << 20, 'x'));
    case ChildTask::lie:
      answer.put(uint64_t{1} << 60);  // numbers that do not follow
      return;
    case ChildTask::print:
      std::puts("a library prints this");
      std::fflush(stdout);
      break;
    case ChildTask::tell:
      tell_share(0.25);
      tell_share(0.5);
      break;
    default:
      break;
  }
  answer.put(text + "!");
  answer.put(std::accumulate(numbers.begin(), numbers.end(), uint64_t{0}));
}

const IsolatedJob job("test", work);
constexpr IsolatedLimits little{uint64_t{64} << 20, 1};

Result<PlainReader> run(ChildTask task, const std::vector<uint32_t>& numbers = {},
                        const std::function<void(double)>& told = {}) {
  return job.run(
      [&](PlainWriter& question) {
        question.put(task);
        question.put(std::string("text"));
        question.put(numbers);
      },
      little, told);
}

std::string failure(ChildTask task) {
  const auto done = run(task);
  REQUIRE_FALSE(done.ok());
  return done.problem().what;
}

}  // namespace

TEST_CASE("a job in a process of its own receives its question and returns its answer",
          "[runtime][isolated]") {
  std::vector<uint32_t> numbers(100'000);
  std::iota(numbers.begin(), numbers.end(), 0u);
  auto answer = run(ChildTask::answer, numbers);
  INFO((answer.ok() ? std::string() : answer.problem().what));
  REQUIRE(answer.ok());
  std::string text;
  uint64_t sum = 0;
  REQUIRE((answer->get(text) && answer->get(sum)));
  CHECK(text == "text!");
  CHECK(sum == uint64_t{99'999} * 50'000);
  CHECK(answer->left() == 0);
  CHECK_FALSE(answer->get(sum));
}

TEST_CASE("what a job prints is not part of its answer", "[runtime][isolated]") {
  auto answer = run(ChildTask::print);
  INFO((answer.ok() ? std::string() : answer.problem().what));
  REQUIRE(answer.ok());
  std::string text;
  CHECK(answer->get(text));
  CHECK(text == "text!");
}

TEST_CASE("jobs in copies of this process behave like jobs in new processes",
          "[runtime][isolated]") {
  const ForkedJobs here;
  auto answer = run(ChildTask::answer, {1, 2, 3});
  REQUIRE(answer.ok());
  std::string text;
  uint64_t sum = 0;
  CHECK((answer->get(text) && answer->get(sum)));
  CHECK((text == "text!" && sum == 6));
  CHECK(failure(ChildTask::crash).find("crash (Segmentation fault)") != std::string::npos);
  CHECK(failure(ChildTask::throw_up).find("without a reason") != std::string::npos);
  const OtherProgram other{"/bin/absent", "", ""};
  CHECK(ask_program(
            other, "test",
            [](PlainWriter& out) {
              out.put(ChildTask::answer);
              out.put(std::string("text"));
              out.put(std::vector<uint32_t>{});
            },
            little)
            .ok());
  const auto strange = ask_program(
      other, "no such job", [](PlainWriter&) {}, little);
  REQUIRE_FALSE(strange.ok());
  CHECK(strange.problem().what.find("of another build") != std::string::npos);
}

TEST_CASE("a crash, an endless loop and exhausted memory of a job are distinct problems",
          "[runtime][isolated]") {
  CHECK(failure(ChildTask::crash).find("crash (Segmentation fault)") != std::string::npos);
  CHECK(failure(ChildTask::loop).find("takes longer than") != std::string::npos);
  CHECK(failure(ChildTask::throw_up).find("without a reason") != std::string::npos);
  CHECK(failure(ChildTask::write_much).find("more than 64 MiB") != std::string::npos);
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
  CHECK(failure(ChildTask::take_memory).find("more than 64 MiB of memory") != std::string::npos);
#endif
}

TEST_CASE("an answer that claims more than it holds allocates nothing", "[runtime][isolated]") {
  auto answer = run(ChildTask::lie);
  REQUIRE(answer.ok());
  std::vector<double> numbers;
  CHECK_FALSE(answer->get(numbers));
  CHECK(numbers.empty());
}

TEST_CASE("threads run jobs concurrently, and none leaks a descriptor", "[runtime][isolated]") {
  std::vector<int> good(4, 0);
  {
    std::vector<std::jthread> threads;
    for (int& mine : good)
      threads.emplace_back([&mine] {
        for (int i = 0; i < 5; ++i) mine += run(ChildTask::answer).ok() ? 1 : 0;
      });
  }
  CHECK(good == std::vector<int>(4, 5));
  const int first = ::dup(0);
  for (int i = 0; i < 3; ++i) CHECK_FALSE(run(ChildTask::crash).ok());
  const int second = ::dup(0);
  CHECK(second == first + 1);
  ::close(first);
  ::close(second);
}

TEST_CASE("the caller of a job receives its progress up to the end", "[runtime][isolated]") {
  std::vector<double> heard;
  auto answer = run(ChildTask::tell, {1, 2}, [&](double share) { heard.push_back(share); });
  REQUIRE(answer.ok());
  REQUIRE_FALSE(heard.empty());
  CHECK(std::is_sorted(heard.begin(), heard.end()));
  CHECK(heard.back() == 0.5);
  std::string text;
  uint64_t sum = 0;
  REQUIRE((answer->get(text) && answer->get(sum)));
  CHECK((text == "text!" && sum == 3));
}

TEST_CASE("the share of reading is over all bytes, each counted once", "[runtime]") {
  ReadingShare share;
  CHECK_FALSE(share.share());
  {
    ReadingPart first(&share, 300);
    CHECK(share.share() == std::optional(0.0));
    first.at(150);
    first.at(120);  // progress never goes back
    CHECK(share.share() == std::optional(0.5));
    ReadingPart second(&share, 300);
    CHECK(share.share() == std::optional(0.25));
    second.at_share(2);  // beyond the end
    CHECK(share.share() == std::optional(0.75));
  }
  CHECK(share.share() == std::optional(1.0));
  ReadingPart(nullptr, 5).at(5);
}

TEST_CASE("announced files count as expected before the first of them is read", "[runtime]") {
  ReadingShare share;
  share.foresee(300);
  share.foresee(100);
  CHECK(share.share() == std::optional(0.0));
  { const ReadingPart first(&share, 300); }
  CHECK(share.share() == std::optional(0.75));
  {
    ReadingPart second(&share, 100);
    CHECK(share.share() == std::optional(0.75));
    second.at(50);
    CHECK(share.share() == std::optional(0.875));
  }
  CHECK(share.share() == std::optional(1.0));
  const ReadingPart unforeseen(&share, 400);
  CHECK(share.share() == std::optional(0.5));
}

TEST_CASE("the size of a file of unknown length counts once its own reading begins", "[runtime]") {
  ReadingShare share;
  CHECK(share.all_known());
  share.foresee_unknown();
  share.foresee_unknown();
  share.know();
  CHECK_FALSE(share.all_known());
  share.know();
  share.know();  // for a file that was not announced
  CHECK(share.all_known());
}

TEST_CASE("more memory is allowed only in a job", "[runtime][isolated]") {
  rlimit before{}, after{};
  REQUIRE(::getrlimit(RLIMIT_CPU, &before) == 0);
  allow_more({1, 1});
  REQUIRE(::getrlimit(RLIMIT_CPU, &after) == 0);
  CHECK(after.rlim_cur == before.rlim_cur);
}
