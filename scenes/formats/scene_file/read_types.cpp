#include "scenes/formats/scene_file/read_types.hpp"

#include "scenes/formats/scene_file/scene_readers.hpp"

namespace luxodus {

namespace {

void keep_type(const toml::Table& table, const std::string& kind, SceneReading& reading) {
  KeyReader keys(table, {kind}, reading);
  const std::string name = read_name(keys, kind);
  reading.types[kind + " " + name] = &table;
}

}  // namespace

void read_luminaire_type(const toml::Table& table, SceneReading& reading) {
  keep_type(table, "luminaire_type", reading);
}

void read_sign_type(const toml::Table& table, SceneReading& reading) {
  keep_type(table, "sign_type", reading);
}

std::optional<toml::Table> with_type(const toml::Table& table, const std::string& kind,
                                     SceneReading& reading) {
  const toml::Value* type = table.find("type");
  if (type == nullptr || type->as_text() == nullptr) return table;
  const auto at = reading.types.find(kind + " " + *type->as_text());
  if (at != reading.types.end()) return table.over(*at->second);
  reading.require(kind, *type->as_text(), type->place());
  return std::nullopt;
}

}  // namespace luxodus
