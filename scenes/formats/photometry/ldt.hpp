// EULUMDAT (.ldt) reader: Stockmar 1990 and 1998, with the variations of real files: all five
// symmetries, unequal angles, several lamp sets (alternatives, of which one is chosen), negative
// lamp counts for absolute photometry, decimal commas, quoted fields, Latin-1 or UTF-8. Pure
// function of the text; any thread.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "runtime/core/result.hpp"
#include "scenes/formats/photometry/photometric_file.hpp"

namespace luxodus {

/// Reads the bytes of an EULUMDAT file. `file` names it in messages; `lamp_set`: the number of the
/// lamp set that burns, from 1, needed where the file has several.
/// Intensities [cd/klm] x conversion factor x flux of the lamp set / 1000 become the web's candela.
/// Errors: one Problem with file and line.
Result<PhotometricFile> read_ldt(std::string_view bytes, const std::string& file,
                                 std::optional<int> lamp_set = {});

}  // namespace luxodus
