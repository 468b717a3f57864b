// Light before its first event: computed, and traced. The scenes are those of
// actors/judge/validate.
#include "tests/optics/light_kit.hpp"

namespace luxodus::light {
namespace {

/// Checks the area-lamp cases whose names end like this.
void check_lamps(const std::string& end, size_t count, const CaseOptions& options = {}) {
  size_t checked = 0;
  for (const Case& c : all_cases()) {
    if (!c.name.starts_with("area lamp") || !c.name.ends_with(end)) continue;
    check_case(c, options);
    ++checked;
  }
  CHECK(checked == count);
}

}  // namespace

TEST_CASE("deterministic direct light, horizontal and vertical, equals the configuration factor") {
  check_lamps("direct light", 3);
}

TEST_CASE("deterministic direct light is attenuated by absorbing gas along every line") {
  for (const std::string sigma : {"0.1", "0.5", "2"}) check_lamps("gas of " + sigma + " /m", 3);
}

TEST_CASE("traced light over the cells of a plane is the exact average of the cells") {
  check_lamps("traced", 3, {.min_particles = 1 << 25, .max_particles = 1 << 25});
}

TEST_CASE("a point source obeys the cosine cubed law") {
  check_cases("point source I=", 4);
}

TEST_CASE("a point source above absorbing layers obeys Beer's law along every line") {
  check_cases("point source over gas", 6);
}

TEST_CASE("a glass pane transmits by Fresnel's equations, in tracing and along shadow rays") {
  check_cases("glass pane", 10);
}

TEST_CASE("rooms with one lamp are lit as closed forms in the manner of CIE 171 state") {
  check_cases("cubic room", 5);
  for (const std::string name :
       {"point source over a rectangle", "point source over a sheet", "area lamp half hidden",
        "lamp over an opening", "diffuse wall under a beam", "beams of", "mirror wall"})
    check_cases(name, 1);
}

TEST_CASE("luminaires of photometric files emit as their tables state") {
  check_cases("luminaire of", 2);
}

}  // namespace luxodus::light
