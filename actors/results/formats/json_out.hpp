// JSON as Luxodus writes it: keys in insertion order, numbers in the shortest form that reads back
// to the same bits, null for NaN and infinity, always valid UTF-8, indented by two spaces with a
// line feed at the end, so that equal content gives equal bytes. Pure; any thread.
#pragma once

#include <filesystem>
#include <glm/glm.hpp>
#include <string>
#include <string_view>

#include "actors/results/formats/json.hpp"
#include "runtime/core/atomic_file.hpp"
#include "runtime/core/result.hpp"

namespace luxodus {

/// The number, or null where it is not finite.
Json number_json(double value);

/// [x, y, z].
Json vector_json(const glm::dvec3& v);

/// The text of a key; "" where there is none.
std::string text_in(const Json& object, const char* key);

/// {"value": v, "standard_error": e, "unit": u}: the form of every result in a report.
Json measured_json(double value, double standard_error, std::string_view unit);

/// {"value": v, "unit": u}: a quantity that is exact or computed deterministically.
Json exact_json(double value, std::string_view unit);

/// The text of a document. In strings, bytes that are not UTF-8 are replaced by U+FFFD.
std::string json_text(const Json& document);

/// Errors: as write_file_atomically.
Result<void> write_json(const std::filesystem::path& path, const Json& document);

}  // namespace luxodus
