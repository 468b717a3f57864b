// DXF plans: lines, arcs and block references as drawn. The seed is LUXODUS_SEED, or 1;
// LUXODUS_MUTATIONS sets how many drawings are mutated.
#include "scenes/formats/dxf/dxf_plan.hpp"

#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <cstdlib>
#include <span>

#include "tests/fuzz/mutate.hpp"
#include "tests/kit/small_dxf.hpp"
#include "tests/kit/temporary_folder.hpp"

using namespace luxodus;
using namespace luxodus::test;

namespace {

DxfPlan plan_of(const std::string& text) {
  auto plan = dxf_plan_of(text, "test.dxf");
  if (!plan) FAIL(plan.problem().text());
  return std::move(plan).value();
}

double length_of(const DxfPlan& plan, const std::string& layer) {
  double sum = 0;
  for (const DxfSegment& s : plan.segments)
    if (s.layer == layer) sum += glm::length(s.to - s.from);
  return sum;
}

bool is_finite_plan(const DxfPlan& plan) {
  for (const DxfSegment& s : plan.segments)
    if (!std::isfinite(s.from.x) || !std::isfinite(s.to.y)) return false;
  return true;
}

/// Reads mutated drawings: many in one process, and drawings that crash it in the reader's own.
/// dxflib writes beyond its memory for some.
class HarmedDrawings {
 public:
  /// Each is read, or rejected with a sentence.
  void must_be_read_or_refused(std::span<const std::string> drawings) {
    if (drawings.empty()) return;
    if (in_one_process(drawings)) {
      read_ += *read_there_;
    } else if (drawings.size() > 1) {
      const size_t half = drawings.size() / 2;
      must_be_read_or_refused(drawings.first(half));
      must_be_read_or_refused(drawings.subspan(half));
    } else {
      ++apart_;
      const auto plan = read_dxf_plan(folder_.write("harmed.dxf", drawings.front()));
      if (plan)
        REQUIRE(is_finite_plan(plan.value()));
      else
        REQUIRE_FALSE(plan.problem().what.empty());
      read_ += plan.ok() ? 1 : 0;
    }
  }
  uint64_t read() const { return read_; }
  uint64_t apart() const { return apart_; }

 private:
  /// False if one of them ends the process, takes longer than a minute, or gives numbers that are
  /// not finite.
  bool in_one_process(std::span<const std::string> drawings) {
    const pid_t child = ::fork();
    REQUIRE(child >= 0);
    if (child == 0) {
      // Sanitizer reports about dxflib are not of interest.
      if (std::freopen("/dev/null", "w", stderr) == nullptr) ::_exit(4);
      ::alarm(60);
      uint64_t read = 0;
      for (const std::string& text : drawings) {
        const auto plan = dxf_plan_of(text, "harmed.dxf");
        if (plan && !is_finite_plan(plan.value())) ::_exit(3);
        if (!plan && plan.problem().what.empty()) ::_exit(3);
        read += plan.ok() ? 1 : 0;
      }
      *read_there_ = read;
      ::_exit(0);
    }
    int status = 0;
    REQUIRE(::waitpid(child, &status, 0) == child);
    return WIFEXITED(status) && WEXITSTATUS(status) == 0;
  }

  /// Count of the process that has ended, in shared memory.
  uint64_t* const read_there_ = static_cast<uint64_t*>(
      ::mmap(nullptr, sizeof(uint64_t), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0));
  const TemporaryFolder folder_;
  uint64_t read_ = 0, apart_ = 0;
};

}  // namespace

TEST_CASE("a drawing's unit, sides of polylines and blocks are read", "[dxf]") {
  const DxfPlan plan = plan_of(dxf_drawing());
  CHECK(plan.metres_per_unit == 1e-3);
  CHECK(plan.segments.size() == 4);  // and none from within the block
  CHECK(length_of(plan, "WALLS") == Approx(18'000));
  REQUIRE(plan.inserts.size() == 2);
  CHECK(plan.inserts[0].block == "LAMP");
  CHECK(plan.inserts[0].rotation_deg == 30);
  CHECK(plan.inserts[1].at.x == 4900);
  CHECK(plan_of(dxf_drawing("", "0")).metres_per_unit == 0);
}

TEST_CASE("arcs and bulges become chords of nearly their length", "[dxf]") {
  const double half_circle = 3.141592653589793 * 500;
  const DxfPlan arc = plan_of(dxf_drawing(dxf_groups({{0, "ARC"},
                                                      {8, "ARCS"},
                                                      {10, "0"},
                                                      {20, "0"},
                                                      {30, "0"},
                                                      {40, "500"},
                                                      {50, "270"},
                                                      {51, "90"}})));
  CHECK(length_of(arc, "ARCS") == Approx(half_circle).epsilon(2e-3));
  const DxfPlan bulge = plan_of(dxf_drawing(dxf_groups({{0, "LWPOLYLINE"},
                                                        {8, "ARCS"},
                                                        {90, "2"},
                                                        {70, "0"},
                                                        {10, "0"},
                                                        {20, "0"},
                                                        {42, "1"},
                                                        {10, "1000"},
                                                        {20, "0"}})));
  CHECK(length_of(bulge, "ARCS") == Approx(half_circle).epsilon(2e-3));
  // A bulge of 1 is a half circle to the right of the way.
  double lowest = 0;
  for (const DxfSegment& s : bulge.segments)
    if (s.layer == "ARCS") lowest = std::min(lowest, s.to.y);
  CHECK(lowest == Approx(-500));
}

TEST_CASE("a file that is not a plan is rejected with a message", "[dxf]") {
  const auto refusal = [](const std::string& text) {
    const auto plan = dxf_plan_of(text, "x.dxf");
    return plan ? std::string("read") : plan.problem().text();
  };
  CHECK(refusal("AC1027 and more").find("save it as DXF in text") != std::string::npos);
  CHECK(refusal("hello\nworld\n").find("x.dxf: ") == 0);
  CHECK(refusal(dxf_groups({{0, "SECTION"}, {2, "ENTITIES"}, {0, "ENDSEC"}, {0, "EOF"}}))
            .find("no lines") != std::string::npos);
  const TemporaryFolder folder;
  const auto read = read_dxf_plan(folder.write("a.dxf", dxf_drawing()));
  REQUIRE(read.ok());
  CHECK(read->segments.size() == 4);
  CHECK(read_dxf_plan(folder / "absent.dxf").problem().text().find("absent.dxf") !=
        std::string::npos);
}

TEST_CASE("mutated drawings are read or rejected with one sentence", "[dxf]") {
  const char* seed_text = std::getenv("LUXODUS_SEED");
  const char* count_text = std::getenv("LUXODUS_MUTATIONS");
  const uint64_t seed = seed_text != nullptr ? std::strtoull(seed_text, nullptr, 0) : 1;
  const uint64_t tries = count_text != nullptr ? std::strtoull(count_text, nullptr, 0) : 2000;
  INFO("seed " << seed);
  Random random(seed, RandomStream::test);
  random.start(0);
  const auto bytes_of = [](const std::string& text) {
    const auto* from = reinterpret_cast<const std::byte*>(text.data());
    return Bytes(from, from + text.size());
  };
  const Bytes one = bytes_of(dxf_drawing()),
              other = bytes_of(dxf_drawing(dxf_line("A", "1e308", "-1", "nan", "2"), "2"));
  HarmedDrawings drawings;
  std::vector<std::string> some;
  for (uint64_t i = 0; i < tries; ++i) {
    const Bytes harmed = mutated(one, other, random);
    some.emplace_back(reinterpret_cast<const char*>(harmed.data()), harmed.size());
    if (some.size() < 64 && i + 1 < tries) continue;
    drawings.must_be_read_or_refused(some);
    some.clear();
  }
  CHECK(drawings.read() > tries / 10);
  CHECK(drawings.read() < tries);
  CHECK(drawings.apart() < tries / 4);
}
