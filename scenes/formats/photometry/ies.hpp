// IES LM-63 reader: editions 1986 (no header line), 1991, 1995, 2002 and 2019, photometric types C
// and B, TILT from the file or from one beside it. Type A (head lamps) is rejected. Reads at most
// the one TILT file; otherwise a pure function of the text; any thread.
//
// Type C: horizontal angle = C, vertical angle = gamma of the luminaire frame.
// Type B: the polar axis is the luminaire's Y axis (its width); a vertical angle V turns about it
// from down (0) to +X (90), a horizontal angle H leans towards the axis, clockwise seen from above
// (LM-63 definitions), so that direction = (cos H sin V, -sin H, -cos H cos V). Directions that the
// file does not cover are dark; a type B file that starts at 0 is mirrored in that plane.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "runtime/core/result.hpp"
#include "scenes/formats/photometry/photometric_file.hpp"

namespace luxodus {

/// Reads the bytes of an IES file. `file` names it in messages; `folder` is where TILT=<file> is
/// looked for. Candela x multiplier x ballast factor (x ballast-lamp factor up to 1991) become the
/// web's candela. Errors: one Problem with file and line; decimal commas are one, since LM-63
/// allows commas between numbers.
Result<PhotometricFile> read_ies(std::string_view bytes, const std::string& file,
                                 const std::filesystem::path& folder);

}  // namespace luxodus
