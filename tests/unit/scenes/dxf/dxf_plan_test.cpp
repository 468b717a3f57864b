// DXF plans: lines, arcs and blocks as drawn. The seed is LUXODUS_SEED, or 1; LUXODUS_MUTATIONS
// says how many drawings are harmed.
#include "scenes/dxf/dxf_plan.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <cstdlib>

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

TEST_CASE("what is no plan is refused in words", "[dxf]") {
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

TEST_CASE("harmed drawings are read or refused with one sentence", "[dxf]") {
  const char* seed_text = std::getenv("LUXODUS_SEED");
  const char* count_text = std::getenv("LUXODUS_MUTATIONS");
  const uint64_t seed = seed_text != nullptr ? std::strtoull(seed_text, nullptr, 0) : 1;
  const int tries = count_text != nullptr ? std::atoi(count_text) : 150;
  INFO("seed " << seed);
  Random random(seed, RandomStream::test);
  random.start(0);
  const auto bytes_of = [](const std::string& text) {
    const auto* from = reinterpret_cast<const std::byte*>(text.data());
    return Bytes(from, from + text.size());
  };
  const Bytes one = bytes_of(dxf_drawing()),
              other = bytes_of(dxf_drawing(dxf_line("A", "1e308", "-1", "nan", "2"), "2"));
  const TemporaryFolder folder;
  int read = 0;
  for (int i = 0; i < tries; ++i) {
    const Bytes harmed = mutated(one, other, random);
    // In a process of its own: dxflib writes beyond its memory for some of them.
    const auto plan = read_dxf_plan(folder.write(
        "harmed.dxf", std::string(reinterpret_cast<const char*>(harmed.data()), harmed.size())));
    if (!plan) {
      REQUIRE_FALSE(plan.problem().what.empty());
      continue;
    }
    ++read;
    for (const DxfSegment& s : plan->segments)
      REQUIRE((std::isfinite(s.from.x) && std::isfinite(s.to.y)));
  }
  CHECK(read > tries / 10);
  CHECK(read < tries);
}
