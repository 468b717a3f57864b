// Remarks and subjects as JSON: {"id": "points_in_bodies", "args": [3, 40], "text": "..."}, where
// "text" is English and for people alone: programs read id and args. Pure; any thread.
#pragma once

#include "actors/judge/texts/texts.hpp"
#include "actors/results/formats/json.hpp"
#include "runtime/core/result.hpp"

namespace luxodus {

Json remark_json(const Remark& remark);
/// A list.
Json remarks_json(const Remarks& remarks);
/// {"kind": "route", "name": "corridor", "text": "route \"corridor\""}; "emphasis" beside them for
/// a point of emphasis.
Json subject_json(const Subject& subject);

/// The English sentences of remarks as they stand in JSON, joined: of a list, or of one; "" where
/// there is none.
std::string english_in(const Json& json, const char* key);

/// Errors: no remark of this program, which kind of it, or other arguments than it has.
Result<Remark> read_remark(const Json& json);
Result<Remarks> read_remarks(const Json& json);
Result<Subject> read_subject(const Json& json);

}  // namespace luxodus
