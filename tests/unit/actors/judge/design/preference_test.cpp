// Tests the choice among layouts of equal objective: symmetric ones in rows and of few types, and
// none that violates a demand.
#include "actors/judge/design/preference.hpp"

#include <catch2/catch.hpp>
#include <set>

#include "actors/judge/design/solve_layout.hpp"
#include "tests/kit/temporary_folder.hpp"
#include "tests/unit/actors/judge/design/design_scenes.hpp"
#include "tests/unit/actors/judge/design/problems.hpp"

namespace luxodus {
namespace {

using test::ask;

/// Seven places in a line, each with two types of equal weight. The left half and the right half
/// need one luminaire each; all options of a half light it equally.
LayoutProblem two_halves() {
  LayoutProblem out;
  for (uint32_t i = 0; i < 14; ++i) {
    LayoutOption option;
    option.place = i / 2;
    option.kind = i % 2;
    option.position = {static_cast<double>(i / 2), 0};
    out.options.push_back(option);
  }
  std::vector<Term> left, right;
  for (uint32_t i = 0; i < 6; ++i) left.push_back({i, 1});
  for (uint32_t i = 8; i < 14; ++i) right.push_back({i, 1});
  ask(out, left, 1, "left");
  ask(out, right, 1, "right");
  return out;
}

Layout of(std::initializer_list<uint32_t> chosen, size_t options) {
  Layout out(options, 0);
  for (const uint32_t i : chosen) out[i] = 1;
  return out;
}

double liking(const LayoutProblem& problem, const Layout& layout) {
  const LayoutIndex index(problem);
  LayoutSums sums(index);
  sums.set(layout);
  return preference(problem, sums);
}

/// Share of new luminaires with a mirror image about the middle of a room.
double mirrored_share(const DesignResult& result, int axis, double middle) {
  size_t paired = 0;
  for (const PlacedLuminaire& one : result.luminaires) {
    glm::dvec3 image = one.candidate.position;
    image[axis] = 2 * middle - image[axis];
    paired += std::any_of(result.luminaires.begin(), result.luminaires.end(),
                          [&](const PlacedLuminaire& other) {
                            return glm::length(other.candidate.position - image) < 0.02;
                          });
  }
  return static_cast<double>(paired) / static_cast<double>(result.luminaires.size());
}

}  // namespace

TEST_CASE("among layouts of equal objective symmetric ones of one type are preferred",
          "[design][preference]") {
  const LayoutProblem problem = two_halves();
  const Layout symmetric = of({2, 10}, 14), aslant = of({0, 10}, 14), mixed = of({2, 11}, 14);
  CHECK(symmetry_of(problem, symmetric) == Approx(1));
  CHECK(symmetry_of(problem, aslant) == Approx(0.5));  // symmetric crosswise
  CHECK(liking(problem, symmetric) > liking(problem, aslant));
  CHECK(liking(problem, symmetric) > liking(problem, mixed));
  const LayoutIndex index(problem);
  for (const Layout& begun : {aslant, mixed, of({1, 12}, 14)}) {
    const Layout found = tidied(index, begun);
    CHECK(symmetry_of(problem, found) == Approx(1));
    std::set<uint32_t> kinds;
    for (uint32_t i = 0; i < found.size(); ++i)
      if (found[i] != 0) kinds.insert(problem.options[i].kind);
    CHECK(kinds.size() == 1);
    CHECK(objective_of(problem, found) == Approx(2));
  }
}

TEST_CASE("tidying a layout violates no demand and adds no cost", "[design][preference]") {
  LayoutProblem problem = two_halves();
  // The left half must be lit from its end, the right half from its beginning.
  ask(problem, {{0, 1}, {1, 1}}, 1, "end");
  ask(problem, {{8, 1}, {9, 1}}, 1, "beginning");
  const Layout found = tidied(LayoutIndex(problem), of({0, 8}, 14));
  CHECK(found == of({0, 8}, 14));
  // The other type costs more: the layout keeps two types at the least cost.
  for (LayoutOption& option : problem.options) option.weight = option.kind == 0 ? 1 : 2;
  problem.options[8].barred = true;
  SolveSettings settings;
  settings.greedy_rounds = 20;
  const LayoutAnswer answer = solve_layout(problem, settings, test::nobody, test::silent);
  CHECK(answer.layout == of({0, 9}, 14));
}

TEST_CASE("existing luminaires are not replaced by mirror images", "[design][preference]") {
  LayoutProblem problem = two_halves();
  problem.options[0].fixed = true;
  problem.options[0].kind = no_kind;
  const Layout found = tidied(LayoutIndex(problem), of({0, 10}, 14));
  CHECK(found[0] == 1);
}

TEST_CASE("the layout of a symmetric room is symmetric", "[design][preference]") {
  const test::TemporaryFolder folder;
  for (const double length : {9.0, 12.0}) {
    INFO("length " << length);
    const DesignResult result = test::designed(folder.write(
        "scene.toml",
        test::box_room(length, 7, 3) + test::judged_2013 +
            fmt::format("[[open_area]]\nname = \"floor\"\noutline = [[0, 0], [{0}, 0], [{0}, 7], "
                        "[0, 7]]\n[design]\nplace_signs = false\nfailure = \"none\"\n"
                        "spacing_m = 1.2\n",
                        length)));
    REQUIRE(result.answer.end == LayoutEnd::optimal);
    REQUIRE(result.luminaires.size() >= 2);
    CHECK(std::max(mirrored_share(result, 0, length / 2), mirrored_share(result, 1, 3.5)) == 1);
  }
}

}  // namespace luxodus
