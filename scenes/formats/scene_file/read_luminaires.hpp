// Reads what luminaires of a scene and types of a design share. Single-threaded.
#pragma once

#include "scenes/formats/scene_file/key_reader.hpp"

namespace luxodus {

/// Reads `file`, `point_source`, the keys of operation and `body_material` into an emitter that
/// already has a place and a name. Every mistake is reported.
void read_photometric_light(KeyReader& keys, Emitter& e);

/// Numbers the bodies that objects are parts of by `body_of`, in the objects and in the emitters.
/// A problem where a name is no luminaire, or bodies of one luminaire name different others.
/// Requires: objects and luminaires are read.
void resolve_bodies(SceneReading& reading);

}  // namespace luxodus
