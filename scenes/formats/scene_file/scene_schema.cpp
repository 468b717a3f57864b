#include "scenes/formats/scene_file/scene_schema.hpp"

#include <fmt/format.h>

#include "scenes/formats/scene_file/scene_reading.hpp"

namespace luxodus {

namespace {

/// Names become file names: control characters and path separators are not allowed.
bool is_good_name(std::string_view name) {
  if (name.empty() || name.size() > scene_limits::name_chars) return false;
  for (const char c : name) {
    const auto u = static_cast<unsigned char>(c);
    if (u < 0x20 || u == 0x7f || c == '/' || c == '\\' || c == '"') return false;
  }
  return name.front() != ' ' && name.back() != ' ' && name.front() != '.';
}

}  // namespace

const toml::Schema& scene_schema() {
  static const toml::Schema schema = [] {
    toml::Schema all;
    for (auto part : {geometry_schema(), light_schema(), measurement_schema(), scenario_schema(),
                      assessment_schema(), design_schema(), people_schema(), project_schema()}) {
      for (auto& table : part) all.tables.push_back(std::move(table));
    }
    all.text_rules.push_back(
        {"name", is_good_name,
         fmt::format("1 to {} characters without control characters, quotes, slashes, a leading "
                     "dot or outer spaces",
                     scene_limits::name_chars)});
    return all;
  }();
  return schema;
}

}  // namespace luxodus
