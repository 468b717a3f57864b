#include "scenes/scene_file/key_reader.hpp"

namespace luxodus {

namespace {

glm::dvec2 vector_of(const std::array<double, 2>& c) {
  return {c[0], c[1]};
}
glm::dvec3 vector_of(const std::array<double, 3>& c) {
  return {c[0], c[1], c[2]};
}

template <size_t N>
auto vectors_of(const std::vector<std::array<double, N>>& rows) {
  std::vector<decltype(vector_of(rows.front()))> out;
  out.reserve(rows.size());
  for (const auto& row : rows) out.push_back(vector_of(row));
  return out;
}

}  // namespace

KeyReader::KeyReader(const toml::Table& table, const std::vector<std::string>& specs,
                     SceneReading& reading)
    : TableReader(table, scene_schema(), specs, reading.findings), reading_(reading) {}

std::optional<glm::dvec2> KeyReader::maybe_pair(std::string_view key) {
  const auto c = components<2>(key, "pair");
  return c ? std::optional(vector_of(*c)) : std::nullopt;
}

glm::dvec2 KeyReader::pair(std::string_view key) {
  return maybe_pair(key).value_or(glm::dvec2(some_number(key)));
}

std::optional<glm::dvec3> KeyReader::maybe_point(std::string_view key) {
  const auto c = components<3>(key, "point");
  return c ? std::optional(vector_of(*c)) : std::nullopt;
}

glm::dvec3 KeyReader::point(std::string_view key) {
  return maybe_point(key).value_or(glm::dvec3(some_number(key)));
}

std::optional<glm::dvec3> KeyReader::maybe_direction(std::string_view key) {
  const auto c = components<3>(key, "direction");
  if (!c) return std::nullopt;
  const glm::dvec3 v = vector_of(*c);
  if (glm::length(v) >= 1e-9) return glm::normalize(v);
  problem(key, "'" + std::string(key) + "' must not be the zero vector");
  return std::nullopt;
}

glm::dvec3 KeyReader::direction(std::string_view key) {
  return maybe_direction(key).value_or(glm::dvec3(0, 0, 1));
}

std::vector<glm::dvec2> KeyReader::pairs(std::string_view key) {
  return vectors_of(rows<2>(key, "pairs", 1));
}

std::vector<glm::dvec2> KeyReader::corners(std::string_view key) {
  return vectors_of(rows<2>(key, "corners", 0));
}

std::vector<glm::dvec3> KeyReader::points(std::string_view key) {
  return vectors_of(rows<3>(key, "points", 0));
}

glm::dvec3 KeyReader::scale(std::string_view key) {
  const toml::Value* said = value(key);
  if (!said) return glm::dvec3(some_number(key));
  if (!said->as_list()) return glm::dvec3(checked(key, *said).value_or(some_number(key)));
  const auto c = components<3>(key, "scale");
  return c ? vector_of(*c) : glm::dvec3(some_number(key));
}

KeyReader kind_reader(const toml::Table& table, const std::string& base, std::string_view key,
                      SceneReading& reading, std::string& kind) {
  const toml::Schema& schema = scene_schema();
  kind = toml::chosen_kind(table, schema, base, key);
  KeyReader keys(table, toml::specs_of_kind(schema, base, key, kind), reading);
  if (kind.empty()) keys.maybe_choice(key);
  return keys;
}

std::string read_name(KeyReader& keys, std::string_view kind) {
  const auto name = keys.maybe_text("name");
  if (!name) {
    // Its name is unknown, so nothing that refers to this kind can be called wrong.
    keys.reading().incomplete = true;
    return "";
  }
  keys.reading().declare(kind, *name, keys.place("name"));
  return *name;
}

}  // namespace luxodus
