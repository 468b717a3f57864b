// The readers of the tables of a scene file, one per kind of table, called by scene_file.cpp in the
// order in which names are needed: materials, objects and imports, emitters, media, signs,
// measurements, what is assessed, scenarios. Each adds to reading.scene and reports every mistake.
// Single-threaded.
#pragma once

#include <toml++/toml.h>

#include "scenes/scene_file/key_reader.hpp"

namespace luxodus {

void read_run(const toml::table& table, SceneReading& reading);
void read_material(const toml::table& table, SceneReading& reading);
void read_object(const toml::table& table, SceneReading& reading);
void read_import(const toml::table& table, SceneReading& reading);
void read_luminaire(const toml::table& table, SceneReading& reading);
void read_emitter(const toml::table& table, SceneReading& reading);
void read_sign(const toml::table& table, SceneReading& reading);
void read_medium(const toml::table& table, SceneReading& reading);
void read_plane(const toml::table& table, SceneReading& reading);
void read_probe(const toml::table& table, SceneReading& reading);
void read_surface_group(const toml::table& table, SceneReading& reading);
void read_volume_group(const toml::table& table, SceneReading& reading);
void read_counting_plane(const toml::table& table, SceneReading& reading);
void read_observer(const toml::table& table, SceneReading& reading);
void read_camera(const toml::table& table, SceneReading& reading);
void read_assessment(const toml::table& table, SceneReading& reading);
void read_project(const toml::table& table, SceneReading& reading);
void read_route(const toml::table& table, SceneReading& reading);
void read_open_area(const toml::table& table, SceneReading& reading);
void read_task_area(const toml::table& table, SceneReading& reading);
void read_emphasis(const toml::table& table, SceneReading& reading);
void read_scenario(const toml::table& table, SceneReading& reading);
void read_change(const toml::table& table, SceneReading& reading);

}  // namespace luxodus
