// The readers of the tables of a scene file, one per kind of table, called by scene_file.cpp in the
// order in which names are needed: materials, objects and imports, emitters, media, signs,
// measurements, assessments, scenarios. Each adds to reading.scene and reports every mistake.
// Single-threaded.
#pragma once

#include "scenes/formats/scene_file/key_reader.hpp"

namespace luxodus {

void read_run(const toml::Table& table, SceneReading& reading);
void read_material(const toml::Table& table, SceneReading& reading);
void read_object(const toml::Table& table, SceneReading& reading);
void read_import(const toml::Table& table, SceneReading& reading);
void read_luminaire_type(const toml::Table& table, SceneReading& reading);
void read_luminaire(const toml::Table& table, SceneReading& reading);
void read_emitter(const toml::Table& table, SceneReading& reading);
void read_sign_type(const toml::Table& table, SceneReading& reading);
void read_sign(const toml::Table& table, SceneReading& reading);
void read_medium(const toml::Table& table, SceneReading& reading);
void read_plane(const toml::Table& table, SceneReading& reading);
void read_probe(const toml::Table& table, SceneReading& reading);
void read_surface_group(const toml::Table& table, SceneReading& reading);
void read_volume_group(const toml::Table& table, SceneReading& reading);
void read_counting_plane(const toml::Table& table, SceneReading& reading);
void read_observer(const toml::Table& table, SceneReading& reading);
void read_camera(const toml::Table& table, SceneReading& reading);
void read_assessment(const toml::Table& table, SceneReading& reading);
void read_project(const toml::Table& table, SceneReading& reading);
/// Warns of a project without a name.
void check_project(SceneReading& reading);
void read_backdrop(const toml::Table& table, SceneReading& reading);
void read_route(const toml::Table& table, SceneReading& reading);
void read_open_area(const toml::Table& table, SceneReading& reading);
void read_task_area(const toml::Table& table, SceneReading& reading);
void read_emphasis(const toml::Table& table, SceneReading& reading);
void read_room(const toml::Table& table, SceneReading& reading);
/// Reports rooms of one storey that overlap.
void check_rooms(SceneReading& reading);
/// Adds the keys of this table to `design`.
void read_design(const toml::Table& table, SceneReading& reading, DesignSettings& design);
/// Gives the scene its design, with default types where none are stated.
void complete_design(SceneReading& reading, DesignSettings design);
void read_people(const toml::Table& table, SceneReading& reading);
/// Everybody who is in the building at a time as the text of [[object]] tables; reports files of
/// trajectories that cannot be read.
std::string people_as_objects(SceneReading& reading, double time_s);
void read_time(const toml::Table& table, SceneReading& reading);
void read_scenario(const toml::Table& table, SceneReading& reading);
void read_change(const toml::Table& table, SceneReading& reading);

}  // namespace luxodus
