// Pieces of the medium reader that stand in files of their own.
#pragma once

#include <string>
#include <vector>

#include "scenes/formats/scene_file/key_reader.hpp"

namespace luxodus {

/// Specs of a [[medium]] of this kind and body; of all of them where the word is "".
std::vector<std::string> medium_specs(const std::string& kind, const std::string& body);
/// `position`, `rotate_deg`, `emission` of a bounded medium or a data set.
void read_placed(KeyReader& keys, Medium& medium);
/// Quadric and bounds of the body of this kind.
void read_body(KeyReader& keys, const std::string& body, Medium& medium);
/// Arrays, box and optics of a data set.
void read_data_set(KeyReader& keys, Medium& medium);
/// Of a medium with this name and place: the data sets that a fire simulation becomes, added to the
/// scene.
void read_fire_medium(KeyReader& keys, Medium medium);

}  // namespace luxodus
