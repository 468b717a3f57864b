// Which outlines are simple, and which segments meet.
#include "scenes/light/geometry/polygon.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

using namespace luxodus;

namespace {

std::vector<glm::dvec2> turned(std::vector<glm::dvec2> outline, double angle) {
  for (glm::dvec2& p : outline) {
    p = {p.x * std::cos(angle) - p.y * std::sin(angle),
         p.x * std::sin(angle) + p.y * std::cos(angle)};
  }
  return outline;
}

/// A corridor whose long walls have a point every 25 cm, as drawing programs leave them.
std::vector<glm::dvec2> corridor() {
  std::vector<glm::dvec2> outline;
  for (int i = 0; i <= 128; ++i) outline.emplace_back(i * 0.25, 0);
  for (int i = 128; i >= 0; --i) outline.emplace_back(i * 0.25, 1);
  return outline;
}

std::string refusal_of(const std::vector<glm::dvec2>& outline) {
  const auto checked = checked_outline(outline);
  REQUIRE_FALSE(checked.ok());
  return checked.problem().what;
}

}  // namespace

TEST_CASE("an outline may have many points on one wall at any slope", "[geometry]") {
  for (int degrees = 0; degrees < 180; ++degrees) {
    INFO(degrees << " degrees");
    const auto outline = turned(corridor(), degrees * std::numbers::pi / 180);
    CHECK(checked_outline(outline).ok());
    CHECK(triangulate(outline).ok());
  }
}

TEST_CASE("an outline that crosses or touches itself is refused, with both edges named",
          "[geometry]") {
  CHECK(refusal_of({{0, 0}, {2, 2}, {2, 0}, {0, 2}}) ==
        "edges 1 and 3 of the outline touch or cross: outlines must be simple");
  // A corner on the middle of another edge.
  CHECK(refusal_of({{0, 0}, {4, 0}, {4, 2}, {2, 0}, {0, 2}}) ==
        "edges 1 and 3 of the outline touch or cross: outlines must be simple");
  for (int degrees = 0; degrees < 180; degrees += 7) {
    INFO(degrees << " degrees");
    const auto bow = turned({{0, 0}, {2, 2}, {2, 0}, {0, 2}}, degrees * std::numbers::pi / 180);
    CHECK_FALSE(checked_outline(bow).ok());
  }
}

TEST_CASE("segments meet if they share a point, also an end point", "[geometry]") {
  CHECK(segments_meet({0, 0}, {2, 0}, {1, -1}, {1, 1}));
  CHECK(segments_meet({0, 0}, {2, 0}, {2, 0}, {3, 5}));
  CHECK(segments_meet({0, 0}, {2, 0}, {1, 0}, {4, 0}));
  CHECK_FALSE(segments_meet({0, 0}, {2, 0}, {3, 0}, {4, 0}));
  CHECK_FALSE(segments_meet({0, 0}, {2, 2}, {2, 0}, {3, 3}));
}
