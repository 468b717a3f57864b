#include "actors/results/formats/json_out.hpp"

#include <cmath>

namespace luxodus {

Json number_json(double value) {
  if (!std::isfinite(value)) return nullptr;
  return value;
}

Json vector_json(const glm::dvec3& v) {
  return {v.x, v.y, v.z};
}

std::string text_in(const Json& object, const char* key) {
  const auto at = object.find(key);
  return at != object.end() && at->is_string() ? at->get<std::string>() : std::string();
}

Json measured_json(double value, double standard_error, std::string_view unit) {
  Json out = Json::object();
  out["value"] = number_json(value);
  out["standard_error"] = number_json(standard_error);
  out["unit"] = std::string(unit);
  return out;
}

Json exact_json(double value, std::string_view unit) {
  Json out = Json::object();
  out["value"] = number_json(value);
  out["unit"] = std::string(unit);
  return out;
}

std::string json_text(const Json& document) {
  return document.dump(2) + "\n";
}

Result<void> write_json(const std::filesystem::path& path, const Json& document) {
  return write_file_atomically(path, std::string_view(json_text(document)));
}

}  // namespace luxodus
