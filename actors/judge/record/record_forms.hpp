// Forms in JSON of types of scenes, which list no fields, for the sources that write and read
// records. Pure functions; any thread.
#pragma once

#include "actors/judge/texts/remark_json.hpp"
#include "actors/results/formats/json_fields.hpp"
#include "scenes/emergency/guidance.hpp"
#include "scenes/emergency/legibility.hpp"
#include "scenes/emergency/mean_observer.hpp"

namespace luxodus {

template <>
inline constexpr size_t names_of<Operation> = operation_words.size();
template <>
inline constexpr size_t names_of<CheckVerdict> = check_verdicts;
template <>
inline constexpr size_t names_of<SightVerdict> = sight_verdicts;
template <>
inline constexpr size_t names_of<MeanObserver> = mean_observer_words.size();
template <>
inline constexpr size_t names_of<Untested> = untested_words.size();
template <>
inline constexpr size_t names_of<GuidedWalk::End> = GuidedWalk::ends;
template <>
struct JsonForm<Remark> {
  static Json write(const Remark& remark, const FieldForm&) { return remark_json(remark); }
  static Result<void> read(const Json& json, Remark& out, const JsonPlace& at, const FieldForm&) {
    auto read = read_remark(json);
    if (!read) return problem(at.text() + ": " + read.problem().what);
    out = std::move(read).value();
    for (RemarkArgument& one : out.arguments)
      if (auto ok = std::visit(
              [&](auto& value) { return read_plain(Json(value), value, at, FieldForm{}); }, one);
          !ok)
        return ok;  // larger than limits allow
    return {};
  }
};

template <>
struct JsonForm<Subject> {
  static Json write(const Subject& subject, const FieldForm&) { return subject_json(subject); }
  static Result<void> read(const Json& json, Subject& out, const JsonPlace& at, const FieldForm&) {
    auto read = read_subject(json);
    if (!read) return problem(at.text() + ": " + read.problem().what);
    out = std::move(read).value();
    return read_plain(Json(out.name), out.name, at, {});
  }
};

/// {"value", "standard_error", "unit"}; either number may be unknown.
template <>
struct JsonForm<Uncertain> {
  static Json write(const Uncertain& u, const FieldForm& form) {
    return measured_json(u.value, u.error, form.unit);
  }
  static Result<void> read(const Json& json, Uncertain& out, const JsonPlace& at,
                           const FieldForm& form) {
    if (auto ok = read_plain(json, out.value, at, {.unit = form.unit, .or_null = true}); !ok)
      return ok;
    const auto error = json.find("standard_error");
    if (error == json.end()) return no_key(at, "standard_error");
    return read_plain(*error, out.error, JsonPlace{&at, "standard_error"}, {.or_null = true});
  }
};

}  // namespace luxodus
