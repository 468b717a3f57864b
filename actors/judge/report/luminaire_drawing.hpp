// Drawings on the sheet of a luminaire: its polar curves, and its body seen from below. Sizes are
// in millimetres on paper. Pure functions; any thread.
#pragma once

#include <string>

#include "actors/judge/report/schedule.hpp"
#include "actors/judge/texts/texts.hpp"

namespace luxodus {

/// Intensities [cd/klm] in the planes C0-C180 and C90-C270, straight down at the bottom; "" if they
/// are not known.
std::string polar_svg(const SheetRecord& sheet, const Texts& texts);

/// The body as a box or a cylinder of its extents, with its luminous opening; "" if no extent is
/// known.
std::string body_svg(const LuminaireRecord& luminaire, const SheetRecord& sheet,
                     const Texts& texts);

}  // namespace luxodus
