// Whether a JSON is a whole assessment: every key that reports and comparisons read is there, of
// its type, and nothing in it is larger than an assessment makes it. Whoever has passed a JSON here
// reads it without asking again. Pure; any thread.
#pragma once

#include "actors/results/formats/json_out.hpp"
#include "runtime/core/result.hpp"

namespace luxodus {

namespace limits {
/// Characters of a text in an assessment; of a picture (4 MiB of pixels, encoded again, as text).
inline constexpr size_t assessment_text = 20'000;
inline constexpr size_t assessment_picture = size_t{24} << 20;
/// Of any number in it: seeds are the largest, whole numbers below 2^64.
inline constexpr double assessment_number = 1.9e19;
/// Coordinates, as scenes take them [m].
inline constexpr double assessment_metres = 1e7;
/// Levels of tables within tables.
inline constexpr int assessment_depth = 16;
/// Places of one map of light.
inline constexpr size_t assessment_map = 1'000'000;
}  // namespace limits

/// Errors: the first thing that is wrong, by its place in the file: "checks[3] has no \"verdict\"".
Result<void> check_assessment(const Json& assessment);

}  // namespace luxodus
