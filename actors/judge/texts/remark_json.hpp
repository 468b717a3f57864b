// Remarks and subjects as JSON: {"id": "points_in_bodies", "args": [3, 40], "text": "..."}. "text"
// is English, for people only: programs read id and args. Pure functions; any thread.
#pragma once

#include "actors/judge/texts/texts.hpp"
#include "actors/results/formats/json.hpp"
#include "runtime/core/result.hpp"

namespace luxodus {

Json remark_json(const Remark& remark);
/// A list of remarks.
Json remarks_json(const Remarks& remarks);
/// {"kind": "route", "name": "corridor", "text": "route \"corridor\""}; with "emphasis" for a point
/// of emphasis.
Json subject_json(const Subject& subject);

/// The English sentences of the remark or list of remarks at a key, joined; "" if there are none.
std::string english_in(const Json& json, const char* key);

/// Errors: an unknown id, or arguments that do not fit its kind.
Result<Remark> read_remark(const Json& json);
Result<Remarks> read_remarks(const Json& json);
Result<Subject> read_subject(const Json& json);

}  // namespace luxodus
