// Parts of buildings as meshes: floors and rooms from outlines, walls with doors and windows,
// stairs, ramps. All are exact (no curved parts). Closed bodies are closed without T-junctions, so
// that no light leaks along a shared edge. Fronts face outward unless stated. Pure functions; any
// thread. Errors as in primitives.hpp.
#pragma once

#include <glm/glm.hpp>
#include <span>

#include "scenes/light/geometry/primitives.hpp"

namespace luxodus {

namespace limits {
/// The wall's grid has up to (2 * 64 + 1)^2 cells: 66 thousand triangles.
inline constexpr size_t wall_openings = 64;
inline constexpr int stair_steps = 500;
}  // namespace limits

namespace shapes {

/// A floor: the outline (either orientation) at z = 0, front towards +z.
Result<Shape> polygon(std::span<const glm::dvec2> outline);

/// A closed prism over the outline, from z = 0 to `height`.
Result<Shape> extrude(std::span<const glm::dvec2> outline, double height);

/// A hole through a wall; its position is its lower corner nearest to the wall's start.
struct WallOpening {
  double x = 0;  // from the start of the wall [m]
  double z = 0;  // from its foot [m]; 0: a door
  double width = 0;
  double height = 0;
};

/// A solid wall along +x from 0 to `length`, from y = 0 to `thickness`, from z = 0 to `height`,
/// with reveals in its openings. Openings may touch or overlap (an L-shaped hole is two). Errors:
/// also an opening that reaches outside, or nothing left of the wall; openings count from 1.
Result<Shape> wall(double length, double height, double thickness,
                   std::span<const WallOpening> openings = {});

enum class StairUnderside {
  none,    // treads and risers only: a folded sheet, fronts up and towards a person climbing
  solid,   // a block down to the floor
  soffit,  // a closed flight; its slanted underside lies one rise below the inner corners
};

/// A flight that climbs along +x from the origin, y from 0 to `width`; step i ends at z = (i + 1)
/// rise.
Result<Shape> stairs(int steps, double rise, double going, double width,
                     StairUnderside underside = StairUnderside::none);

enum class RampUnderside { none, solid };

/// A slope along +x from z = 0 to `rise` over the horizontal `length`, y from 0 to `width`.
Result<Shape> ramp(double length, double width, double rise,
                   RampUnderside underside = RampUnderside::none);

}  // namespace shapes
}  // namespace luxodus
