// Rules on values that are put in: what passes, what fails, where it is worst.
#include "scenes/emergency/rules.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "scenes/light/signs/sign_face.hpp"
#include "tests/unit/scenes/emergency/code_choices.hpp"

using namespace luxodus;

namespace {

/// The checks of every set, one after the other.
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

/// A level route 10 m long, two luminaires 2.8 m above it.
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
  sign.mains = {500, 100};
  sign.emergency = {white, green};
  sign.face.width = 2;
  sign.face.height = 1;
  sign.face.colour = {SignColour::white, SignColour::green};
  return sign;
}

}  // namespace

TEST_CASE("a route passes at 1 lx and 40 to 1, and fails below", "[emergency][rules]") {
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

TEST_CASE("at first light is what it was before batteries and lamps have aged",
          "[emergency][rules]") {
  const SceneDescription scene = corridor();
  RouteLight light;
  light.centre = {at(0, 0.4, 0.4), at(10, 6, 6)};
  const auto checks = checks_of_route(scene, scene.routes.front(), light, nfpa);
  CHECK(*of(checks, "N2").value == Approx((0.8 + 12) / 2));
  CHECK(*of(checks, "N1").value == Approx(0.8 + 12));  // half is left at the end
  CHECK(*of(checks, "N1m").value == Approx(1.6));
  CHECK(of(checks, "N1").verdict == CheckVerdict::pass);
  CHECK(of(checks, "N2").verdict == CheckVerdict::fail);
}

TEST_CASE("each luminaire fails in turn, and the worst is told", "[emergency][rules]") {
  const SceneDescription scene = corridor();
  const Check failed =
      check_of_failure(scene, {SubjectKind::route, "corridor"}, {at(0, 5, 0.2), at(10, 0.1, 5)});
  CHECK(failed.verdict == CheckVerdict::information);
  CHECK(*failed.value == Approx(0.1));
  CHECK(failed.conditions == Remarks{remark(RemarkId::luminaire_failed, "b")});
}

TEST_CASE("wide routes are strips of 2 m at most", "[emergency][rules]") {
  EscapeRoute route = corridor().routes.front();
  route.width_m = 5;
  const RoutePoints points = points_of(route);
  double widest = 0;
  for (const glm::dvec3& p : points.centre) widest = std::max(widest, std::abs(p.y));
  CHECK(widest == Approx(5.0 / 3));  // three strips, of which the middle one is the centre
  double edge = 0;
  for (const glm::dvec3& p : points.inner) edge = std::max(edge, std::abs(p.y));
  CHECK(edge == Approx(2.0));  // all but half a metre each side
  route.width_m = 1.6;
  for (const glm::dvec3& p : points_of(route).band) CHECK(std::abs(p.y) <= 0.4 + 1e-9);
}

TEST_CASE("a place without any light fails beyond all measure, and without luminaires too",
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

TEST_CASE("a task needs 15 lx or a tenth of its mains light, whichever is more",
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

TEST_CASE("glare is judged by the new luminaire's intensity and its height", "[emergency][rules]") {
  SceneDescription scene = corridor();
  // 4 pi I lumens when new, half of it at the end.
  const double pi = std::numbers::pi;
  scene.emitters = {luminaire("low", {2, 0, 2.4}, 0.5 * 4 * pi * 501),
                    luminaire("high", {2, 0, 2.6}, 0.5 * 4 * pi * 501)};
  const auto checks = checks_of_glare(scene, {});
  REQUIRE(checks.size() == 2);
  CHECK(*checks[0].value == Approx(501));
  CHECK(checks[0].verdict == CheckVerdict::fail);  // 500 cd below 2.5 m
  CHECK(checks[1].verdict == CheckVerdict::pass);  // 900 cd below 3 m
  CHECK(checks[0].conditions == Remarks{remark(RemarkId::glare_zone)});
  scene.routes.front().path[1].z = 1;  // no level route any more
  CHECK(checks_of_glare(scene, {})[0].conditions == Remarks{remark(RemarkId::all_directions)});
}

TEST_CASE("a spot glares where its cone reaches, a beam where it points", "[emergency][rules]") {
  const double pi = std::numbers::pi;
  SceneDescription scene = corridor();
  scene.emitters = {luminaire("spot", {2, 0, 2.4}, 100)};
  Emitter& spot = scene.emitters.front();
  spot.distribution = Distribution::spot;
  spot.spot_inner_deg = 20;
  spot.spot_outer_deg = 40;
  // Straight down: nothing beyond 40 degrees, so nothing between 60 and 90.
  CHECK(*checks_of_glare(scene, {})[0].value == 0);
  // In all directions its axis counts: 200 lm when new over pi ((1 - cos 20) + (1 - cos 40)) sr.
  scene.routes.front().path[1].z = 1;
  const double sr = pi * (2 - std::cos(20 * pi / 180) - std::cos(40 * pi / 180));
  CHECK(*checks_of_glare(scene, {})[0].value == Approx(200 / sr));
  // Aimed level, its axis lies in the zone.
  scene.routes.front().path[1].z = 0;
  spot.frame.axes = glm::dmat3(glm::dvec3(0, 1, 0), glm::dvec3(0, 0, 1), glm::dvec3(1, 0, 0));
  CHECK(*checks_of_glare(scene, {})[0].value == Approx(200 / sr));
  spot.distribution = Distribution::collimated;
  CHECK(checks_of_glare(scene, {})[0].verdict == CheckVerdict::not_assessed);
  spot.frame.axes = glm::dmat3(1);
  CHECK(checks_of_glare(scene, {})[0].verdict == CheckVerdict::pass);
}

TEST_CASE("tubes and meshes have the intensity of their surfaces", "[emergency][rules]") {
  const double pi = std::numbers::pi;
  SceneDescription scene = corridor();
  scene.emitters = {luminaire("bare", {2, 0, 2.4}, 100)};
  Emitter& lamp = scene.emitters.front();
  lamp.distribution = Distribution::lambertian;
  // A tube across the way: flux = pi^2 I, all around it.
  lamp.shape = EmitterShape::tube;
  CHECK(*checks_of_glare(scene, {})[0].value == Approx(200 / (pi * pi)).epsilon(1e-4));
  // A panel that looks down: I = flux / pi cos, 60 degrees off its axis at most.
  lamp.shape = EmitterShape::mesh;
  lamp.mesh.positions = {{0, 0, 0}, {0, 1, 0}, {1, 1, 0}, {1, 0, 0}};
  lamp.mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  CHECK(*checks_of_glare(scene, {})[0].value == Approx(200 / pi * 0.5));
  lamp.emergency_flux = 1e4;
  CHECK(checks_of_glare(scene, {})[0].verdict == CheckVerdict::fail);
  CHECK(checks_of_glare(scene, {})[0].reasons == Remarks{remark(RemarkId::mesh_unhidden)});
}

TEST_CASE("a luminaire behind a wall is not near, and is named", "[emergency][rules]") {
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

TEST_CASE("bends of routes are points of emphasis, and luminaires are near within 2 m",
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

TEST_CASE("one number for a colour can fail a sign but never pass it", "[emergency][rules]") {
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

TEST_CASE("low signs stand beside high ones, and letters have their measures",
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

TEST_CASE("a sign behind the walker is none", "[emergency][rules]") {
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

TEST_CASE("a route needs a sign near enough everywhere", "[emergency][rules]") {
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

TEST_CASE("light in time is judged where luminaires say how they come on", "[emergency][rules]") {
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
  // What does not say it counts as dark: without it there is too little to tell.
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
  CHECK(of(task, "E10t").verdict == CheckVerdict::not_verified);  // 0.5 s was read nowhere
  CHECK(*of(task, "E10t").value == 40);
}

TEST_CASE("what a scene says nothing of is never a pass", "[emergency][rules]") {
  const auto checks =
      of_all_codes([](const CodeChoice& codes) { return checks_beyond(corridor(), codes); });
  CHECK_FALSE(checks.empty());
  for (const Check& check : checks) {
    CHECK(check.verdict == CheckVerdict::not_assessed);
    CHECK_FALSE(check.reasons.empty());
  }
  const CheckCounts counts = counts_of(checks);
  CHECK(words_of(counts) ==
        "no check could be made, " + std::to_string(checks.size()) + " not assessed");
}

TEST_CASE("signs lit from outside are judged by what falls on them, and glowing ones never pass",
          "[emergency][rules]") {
  SceneDescription scene = corridor();
  Sign lit = sign_of(0, 0);
  lit.lighting = SignLighting::external;
  lit.green_reflectance = Spectrum::constant(0.15);
  lit.white_reflectance = Spectrum::constant(0.75);
  const auto dim = checks_of_sign(scene, lit, 60, {}, en13);
  CHECK(of(dim, "S1").verdict == CheckVerdict::fail);
  CHECK(*of(dim, "S1").value == Approx(60 * 0.15 / std::numbers::pi));  // Lambert
  CHECK(*of(dim, "S3").value == Approx(5));
  // One number says nothing of the dimmest place.
  CHECK(of(checks_of_sign(scene, lit, 300, {}, en13), "S1").verdict == CheckVerdict::not_assessed);
  lit.white_reflectance = Spectrum::constant(0.1);
  CHECK(of(checks_of_sign(scene, lit, 60, {}, en13), "S3").verdict == CheckVerdict::fail);
  Sign glow = sign_of(1, 0.1);
  glow.lighting = SignLighting::photoluminescent;
  CHECK(of(checks_of_sign(scene, glow, 0, {}, en13), "S1").verdict == CheckVerdict::not_assessed);
}

TEST_CASE("a luminaire on another storey is not near, and is named", "[emergency][rules]") {
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

TEST_CASE("luminaires hang 2 m above the floor that is met below them", "[emergency][rules]") {
  const SceneDescription scene = corridor();
  for (const Check& check : checks_of_height(scene, en13)) {
    CHECK(check.verdict == CheckVerdict::pass);
    CHECK(*check.value == Approx(2.8));
  }
  const FloorUnder gallery = [](const glm::dvec3&) { return std::optional(1.0); };
  CHECK(of(checks_of_height(scene, en13, gallery), "E14").verdict == CheckVerdict::fail);
  // Glare: 200 lm new, the same to all sides, is 15.9 cd; the limit is that of the true height.
  CHECK(*of(checks_of_glare(scene, en13), "E8").limit == 900);
  CHECK(*of(checks_of_glare(scene, en13, gallery), "E8").limit == 500);
  CHECK(checks_of_height(scene, nfpa).empty());
}

TEST_CASE("a code that knows no areas says so, and what a scene does not name is not assessed",
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
