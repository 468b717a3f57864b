// The parts of the medium reader that stand in files of their own. Single-threaded like the
// KeyReader.
#pragma once

#include <string>
#include <vector>

#include "scenes/formats/scene_file/key_reader.hpp"

namespace luxodus {

/// Specs of a [[medium]] of this kind and body; of all of them for "".
std::vector<std::string> medium_specs(const std::string& kind, const std::string& body);
/// Warns of a stated `mass_extinction` that no smoke has, and says which unit was probably meant.
void warn_of_mass_extinction(KeyReader& keys);
/// Reads `position`, `rotate_deg`, `emission` of a bounded medium or a data set.
void read_placed(KeyReader& keys, Medium& medium);
/// Reads the quadric and bounds of the body of this kind.
void read_body(KeyReader& keys, const std::string& body, Medium& medium);
/// Reads the arrays, box and optics of a data set.
void read_data_set(KeyReader& keys, Medium& medium);
/// Adds to the scene the data sets of a fire simulation; `medium` gives their name and place.
void read_fire_medium(KeyReader& keys, Medium medium);

}  // namespace luxodus
