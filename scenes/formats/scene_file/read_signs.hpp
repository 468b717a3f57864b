// Reads what signs, types of signs and signs of a design share: the face, its luminance, and the
// routes that a sign belongs to. Single-threaded.
#pragma once

#include "scenes/formats/scene_file/key_reader.hpp"

namespace luxodus {

/// Reads all of a sign except its name, place and routes.
void read_sign_itself(KeyReader& keys, Sign& sign);

/// Reads the tables `leads_to`. Whether the routes exist is checked when all of them are read.
void read_leads_to(KeyReader& keys, Sign& sign);

SignArrow arrow_named(const std::string& word);

/// The generic sign of a design, a white legend on green, internally lit. `name` and place are
/// kept.
void make_generic_sign(Sign& sign);

}  // namespace luxodus
