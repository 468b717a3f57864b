#include "actors/results/formats/json_fields.hpp"

#include <fmt/format.h>

#include <cmath>

namespace luxodus {

namespace {

/// The place, or what stands for the whole document.
std::string place_words(const JsonPlace& at) {
  const std::string text = at.text();
  return text.empty() ? "it" : text;
}

/// A number of a document, no larger than any should be.
Result<void> check_number(const Json& json, const JsonPlace& at, const char* kind) {
  if (!json.is_number()) return not_of_kind(at, kind);
  if (std::abs(json.get<double>()) <= limits::field_number) return {};
  return problem(place_words(at) + " is larger than any number of a result");
}

/// The number of {"value": ..., "unit": ...}.
Result<void> read_quantity(const Json& json, double& out, const JsonPlace& at, FieldForm form) {
  if (!json.is_object()) return not_of_kind(at, "a table");
  const auto value = json.find("value"), unit = json.find("unit");
  if (value == json.end()) return no_key(at, "value");
  if (unit == json.end()) return no_key(at, "unit");
  if (!unit->is_string() || unit->text() != form.unit)
    return problem(fmt::format("{}.unit is not \"{}\"", place_words(at), form.unit));
  form.unit = {};
  return read_plain(*value, out, JsonPlace{&at, "value"}, form);
}

}  // namespace

std::string JsonPlace::text() const {
  const std::string before = in == nullptr ? "" : in->text();
  if (key != nullptr) return before.empty() ? key : before + "." + key;
  return in == nullptr ? "" : fmt::format("{}[{}]", before, index);
}

Problem not_of_kind(const JsonPlace& at, std::string_view kind) {
  return problem(fmt::format("{} is not {}", place_words(at), kind));
}

Problem no_key(const JsonPlace& at, std::string_view key) {
  return problem(fmt::format("{} has no \"{}\"", place_words(at), key));
}

Problem unknown_word(const JsonPlace& at, const std::string& word) {
  return problem(fmt::format("{} is \"{}\": unknown", place_words(at), word));
}

Result<void> read_plain(const Json& json, bool& out, const JsonPlace& at) {
  if (!json.is_boolean()) return not_of_kind(at, "true or false");
  out = json.get<bool>();
  return {};
}

Result<void> read_plain(const Json& json, double& out, const JsonPlace& at, const FieldForm& form) {
  if (!form.unit.empty()) return read_quantity(json, out, at, form);
  out = std::nan("");
  if (json.is_null() && form.or_null) return {};
  const auto ok = check_number(json, at, form.or_null ? "a number or null" : "a number");
  if (ok) out = json.get<double>();
  return ok;
}

Result<void> read_plain(const Json& json, std::string& out, const JsonPlace& at,
                        const FieldForm& form) {
  if (!json.is_string()) return not_of_kind(at, "a text");
  if (json.text().size() > form.max_text)
    return problem(fmt::format("{} has more than {} characters", place_words(at), form.max_text));
  out = json.text();
  return {};
}

Result<void> read_plain(const Json& json, double* out, size_t count, const JsonPlace& at) {
  if (!json.is_array() || json.size() != count)
    return not_of_kind(at, fmt::format("a list of {} numbers", count));
  for (size_t i = 0; i < count; ++i) {
    const JsonPlace place{&at, nullptr, i};
    if (auto ok = check_number(json[i], place, "a number"); !ok) return ok;
    out[i] = json[i].get<double>();
    if (!(std::abs(out[i]) <= limits::field_metres))
      return problem(place_words(place) + " is farther off than any scene");
  }
  return {};
}

Result<void> read_whole(const Json& json, int64_t low, uint64_t high, uint64_t& out,
                        const JsonPlace& at) {
  constexpr double exact = 9007199254740992.0;  // 2^53: whole numbers up to it are exact
  if (auto ok = check_number(json, at, "a number"); !ok) return ok;
  const double value = json.get<double>();
  if (!json.is_number_integer() && (value != std::floor(value) || std::abs(value) > exact))
    return not_of_kind(at, "a whole number");
  out = static_cast<uint64_t>(json.get<int64_t>());
  const bool negative = value < 0;
  if (negative ? static_cast<int64_t>(out) < low : out > high)
    return not_of_kind(at, fmt::format("from {} to {}", low, high));
  return {};
}

}  // namespace luxodus
