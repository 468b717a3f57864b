// The glare that needs no shadow rays is never below that which is computed with them.
#include "actors/judge/visibility_map/glare_bound.hpp"

#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <random>

#include "actors/judge/assess/round_state.hpp"
#include "tests/kit/replaced.hpp"
#include "tests/unit/actors/judge/visibility_map/small_smoky_room.hpp"

using namespace luxodus;
using namespace luxodus::test;

namespace {

/// Light within half a degree of 40 degrees from straight down, and hardly any elsewhere.
constexpr const char* narrow_lobe =
    "IESNA:LM-63-2002\n[TEST] none\nTILT=NONE\n1 -1 1 5 1 1 2 0 0 0\n1 1 10\n0 39.5 40 40.5 90\n"
    "0\n1 1 9000 1 1\n";

const std::string emergency =
    "emergency = \"maintained\"\nemergency_flux = 900\nmaintenance_factor = 1\n"
    "emergency_flux_is = \"rated\"\ninitial_flux = 900\n";

std::string emitter(const char* keys) {
  return fmt::format("[[emitter]]\nname = \"more\"\n{}\nflux_lm = 900\n{}", keys, emergency);
}

struct Glares {
  size_t glaring = 0;  // eyes with glare
  double loosest = 0;  // largest bound over glare
};

/// From random eyes, and from those on a ring about a place under which 40 degrees are.
Glares compared(const std::string& text) {
  const TemporaryFolder folder;
  folder.write("narrow.ies", narrow_lobe);
  const auto scene = described(folder.write("scene.toml", text));
  const auto judged = judged_scene(*scene, judged_scenario(*scene, "").value());
  REQUIRE(judged);
  const auto building = Building::make(judged->scene, judged->scenario, 1);
  REQUIRE(building);
  const GroupFactors factors = factors_of(building.value()->scene(), judged->mixtures());
  const GlareBound bound(*building.value());
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> x(0.2, 11), y(-1.8, 1.8), angle(0, 6.28);
  std::vector<glm::dvec3> eyes;
  for (int i = 0; i < 100; ++i) eyes.emplace_back(x(random), y(random), 1.65);
  const double ring = (2.6 - 1.65) * std::tan(glm::radians(40.0));
  for (int i = 0; i < 20; ++i) {
    const double at = angle(random);
    eyes.emplace_back(8 + ring * std::cos(at), ring * std::sin(at), 1.65);
  }
  const glm::dvec3 centre = scene->signs.front().frame.origin;
  std::vector<std::vector<double>> exact(eyes.size());
  building.value()->each(eyes.size(), [&](const GeometryAccess& access, size_t i) {
    exact[i] = arriving_beside(*building.value(), access, eyes[i], centre, 0, {65}, factors)
                   .veils_cd_m2.front();
  });
  Glares out;
  for (size_t i = 0; i < eyes.size(); ++i) {
    INFO(eyes[i].x << ", " << eyes[i].y);
    const std::vector<double> most = bound.at(eyes[i], centre, 0, 65, factors);
    for (size_t m = 0; m < most.size(); ++m) CHECK(exact[i][m] <= most[m] * (1 + 1e-6));
    out.glaring += exact[i].front() > 0 ? 1 : 0;
    if (exact[i].front() > 0) out.loosest = std::max(out.loosest, most.front() / exact[i].front());
  }
  return out;
}

}  // namespace

TEST_CASE("glare is never above its bound", "[judge][visibility_map]") {
  const char* const place = "position = [8, 0, 2.6]";
  const std::string more = GENERATE_COPY(
      std::string(), emitter(("shape = \"sphere\"\ndiameter = 0.3\n" + std::string(place)).c_str()),
      emitter(("shape = \"tube\"\nlength = 1.2\ndiameter = 0.03\n" + std::string(place)).c_str()),
      emitter(("shape = \"rectangle\"\nsize = [0.6, 0.6]\ndirection = [0, 0.6, -0.8]\n" +
               std::string(place))
                  .c_str()),
      emitter(("shape = \"disc\"\ndiameter = 0.2\ndistribution = \"cosine_power\"\ncosine_power = "
               "60\n" +
               std::string(place))
                  .c_str()),
      "[[luminaire]]\nname = \"more\"\nfile = \"narrow.ies\"\n" + std::string(place) + "\n" +
          emergency,
      "[[luminaire]]\nname = \"more\"\nfile = \"narrow.ies\"\ndirection = [0.6, 0, -0.8]\n" +
          std::string(place) + "\n" + emergency);
  INFO(more);
  const char* const extinction = GENERATE("0.0", "0.8");
  const Glares found = compared(smoky_room(extinction) + more);
  CHECK(found.glaring > 20);
}

TEST_CASE("the bound of glare is that of a small lamp in clear air", "[judge][visibility_map]") {
  // What the screen hides counts in the bound alone.
  const std::string open =
      replaced(smoky_room("0.0"), "high = [5.1, 0, 3]", "high = [5.1, -1.9, 3]");
  CHECK(compared(open).loosest < 1.5);
}
