// Reads the colours of a sign: white and green by keys of their own, or tables [[sign.colours]].
// Single-threaded.
#pragma once

#include "scenes/formats/scene_file/key_reader.hpp"

namespace luxodus {

/// Whether the sign has tables [[sign.colours]]; else its colours are white and green.
bool names_its_colours(const KeyReader& keys);

/// Requires: sign.lighting is read.
void read_colours(KeyReader& keys, Sign& sign);

/// The colour that this key names; none where it is absent, or names none of the sign.
std::optional<ColourIndex> colour_of_key(KeyReader& keys, std::string_view key, const Sign& sign);

}  // namespace luxodus
