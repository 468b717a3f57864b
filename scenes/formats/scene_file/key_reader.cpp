#include "scenes/formats/scene_file/key_reader.hpp"

#include <fmt/format.h>

#include <algorithm>

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

bool KeyReader::changes_in_time(std::string_view key) {
  return has(key) && value(key)->as_list() != nullptr;
}

std::optional<double> KeyReader::maybe_course(std::string_view key) {
  if (!changes_in_time(key)) {
    const toml::Value* said = value(key);
    return said != nullptr ? checked(key, *said) : default_number(key);
  }
  reading_.changes_in_time = reading_.goes_by_clock = true;
  const auto course = vectors_of(rows<2>(key, "course", 1));
  if (course.empty()) {
    if (value(key)->as_list()->empty())
      problem(key, fmt::format("'{}' has no row [seconds, value]", key));
    return std::nullopt;
  }
  for (size_t i = 1; i < course.size(); ++i)
    if (!(course[i].x > course[i - 1].x)) {
      problem(key, fmt::format("the times of '{}' must ascend: {:g} s follows {:g} s", key,
                               course[i].x, course[i - 1].x));
      return std::nullopt;
    }
  const auto now = reading_.time_s();
  if (!now) {
    problem(key, fmt::format("'{}' changes in time, and no time is said: give --at 60s, or add "
                             "[time] with 'from', 'to' and 'step'",
                             key));
    return std::nullopt;
  }
  if (*now < course.front().x || *now > course.back().x) {
    problem(key, fmt::format("'{}' is known from {:g} to {:g} s, and the time is {:g} s", key,
                             course.front().x, course.back().x, *now));
    return std::nullopt;
  }
  const auto next = std::find_if(course.begin(), course.end(),
                                 [&](const glm::dvec2& row) { return row.x >= *now; });
  if (next->x == *now) return next->y;
  const glm::dvec2 a = *(next - 1), b = *next;
  return a.y + (b.y - a.y) * (*now - a.x) / (b.x - a.x);
}

double KeyReader::course(std::string_view key) {
  return maybe_course(key).value_or(some_number(key));
}

KeyReader kind_reader(const toml::Table& table, const std::string& base, std::string_view key,
                      SceneReading& reading, std::string& kind) {
  const toml::Schema& schema = scene_schema();
  kind = toml::chosen_kind(table, schema, base, key);
  KeyReader keys(table, toml::specs_of_kind(schema, base, key, kind), reading);
  if (kind.empty()) keys.maybe_choice(key);
  return keys;
}

std::optional<double> duration_s(KeyReader& keys) {
  constexpr double hour_s = 3600;
  const auto hours = keys.maybe_number("duration_h");
  return hours ? std::optional(*hours * hour_s) : std::nullopt;
}

std::string read_name(KeyReader& keys, std::string_view kind) {
  const auto name = keys.maybe_text("name");
  if (!name) {
    // The name is unknown, so no reference to this kind can be called wrong.
    keys.reading().incomplete = true;
    return "";
  }
  keys.reading().declare(kind, *name, keys.place("name"));
  return *name;
}

}  // namespace luxodus
