// Resolves `type`: a table of keys that several luminaires or signs share. Single-threaded.
#pragma once

#include <optional>

#include "scenes/formats/scene_file/key_reader.hpp"

namespace luxodus {

/// The table combined with its type's keys, if it names one; its own keys win. None if there is no
/// such type, which is a problem: then nothing but the name of the table is worth reading.
/// `kind`: "luminaire_type", "sign_type".
std::optional<toml::Table> with_type(const toml::Table& table, const std::string& kind,
                                     SceneReading& reading);

}  // namespace luxodus
