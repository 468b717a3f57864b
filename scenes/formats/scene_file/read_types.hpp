// Resolves `type`: a table of keys that several luminaires or signs share. Single-threaded.
#pragma once

#include "scenes/formats/scene_file/key_reader.hpp"

namespace luxodus {

/// The table combined with its type's keys, if it names one; its own keys win. An unknown type is a
/// problem. `kind`: "luminaire_type", "sign_type".
toml::Table with_type(const toml::Table& table, const std::string& kind, SceneReading& reading);

}  // namespace luxodus
