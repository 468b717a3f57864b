// What signs, types of signs and signs that a design may place have in common: the face, how bright
// it is, and the routes that a sign belongs to. Single-threaded.
#pragma once

#include "scenes/formats/scene_file/key_reader.hpp"

namespace luxodus {

/// All of a sign but its name, its place and its routes.
void read_sign_itself(KeyReader& keys, Sign& sign);

/// The tables `leads_to`. Whether the routes exist is seen when all of them are read.
void read_leads_to(KeyReader& keys, Sign& sign);

SignArrow arrow_named(const std::string& word);

/// The generic sign of a design, a white legend on green that is lit from within: `name` and the
/// place stay as they are.
void make_generic_sign(Sign& sign);

}  // namespace luxodus
