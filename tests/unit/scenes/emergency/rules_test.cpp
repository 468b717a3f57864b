// Tests the rules with given values: what passes, what fails, and where the worst place is.
#include "scenes/emergency/rules.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "scenes/emergency/rule_table.hpp"
#include "scenes/light/signs/sign_face.hpp"
#include "tests/unit/scenes/emergency/code_choices.hpp"

using namespace luxodus;

namespace {

/// The checks of every rule set, one after the other.
template <class Checks>
std::vector<Check> of_all_codes(const Checks& checks) {
  std::vector<Check> out;
  for (const CodeChoice& codes : {en13, en24, nfpa})
    for (Check& check : checks(codes)) out.push_back(std::move(check));
  return out;
}

const Check& of(const std::vector<Check>& checks, const std::string& id) {
  const auto at = std::find_if(checks.begin(), checks.end(),
                               [&](const Check& check) { return name_of(check.rule.id) == id; });
  REQUIRE(at != checks.end());
  return *at;
}
bool has(const std::vector<Check>& checks, const std::string& id) {
  return std::any_of(checks.begin(), checks.end(),
                     [&](const Check& c) { return name_of(c.rule.id) == id; });
}

Emitter luminaire(const std::string& name, const glm::dvec3& at, double lumens) {
  Emitter e;
  e.name = name;
  e.frame.origin = at;
  e.distribution = Distribution::isotropic;
  e.emergency_flux = lumens;
  e.emergency_ageing = 0.5;
  return e;
}

/// A level route of 10 m with two luminaires 2.8 m above it.
SceneDescription corridor() {
  SceneDescription scene;
  EscapeRoute route;
  route.name = "corridor";
  route.path = {{0, 0, 0}, {10, 0, 0}};
  route.width_m = 1.8;
  scene.routes.push_back(route);
  scene.emitters = {luminaire("a", {2, 0, 2.8}, 100), luminaire("b", {8, 0, 2.8}, 100)};
  return scene;
}

LitPoint at(double x, double a, double b) {
  return {{x, 0, 0.02}, {a, b}};
}

Sign sign_of(double white, double green) {
  Sign sign;
  sign.name = "exit";
  sign.width_m = 0.3;
  sign.height_m = 0.15;
  sign.frame.origin = {5, 1, 2.3};
  sign.colours = white_and_green({500, 100}, {white, green});
  sign.face.width = 2;
  sign.face.height = 1;
  sign.face.colour = {0, 1};
  return sign;
}

}  // namespace

TEST_CASE("a route passes at 1 lx and a diversity of 40, and fails below 1 lx or above 40",
          "[emergency][rules]") {
  const SceneDescription scene = corridor();
  const EscapeRoute& route = scene.routes.front();
  RouteLight light;
  light.centre = {at(0, 0.9, 0.1), at(5, 20, 20), at(10, 0.5, 0.6)};
  light.band = {at(0, 0.3, 0.2), at(10, 0.2, 0.29)};
  light.inner = {at(0, 1, 0.5)};
  const auto checks = of_all_codes(
      [&](const CodeChoice& codes) { return checks_of_route(scene, route, light, codes); });
  CHECK(of(checks, "E1").verdict == CheckVerdict::pass);
  CHECK(*of(checks, "E1").value == Approx(1.0));
  CHECK(of(checks, "E2").verdict == CheckVerdict::fail);
  CHECK(*of(checks, "E2").value == Approx(0.49));
  CHECK(of(checks, "E2").worst->x == 10);
  CHECK(of(checks, "E2").margin().value() == Approx(-0.02));
  CHECK(of(checks, "E4").verdict == CheckVerdict::pass);
  CHECK(*of(checks, "E4").value == Approx(40));
  CHECK(of(checks, "E5").verdict == CheckVerdict::pass);
}

TEST_CASE("a check passes only if the worse end of its interval does", "[emergency][rules]") {
  const SceneDescription scene = corridor();
  const auto checks_with = [&](const LitPoint& between) {
    RouteLight light;
    light.centre = {at(0, 0.9, 0.1), at(10, 10, 10)};
    light.centre.between = {between};
    return checks_of_route(scene, scene.routes.front(), light, en13);
  };
  const Remarks none;
  // Neither darker nor brighter than the points of the grid.
  CHECK(*of(checks_with(at(5, 5, 5)), "E1").value == Approx(1));
  CHECK(of(checks_with(at(5, 5, 5)), "E1").reasons == none);
  const Check darker = of(checks_with(at(5, 0.4, 0.4)), "E1");
  CHECK(darker.verdict == CheckVerdict::fail);
  CHECK(*darker.value == Approx(0.8));
  CHECK(darker.worst->x == 5);
  CHECK(darker.reasons == Remarks{remark(RemarkId::value_on_grid, 1.0)});
  // Less than a hundredth darker, but below the limit.
  const Check hardly = of(checks_with(at(5, 0.495, 0.5)), "E1");
  CHECK(hardly.verdict == CheckVerdict::fail);
  CHECK(*hardly.value == Approx(0.995));
  const Check brighter = of(checks_with(at(5, 25, 25)), "E4");
  CHECK(brighter.verdict == CheckVerdict::fail);
  CHECK(*brighter.value == Approx(50));
  CHECK(brighter.reasons == Remarks{remark(RemarkId::value_on_grid, 20.0)});
  // The mean is that of the grid.
  RouteLight light;
  light.centre = {at(0, 1, 1), at(10, 3, 3)};
  light.centre.between = {at(5, 50, 50)};
  CHECK(*of(checks_of_route(scene, scene.routes.front(), light, nfpa), "N2").value == Approx(4));
}

TEST_CASE("points of a route in bodies are stated, and a route without others is not assessed",
          "[emergency][rules]") {
  const SceneDescription scene = corridor();
  RouteLight light;
  light.centre = {at(0, 5, 5), at(10, 5, 5)};
  light.centre.in_bodies = 3;
  auto checks = checks_of_route(scene, scene.routes.front(), light, en13);
  CHECK(of(checks, "E1").conditions == Remarks{remark(RemarkId::points_in_bodies, 3, 5)});
  light.centre.grid.clear();
  checks = checks_of_route(scene, scene.routes.front(), light, en13);
  for (const char* id : {"E1", "E2", "E4"})
    CHECK(of(checks, id).verdict == CheckVerdict::not_assessed);
}

TEST_CASE("one luminaire that is fed has to light each tread", "[emergency][rules]") {
  const std::vector<LitPoint> treads{at(0, 0.3, 0.05), at(1, 0.05, 0.2)};
  const Check lit = of(checks_of_flight("way, flight 1", treads, en13), "E12s");
  CHECK(lit.verdict == CheckVerdict::pass);
  CHECK(*lit.value == Approx(0.2));
  const Check dark = of(checks_of_flight("way, flight 1", treads, en13, {true, false}), "E12s");
  CHECK(dark.verdict == CheckVerdict::fail);
  CHECK(*dark.value == Approx(0.05));
  CHECK(dark.worst->x == 1);
  CHECK(checks_of_flight("way, flight 1", treads, nfpa).empty());
}

TEST_CASE("the initial illuminance is that before batteries and lamps have aged",
          "[emergency][rules]") {
  const SceneDescription scene = corridor();
  RouteLight light;
  light.centre = {at(0, 0.4, 0.4), at(10, 6, 6)};
  const auto checks = checks_of_route(scene, scene.routes.front(), light, nfpa);
  CHECK(*of(checks, "N2").value == Approx((0.8 + 12) / 2));
  CHECK(*of(checks, "N1").value == Approx(0.8 + 12));  // half of the flux is left at the end
  CHECK(*of(checks, "N1m").value == Approx(1.6));
  CHECK(of(checks, "N1").verdict == CheckVerdict::pass);
  CHECK(of(checks, "N2").verdict == CheckVerdict::fail);
}

TEST_CASE("each luminaire fails in turn, and the check names the worst", "[emergency][rules]") {
  const SceneDescription scene = corridor();
  const Check failed =
      check_of_failure(scene, {SubjectKind::route, "corridor"}, {at(0, 5, 0.2), at(10, 0.1, 5)});
  CHECK(failed.verdict == CheckVerdict::information);
  CHECK(*failed.value == Approx(0.1));
  CHECK(failed.conditions == Remarks{remark(RemarkId::luminaire_failed, "b")});
}

TEST_CASE("wide routes are divided into strips of at most 2 m", "[emergency][rules]") {
  EscapeRoute route = corridor().routes.front();
  route.width_m = 5;
  const auto of = [&] {
    return points_of(route,
                     [&](double aside_m) { return line_along(route, aside_m, route_grid_m); });
  };
  const RoutePoints points = of();
  double widest = 0;
  for (const glm::dvec3& p : points.centre.places) widest = std::max(widest, std::abs(p.y));
  CHECK(widest == Approx(5.0 / 3));  // three strips, the middle one on the centre line
  double edge = 0;
  for (const glm::dvec3& p : points.inner.places) edge = std::max(edge, std::abs(p.y));
  CHECK(edge == Approx(2.0));  // all but 0.5 m on each side
  route.width_m = 1.6;
  for (const glm::dvec3& p : of().band.places) CHECK(std::abs(p.y) <= 0.4 + 1e-9);
}

TEST_CASE("a place without any light fails with infinite diversity, also without luminaires",
          "[emergency][rules]") {
  SceneDescription scene = corridor();
  RouteLight light;
  light.centre = {at(0, 0, 0), at(10, 5, 5)};
  auto checks = checks_of_route(scene, scene.routes.front(), light, {});
  CHECK(of(checks, "E1").verdict == CheckVerdict::fail);
  CHECK(std::isinf(*of(checks, "E4").value));
  CHECK(of(checks, "E4").verdict == CheckVerdict::fail);
  scene.emitters.clear();
  light.centre = {{{0, 0, 0}, {}}};
  checks = checks_of_route(scene, scene.routes.front(), light, {});
  CHECK(of(checks, "E1").verdict == CheckVerdict::fail);
  CHECK(*of(checks, "E1").value == 0);
}

TEST_CASE("an area too narrow for its borders has no core to assess", "[emergency][rules]") {
  AssessedArea area;
  area.name = "niche";
  const auto checks = checks_of_open_area(corridor(), area, {}, {});
  REQUIRE(checks.size() == 1);
  CHECK(checks.front().verdict == CheckVerdict::not_assessed);
  const auto lit = checks_of_open_area(corridor(), area, {at(0, 0.3, 0.3), at(1, 2, 2)}, {});
  CHECK(of(lit, "E6").verdict == CheckVerdict::pass);
}

TEST_CASE("a task area needs 15 lx or a tenth of its mains illuminance, whichever is more",
          "[emergency][rules]") {
  AssessedArea bench;
  bench.mains_lx = 500;
  const std::vector<LitPoint> plane{at(0, 20, 20), at(1, 100, 100)};
  const auto strict = checks_of_task_area(corridor(), bench, plane, {});
  CHECK(*of(strict, "E7").limit == 50);
  CHECK(of(strict, "E7").verdict == CheckVerdict::fail);
  CHECK(of(strict, "E7u").verdict == CheckVerdict::pass);
  bench.mains_lx = 100;
  CHECK(of(checks_of_task_area(corridor(), bench, plane, {}), "E7").verdict == CheckVerdict::pass);
}

TEST_CASE("glare is judged by the intensity of the new luminaire and by its height",
          "[emergency][rules]") {
  SceneDescription scene = corridor();
  // Flux: 4 pi I when new, half of it at the end.
  const double pi = std::numbers::pi;
  scene.emitters = {luminaire("low", {2, 0, 2.4}, 0.5 * 4 * pi * 501),
                    luminaire("high", {2, 0, 2.6}, 0.5 * 4 * pi * 501)};
  const auto checks = checks_of_glare(scene, {});
  REQUIRE(checks.size() == 2);
  CHECK(*checks[0].value == Approx(501));
  CHECK(checks[0].verdict == CheckVerdict::fail);  // 500 cd below 2.5 m
  CHECK(checks[1].verdict == CheckVerdict::pass);  // 900 cd below 3 m
  CHECK(checks[0].conditions == Remarks{remark(RemarkId::glare_zone)});
  scene.routes.front().path[1].z = 1;  // no longer a level route
  CHECK(checks_of_glare(scene, {})[0].conditions == Remarks{remark(RemarkId::all_directions)});
}

TEST_CASE("a spot causes glare within its cone, a beam of parallel light only along its direction",
          "[emergency][rules]") {
  const double pi = std::numbers::pi;
  SceneDescription scene = corridor();
  scene.emitters = {luminaire("spot", {2, 0, 2.4}, 100)};
  Emitter& spot = scene.emitters.front();
  spot.distribution = Distribution::spot;
  spot.spot_inner_deg = 20;
  spot.spot_outer_deg = 40;
  // Straight down: no light beyond 40 degrees, so none between 60 and 90.
  CHECK(*checks_of_glare(scene, {})[0].value == 0);
  // In all directions the axis counts: 200 lm when new over pi ((1 - cos 20) + (1 - cos 40)) sr.
  scene.routes.front().path[1].z = 1;
  const double sr = pi * (2 - std::cos(20 * pi / 180) - std::cos(40 * pi / 180));
  CHECK(*checks_of_glare(scene, {})[0].value == Approx(200 / sr));
  // Aimed horizontally: the axis lies in the zone.
  scene.routes.front().path[1].z = 0;
  spot.frame.axes = glm::dmat3(glm::dvec3(0, 1, 0), glm::dvec3(0, 0, 1), glm::dvec3(1, 0, 0));
  CHECK(*checks_of_glare(scene, {})[0].value == Approx(200 / sr));
  spot.distribution = Distribution::collimated;
  CHECK(checks_of_glare(scene, {})[0].verdict == CheckVerdict::not_assessed);
  spot.frame.axes = glm::dmat3(1);
  CHECK(checks_of_glare(scene, {})[0].verdict == CheckVerdict::pass);
}

TEST_CASE("the intensity of tubes and meshes follows from their surfaces", "[emergency][rules]") {
  const double pi = std::numbers::pi;
  SceneDescription scene = corridor();
  scene.emitters = {luminaire("bare", {2, 0, 2.4}, 100)};
  Emitter& lamp = scene.emitters.front();
  lamp.distribution = Distribution::lambertian;
  // A tube across the route: flux = pi^2 I in all directions across it.
  lamp.shape = EmitterShape::tube;
  CHECK(*checks_of_glare(scene, {})[0].value == Approx(200 / (pi * pi)).epsilon(1e-4));
  // A panel that faces down: I = flux / pi cos, at least 60 degrees off its axis in the zone.
  lamp.shape = EmitterShape::mesh;
  lamp.mesh.positions = {{0, 0, 0}, {0, 1, 0}, {1, 1, 0}, {1, 0, 0}};
  lamp.mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  CHECK(*checks_of_glare(scene, {})[0].value == Approx(200 / pi * 0.5));
  lamp.emergency_flux = 1e4;
  CHECK(checks_of_glare(scene, {})[0].verdict == CheckVerdict::fail);
  CHECK(checks_of_glare(scene, {})[0].reasons == Remarks{remark(RemarkId::mesh_unhidden)});
}

TEST_CASE("glare at a rated flux alone is not assessed, unless that flux glares already",
          "[emergency][rules]") {
  SceneDescription scene = corridor();
  Emitter& lamp = scene.emitters[0];
  lamp.initial_flux_known = false;
  const Check unknown = checks_of_glare(scene, {})[0];
  CHECK(unknown.verdict == CheckVerdict::not_assessed);
  CHECK(unknown.reasons == Remarks{remark(RemarkId::initial_flux_unknown)});
  CHECK(checks_of_glare(scene, {})[1].verdict == CheckVerdict::pass);
  lamp.emergency_flux = 1e5;
  CHECK(checks_of_glare(scene, {})[0].verdict == CheckVerdict::fail);
}

TEST_CASE("a value that is its limit but for rounding keeps it", "[emergency][rules]") {
  const auto verdict = [](double value, bool at_least) {
    return judged(rule_of(RuleId::E8, {}), {}, value, Limit{500, at_least});
  };
  CHECK(verdict(500.00000000000006, false).verdict == CheckVerdict::pass);
  CHECK(*verdict(500.00000000000006, false).value == 500);
  CHECK(verdict(499.99999999999994, true).verdict == CheckVerdict::pass);
  CHECK(verdict(500.001, false).verdict == CheckVerdict::fail);
  CHECK(verdict(499.999, true).verdict == CheckVerdict::fail);
}

TEST_CASE("a luminaire behind a wall does not count as near, and the check names it",
          "[emergency][rules]") {
  const SceneDescription scene = corridor();
  EmphasisPoint door;
  door.name = "door";
  door.position = {3, 0, 0};
  const auto open = checks_of_emphasis(scene, door, {true, true}, std::nullopt, {});
  CHECK(*of(open, "E12").value == Approx(1));
  const auto hidden = checks_of_emphasis(scene, door, {false, true}, std::nullopt, {});
  CHECK(of(hidden, "E12").verdict == CheckVerdict::fail);
  CHECK(*of(hidden, "E12").value == Approx(5));
  CHECK(of(hidden, "E12").reasons == Remarks{remark(RemarkId::nearest_luminaire, "b"),
                                             remark(RemarkId::behind_something, "a", 1)});
  const auto none = checks_of_emphasis(scene, door, {false, false}, std::nullopt, {});
  CHECK(of(none, "E12").verdict == CheckVerdict::fail);
  CHECK(of(none, "E12").reasons ==
        Remarks{remark(RemarkId::none_above_in_sight), remark(RemarkId::behind_something, "a", 1)});
  Sign sign = sign_of(0, 0);
  sign.lighting = SignLighting::external;
  CHECK(*of(checks_of_sign(scene, sign, 60, {false, true}, {}), "S6l").value ==
        Approx(std::sqrt(10.0)));
}

TEST_CASE("bends of routes are points of emphasis, and a luminaire within 2 m is near",
          "[emergency][rules]") {
  SceneDescription scene = corridor();
  scene.routes.front().path = {{0, 0, 0}, {8, 0, 0}, {8, 5, 0}};
  const auto points = emphasis_of(scene);
  REQUIRE(points.size() == 1);
  CHECK(points[0].position == glm::dvec3(8, 0, 0));
  CHECK(of(checks_of_emphasis(scene, points[0], {}, std::nullopt, {}), "E12").verdict ==
        CheckVerdict::pass);
  EmphasisPoint hose;
  hose.name = "hose";
  hose.kind = EmphasisKind::fire_equipment;
  hose.position = {5, 0, 1};
  auto checks = checks_of_emphasis(scene, hose, {}, std::nullopt, {});
  CHECK(of(checks, "E12").verdict == CheckVerdict::fail);
  CHECK(*of(checks, "E12").value == Approx(3));
  CHECK(of(checks, "E13").verdict == CheckVerdict::not_assessed);
  checks = checks_of_emphasis(scene, hose, {}, 6.0, {});
  CHECK(of(checks, "E13").verdict == CheckVerdict::pass);
}

TEST_CASE("a single luminance for a colour can fail a sign but never pass it",
          "[emergency][rules]") {
  SceneDescription scene = corridor();
  auto checks = checks_of_sign(scene, sign_of(90, 12), 0, {}, {});
  CHECK(of(checks, "S1").verdict == CheckVerdict::not_assessed);
  CHECK(of(checks, "S2").verdict == CheckVerdict::not_assessed);
  CHECK(of(checks, "S3").verdict == CheckVerdict::pass);
  CHECK(of(checks_of_sign(scene, sign_of(90, 9), 0, {}, {}), "S1").verdict == CheckVerdict::fail);
  scene.assessment.smoke_expected = false;
  CHECK(of(checks_of_sign(scene, sign_of(45, 9), 0, {}, {}), "S1").verdict ==
        CheckVerdict::not_assessed);
  Sign mapped = sign_of(90, 12);
  mapped.face.relative_luminance = {1, 1};
  scene.assessment.smoke_expected = true;
  checks = checks_of_sign(scene, mapped, 0, {}, {});
  CHECK(of(checks, "S1").verdict == CheckVerdict::pass);
  CHECK(of(checks, "S2").verdict == CheckVerdict::pass);
  CHECK(of(checks_of_sign(scene, sign_of(200, 12), 0, {}, {}), "S3").verdict == CheckVerdict::fail);
}

TEST_CASE("low signs are not assessed for height, middle heights fail, and letters are measured",
          "[emergency][rules]") {
  const SceneDescription scene = corridor();
  Sign low = sign_of(90, 12);
  low.frame.origin.z = 0.4;
  CHECK(of(checks_of_sign(scene, low, 0, {}, {}), "S6").verdict == CheckVerdict::not_assessed);
  Sign middle = sign_of(90, 12);
  middle.frame.origin.z = 1.8;
  CHECK(of(checks_of_sign(scene, middle, 0, {}, {}), "S6").verdict == CheckVerdict::fail);
  Sign words = sign_of(90, 12);
  words.letters = SignLetters{0.15, 0.02};
  const auto checks = checks_of_sign(scene, words, 0, {}, nfpa);
  CHECK(of(checks, "N7").verdict == CheckVerdict::fail);
  CHECK(of(checks, "N7s").verdict == CheckVerdict::pass);
  Sign lit = sign_of(0, 0);
  lit.lighting = SignLighting::external;
  CHECK(of(checks_of_sign(scene, lit, 60, {}, nfpa), "N6").verdict == CheckVerdict::pass);
  CHECK(of(checks_of_sign(scene, words, 0, {}, en13), "S6").verdict == CheckVerdict::pass);
  CHECK(of(checks_of_sign(scene, sign_of(90, 12), 0, {}, nfpa), "N7").verdict ==
        CheckVerdict::not_assessed);
}

TEST_CASE("a sign behind the walker does not count", "[emergency][rules]") {
  SceneDescription scene = corridor();
  scene.signs = {sign_of(90, 12)};
  scene.signs[0].frame.origin = {-1, 0, 2};
  scene.signs[0].frame.axes =
      glm::dmat3(glm::dvec3(0, -1, 0), glm::dvec3(0, 0, 1), glm::dvec3(1, 0, 0));
  const auto people = walkers(scene.routes.front(), 5);
  std::vector<std::vector<ClearSign>> clear(people.size());
  for (size_t i = 0; i < people.size(); ++i) {
    clear[i] = {{0, view_of_sign(scene.signs[0], people[i].foot + glm::dvec3(0, 0, 2))}};
    REQUIRE_FALSE(clear[i][0].view.behind);
  }
  for (const auto& [codes, id] : {std::pair(en13, "S4"), std::pair(nfpa, "N8")}) {
    const auto checks = checks_of_distance(scene, scene.routes.front(), people, clear, codes);
    CHECK(of(checks, id).verdict == CheckVerdict::fail);
    CHECK(of(checks, id).reasons == Remarks{remark(RemarkId::no_sign_ahead)});
  }
}

TEST_CASE("a route needs a sign within the allowed distance everywhere", "[emergency][rules]") {
  SceneDescription scene = corridor();
  scene.signs = {sign_of(90, 12)};
  scene.signs[0].frame.origin = {20, 0, 2};
  scene.signs[0].frame.axes =
      glm::dmat3(glm::dvec3(0, 1, 0), glm::dvec3(0, 0, 1), glm::dvec3(-1, 0, 0));
  const auto people = walkers(scene.routes.front(), 5);
  std::vector<std::vector<ClearSign>> clear(people.size());
  for (size_t i = 0; i < people.size(); ++i)
    clear[i] = {{0, view_of_sign(scene.signs[0], people[i].foot + glm::dvec3(0, 0, 2))}};
  const auto far = [&](const CodeChoice& codes) {
    return checks_of_distance(scene, scene.routes.front(), people, clear, codes);
  };
  auto checks = of_all_codes(far);
  CHECK(*of(checks, "S4").value == Approx(20.0 / 30));  // z h = 200 x 0.15 m
  CHECK(*of(checks, "N8").value == Approx(20));
  clear.back().clear();
  checks = of_all_codes(far);
  CHECK(of(checks, "S4").verdict == CheckVerdict::fail);
  CHECK(of(checks, "N8").verdict == CheckVerdict::fail);
}

TEST_CASE("the onset of light is judged where luminaires state it", "[emergency][rules]") {
  SceneDescription scene = corridor();
  const std::vector<LitPoint> points{at(0, 0.7, 0.7)};
  const EscapeRoute& route = scene.routes.front();
  RouteLight light;
  light.centre = light.band = light.inner = points;
  const auto of_route = [&](const CodeChoice& codes) {
    return checks_of_route(scene, route, light, codes);
  };
  CHECK_FALSE(has(of_route(en13), "E10h"));
  CHECK(of(checks_beyond(scene, en13), "E10").subject == Subject{SubjectKind::all_luminaires});
  scene.emitters[0].onset = scene.emitters[1].onset = {{0, 0}, {5, 0.3}, {10, 1}};
  auto checks = of_all_codes(of_route);
  CHECK(*of(checks, "E10h").value == Approx(0.42));
  CHECK(*of(checks, "E10h").limit == 0.5);
  CHECK(of(checks, "E10h").verdict == CheckVerdict::fail);
  CHECK(of(checks, "E10f").verdict == CheckVerdict::pass);
  CHECK(of(checks, "N5").verdict == CheckVerdict::pass);
  CHECK(of(checks_beyond(scene, en13), "E10").subject == Subject{SubjectKind::all_signs});
  // A luminaire without onset counts as dark: without it there is too little light for a verdict.
  scene.emitters[1].onset.clear();
  checks = of_route(en13);
  CHECK(of(checks, "E10f").verdict == CheckVerdict::not_assessed);
  CHECK(of(checks, "E10f").reasons == Remarks{remark(RemarkId::onset_unsaid, "b")});
  light.centre = {at(0, 2, 0)};
  CHECK(of(of_route(en13), "E10f").verdict == CheckVerdict::pass);
  AssessedArea bench;
  bench.mains_lx = 100;
  const std::vector<LitPoint> plane{at(0, 40, 40)};
  CHECK(*of(checks_of_task_area(corridor(), bench, plane, {}), "E7").value == 80);
  scene.emitters[0].onset = {{0, 0.5}, {0.5, 1}};
  const auto task = checks_of_task_area(scene, bench, plane, {});
  CHECK(of(task, "E10t").verdict == CheckVerdict::not_verified);  // 0.5 s was found in no source
  CHECK(*of(task, "E10t").value == 40);
}

TEST_CASE("a luminaire whose supply is exhausted lights no check", "[emergency][rules]") {
  SceneDescription scene = corridor();
  const EscapeRoute& route = scene.routes.front();
  RouteLight light;
  light.centre = light.band = light.inner = {at(0, 3, 0.9), at(10, 3, 2)};
  const FedLuminaires fed{false, true};
  const auto checks = of_all_codes(
      [&](const CodeChoice& codes) { return checks_of_route(scene, route, light, codes, fed); });
  for (const char* id : {"E1", "E2", "E5", "N2m"}) CHECK(*of(checks, id).value == Approx(0.9));
  CHECK(*of(checks, "N1m").value == Approx(2 * 3.9));  // of new luminaires, at the failure
  CHECK(*check_of_failure(scene, subject_of(route), light.centre, fed).value == 0);
  AssessedArea bench;
  bench.mains_lx = 100;
  CHECK(*of(checks_of_task_area(scene, bench, light.centre, {}, fed), "E7").value == Approx(0.9));
  CHECK(*of(checks_of_open_area(scene, bench, light.centre, {}, fed), "E6").value == Approx(0.9));

  EmphasisPoint door;
  door.position = scene.emitters[0].frame.origin - glm::dvec3(0, 0, 1);
  const auto nearest = checks_of_emphasis(scene, door, {}, {}, en13, fed);
  CHECK(of(nearest, "E12").verdict == CheckVerdict::fail);
  CHECK(of(nearest, "E12").reasons.back() == remark(RemarkId::supply_exhausted, "a", 0.0));
  const auto alone = checks_of_emphasis(scene, door, {}, {}, en13, {false, false});
  CHECK(of(alone, "E12").reasons.front() == remark(RemarkId::none_above_in_sight));

  // 36 s: there after 5 s, and not after 60 s.
  for (Emitter& e : scene.emitters) {
    e.onset = {{0, 0}, {5, 1}};
    e.duration_s = 36;
  }
  const auto timed = checks_of_route(scene, route, light, en13);
  CHECK(*of(timed, "E10h").value == Approx(3.9));
  CHECK(*of(timed, "E10f").value == 0);
  CHECK(of(timed, "E10f").verdict == CheckVerdict::fail);
}

TEST_CASE("one supply that is too short fails, whatever others state", "[emergency][rules]") {
  SceneDescription scene = corridor();
  CHECK(check_of_duration(scene, en13).verdict == CheckVerdict::not_assessed);
  scene.emitters[1].duration_s = 36;
  Check check = check_of_duration(scene, en13);
  CHECK(check.verdict == CheckVerdict::fail);
  CHECK(*check.value == Approx(0.01));
  CHECK(check.reasons == Remarks{remark(RemarkId::shortest_supply, "b")});
  scene.emitters[1].duration_s = 3600;
  check = check_of_duration(scene, en13);
  CHECK(check.verdict == CheckVerdict::not_assessed);
  CHECK(check.reasons == Remarks{remark(RemarkId::some_durations_unsaid)});
  scene.emitters[0].duration_s = 7200;
  CHECK(check_of_duration(scene, en13).verdict == CheckVerdict::pass);
  scene.signs = {sign_of(100, 10)};
  scene.signs.front().duration_s = 1800;
  CHECK(check_of_duration(scene, en13).verdict == CheckVerdict::fail);
  CHECK(check_of_duration(scene, en13).reasons ==
        Remarks{remark(RemarkId::shortest_supply, "exit")});
}

TEST_CASE("a rule for which the scene states too little never passes", "[emergency][rules]") {
  const auto checks = of_all_codes([](const CodeChoice& codes) {
    auto out = checks_beyond(corridor(), codes);
    out.push_back(check_of_duration(corridor(), codes));
    return out;
  });
  CHECK_FALSE(checks.empty());
  for (const Check& check : checks) {
    CHECK(check.verdict == CheckVerdict::not_assessed);
    CHECK_FALSE(check.reasons.empty());
  }
  const CheckCounts counts = counts_of(checks);
  CHECK(words_of(counts) ==
        "no check could be made, " + std::to_string(checks.size()) + " not assessed");
}

TEST_CASE(
    "externally lit signs are judged by the light on them, and photoluminescent ones never pass",
    "[emergency][rules]") {
  SceneDescription scene = corridor();
  Sign lit = sign_of(0, 0);
  lit.lighting = SignLighting::external;
  lit.colours[1].reflectance = Spectrum::constant(0.15);
  lit.colours[0].reflectance = Spectrum::constant(0.75);
  const auto dim = checks_of_sign(scene, lit, 60, {}, en13);
  CHECK(of(dim, "S1").verdict == CheckVerdict::fail);
  CHECK(*of(dim, "S1").value == Approx(60 * 0.15 / std::numbers::pi));  // Lambert
  CHECK(*of(dim, "S3").value == Approx(5));
  // A mean does not show how dim the dimmest place is.
  CHECK(of(checks_of_sign(scene, lit, 300, {}, en13), "S1").verdict == CheckVerdict::not_assessed);
  lit.colours[0].reflectance = Spectrum::constant(0.1);
  CHECK(of(checks_of_sign(scene, lit, 60, {}, en13), "S3").verdict == CheckVerdict::fail);
  Sign glow = sign_of(1, 0.1);
  glow.lighting = SignLighting::photoluminescent;
  CHECK(of(checks_of_sign(scene, glow, 0, {}, en13), "S1").verdict == CheckVerdict::not_assessed);
}

TEST_CASE("a red EXIT is judged by NFPA 101, and by EN 1838 its colours fail by name",
          "[emergency][rules]") {
  const SceneDescription scene = corridor();
  Sign exit = sign_of(0, 0);
  exit.colours = {
      {.name = "red", .drawn = {0x9B, 0x24, 0x23}, .mains_cd_m2 = 60, .emergency_cd_m2 = 40},
      {.name = "white", .drawn = {0xEC, 0xEC, 0xE7}}};
  exit.letters = SignLetters{0.1524, 0.01905};
  const auto american = checks_of_sign(scene, exit, 0, {}, nfpa);
  CHECK(of(american, "N7").verdict == CheckVerdict::pass);
  CHECK(of(american, "N7s").verdict == CheckVerdict::pass);
  CHECK_FALSE(has(american, "S8c"));
  const auto european = checks_of_sign(scene, exit, 0, {}, en24);
  const Check& colours = of(european, "S8c");
  CHECK(colours.verdict == CheckVerdict::fail);
  CHECK(colours.reasons == Remarks{remark(RemarkId::other_colours, "red, white")});
  for (const char* rule : {"S1", "S3"}) {
    CHECK(of(european, rule).verdict == CheckVerdict::not_assessed);
    CHECK(of(european, rule).reasons == colours.reasons);
  }
  CHECK_FALSE(has(checks_of_sign(scene, sign_of(100, 12), 0, {}, en24), "S8c"));
}

TEST_CASE("green and white count as such by any name and with other colours beside them",
          "[emergency][rules]") {
  Sign exit = sign_of(100, 12);
  exit.colours[0].name = "blanc";
  exit.colours[1].name = "vert";
  exit.colours.push_back({.name = "black", .drawn = {0x2B, 0x2B, 0x2C}});
  const auto checks = checks_of_sign(corridor(), exit, 0, {}, en24);
  CHECK_FALSE(has(checks, "S8c"));
  CHECK(*of(checks, "S1").value == 12);
  CHECK(*of(checks, "S3").value == Approx(100 / 12.0));
}

TEST_CASE("a luminaire on another storey does not count as near, and the check names it",
          "[emergency][rules]") {
  SceneDescription scene = corridor();
  EscapeRoute upper = scene.routes.front();
  upper.name = "gallery";
  upper.path = {{0, 3, 3.2}, {10, 3, 3.2}};
  scene.routes.push_back(upper);
  scene.emitters = {luminaire("far", {8, 0, 2.8}, 100), luminaire("above", {3, 2.5, 6}, 100)};
  EmphasisPoint door;
  door.name = "door";
  door.position = {3, 1, 0};
  const Check check = of(checks_of_emphasis(scene, door, {true, true}, std::nullopt, {}), "E12");
  CHECK(check.verdict == CheckVerdict::fail);
  CHECK(check.reasons.back() == remark(RemarkId::other_storey, "above", 1.5));
}

TEST_CASE("luminaires must hang 2 m above the floor below them", "[emergency][rules]") {
  const SceneDescription scene = corridor();
  for (const Check& check : checks_of_height(scene, en13)) {
    CHECK(check.verdict == CheckVerdict::pass);
    CHECK(*check.value == Approx(2.8));
  }
  const FloorUnder gallery = [](const glm::dvec3&) { return std::optional(1.0); };
  CHECK(of(checks_of_height(scene, en13, gallery), "E14").verdict == CheckVerdict::fail);
  // Glare: 200 lm when new, the same in all directions, is 15.9 cd; the limit is that of the true
  // height.
  CHECK(*of(checks_of_glare(scene, en13), "E8").limit == 900);
  CHECK(*of(checks_of_glare(scene, en13, gallery), "E8").limit == 500);
  CHECK(checks_of_height(scene, nfpa).empty());
}

TEST_CASE("a code without rules for areas says so, and rules for unnamed things are not assessed",
          "[emergency][rules]") {
  SceneDescription scene = corridor();
  const AssessedArea hall{"hall", {}, {{0, 0}, {4, 0}, {4, 4}, {0, 4}}, 0, 0, ""};
  CHECK(of(checks_of_open_area(scene, hall, {at(1, 5, 5)}, nfpa), "N1").verdict ==
        CheckVerdict::not_assessed);
  CHECK(of(checks_of_task_area(scene, hall, {at(1, 5, 5)}, nfpa), "N1").verdict ==
        CheckVerdict::not_assessed);
  CHECK(has(checks_beyond(scene, en24), "E12"));
  EmphasisPoint door;
  scene.emphasis = {door};
  CHECK_FALSE(has(checks_beyond(scene, en24), "E12"));
  CHECK_FALSE(has(checks_beyond(scene, en24), "E5"));
  scene.routes.clear();
  CHECK(has(checks_beyond(scene, en24), "E5"));
  CHECK(has(checks_beyond(scene, nfpa), "N1"));
}
