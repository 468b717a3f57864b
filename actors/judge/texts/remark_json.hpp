// Remarks and subjects as JSON: {"id": "points_in_bodies", "args": [3, 40], "text": "..."}. "text"
// is English, for people only: programs read id and args. Pure functions; any thread.
#pragma once

#include "actors/judge/texts/texts.hpp"
#include "actors/results/formats/json.hpp"
#include "runtime/core/result.hpp"

namespace luxodus {

Json remark_json(const Remark& remark);
/// {"kind": "route", "name": "corridor", "text": "route \"corridor\""}; with "emphasis" for a point
/// of emphasis.
Json subject_json(const Subject& subject);

/// Errors: an unknown id, or arguments that do not fit its kind.
Result<Remark> read_remark(const Json& json);
Result<Subject> read_subject(const Json& json);

}  // namespace luxodus
