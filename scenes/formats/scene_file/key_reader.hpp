// Reads a scene's tables: adds to runtime/toml what only scenes have, points and directions as
// vectors, and the scene being read. Single-threaded; holds references to the parsed document and
// to the SceneReading.
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/toml/table_reader.hpp"
#include "scenes/formats/scene_file/scene_reading.hpp"
#include "scenes/formats/scene_file/scene_schema.hpp"

namespace luxodus {

class KeyReader : public toml::TableReader {
 public:
  /// `specs` are names of scene_schema().
  KeyReader(const toml::Table& table, const std::vector<std::string>& specs, SceneReading& reading);

  SceneReading& reading() { return reading_; }

  glm::dvec2 pair(std::string_view key);
  std::optional<glm::dvec2> maybe_pair(std::string_view key);
  glm::dvec3 point(std::string_view key);
  std::optional<glm::dvec3> maybe_point(std::string_view key);
  /// A vector that is not zero, made unit length.
  glm::dvec3 direction(std::string_view key);
  std::optional<glm::dvec3> maybe_direction(std::string_view key);
  /// Rows of two numbers; the range holds for the second.
  std::vector<glm::dvec2> pairs(std::string_view key);
  /// Rows [x, y] of points; the range holds for both.
  std::vector<glm::dvec2> corners(std::string_view key);
  /// Rows [x, y, z] of points; the range holds for all three.
  std::vector<glm::dvec3> points(std::string_view key);
  /// A number, or rows [seconds, value], interpolated linearly at the time of the state. A problem
  /// where that time is not given, or lies outside the rows.
  double course(std::string_view key);
  std::optional<double> maybe_course(std::string_view key);
  /// Whether the key is written as rows.
  bool changes_in_time(std::string_view key);
  /// One number for all three axes, or three.
  glm::dvec3 scale(std::string_view key);

 private:
  SceneReading& reading_;
};

/// A reader with the keys of `base` and of `base.KIND`, where KIND is the choice `key`. A missing
/// or wrong choice is reported, and the keys of all kinds are then known, so that none is called
/// unknown. Fills in `kind`.
KeyReader kind_reader(const toml::Table& table, const std::string& base, std::string_view key,
                      SceneReading& reading, std::string& kind);

/// The key `duration_h`, in seconds.
std::optional<double> duration_s(KeyReader& keys);

/// Reads a name and declares it for its kind. An absent name is a problem; "" is then returned.
std::string read_name(KeyReader& keys, std::string_view kind);

}  // namespace luxodus
