// Checks that a JSON is a complete assessment: every key that reports and comparisons read is
// present with its type, and no value is larger than an assessment makes it. Code that reads a
// checked JSON relies on this and checks nothing again. It does not judge whether the values are
// right. Pure functions; any thread.
#pragma once

#include "actors/results/formats/json_out.hpp"
#include "runtime/core/result.hpp"

namespace luxodus {

namespace limits {
/// Characters of a text, and of a picture (4 MiB of pixels as PNG in base64).
inline constexpr size_t assessment_text = 20'000;
inline constexpr size_t assessment_picture = size_t{24} << 20;
/// Largest absolute value of a number: seeds are the largest, integers below 2^64.
inline constexpr double assessment_number = 1.9e19;
/// Largest coordinate, as in scenes [m].
inline constexpr double assessment_metres = 1e7;
/// Nesting depth of objects and lists.
inline constexpr int assessment_depth = 16;
/// Grid points of one illuminance map.
inline constexpr size_t assessment_map = 1'000'000;
}  // namespace limits

/// Errors: the first fault with its place in the file: "checks[3] has no \"verdict\"".
Result<void> check_assessment(const Json& assessment);

}  // namespace luxodus
