// Reads what a report says about its project. Across included files each key is overridden
// separately.
#include "scenes/formats/images/logo.hpp"
#include "scenes/formats/scene_file/read_files.hpp"
#include "scenes/formats/scene_file/scene_readers.hpp"

namespace luxodus {

namespace {

/// A text, or a date as TOML writes one.
std::string read_date(KeyReader& keys) {
  const toml::Value* value = keys.value("date");
  const toml::Moment* moment = value ? value->as_moment() : nullptr;
  return moment && moment->is_date ? moment->text : keys.text("date");
}

}  // namespace

void read_project(const toml::Table& table, SceneReading& reading) {
  KeyReader keys(table, {"project"}, reading);
  ProjectSettings& p = reading.scene.project;
  p.place = keys.place();
  const std::pair<const char*, std::string*> texts[] = {
      {"name", &p.name},         {"client", &p.client},     {"address", &p.address},
      {"document", &p.document}, {"revision", &p.revision}, {"date", &p.date},
      {"author", &p.author},     {"checker", &p.checker}};
  for (const auto& [key, value] : texts) {
    if (!keys.has(key)) continue;
    *value = std::string_view(key) == "date" ? read_date(keys) : keys.text(key);
    if (value->size() > scene_limits::name_chars)
      keys.problem(key, "'" + std::string(key) + "' has more than " +
                            std::to_string(scene_limits::name_chars) + " characters; shorten it");
  }
  if (keys.has("north_deg")) p.north_deg = keys.number("north_deg");
  if (!keys.has("logo")) return;
  const auto path = keys.file("logo");
  if (!path || !take_hash(*path, keys.place("logo"), reading)) return;
  if (auto logo = read_logo(*path); !logo)
    take_problem(logo.problem(), keys.place("logo"), reading);
  else
    p.logo = path->string();
}

void check_project(SceneReading& reading) {
  const ProjectSettings& p = reading.scene.project;
  if (!p.place.file.empty() && p.name.empty())
    reading.warning(p.place,
                    "[project] has no 'name': reports and designs carry the title of the scene");
}

}  // namespace luxodus
