// What several luminaires or signs have in common: a table that they name by `type`.
#pragma once

#include "scenes/formats/scene_file/key_reader.hpp"

namespace luxodus {

/// The table with what its type says, where it names one; its own keys win. A type that is not
/// there is a problem. `kind`: "luminaire_type", "sign_type".
toml::Table with_type(const toml::Table& table, const std::string& kind, SceneReading& reading);

}  // namespace luxodus
