// The light on the surfaces that a picture shows: what an eye in front of them takes as white. Pure
// functions; any thread.
#pragma once

#include <optional>

#include "actors/results/pictures/pictures.hpp"
#include "scenes/light/optics/chromaticity.hpp"

namespace luxodus {

/// A white surface in the light of the surfaces in view: the medians over pixels of its luminance Y
/// [cd/m2] and of its X/Y and Z/Y. What pixels get straight from lamps, signs and flames is left
/// out, as are black surfaces and those of which smoke hides more than half. A flame lights few of
/// many pixels, so medians follow the room. None without a lit surface.
std::optional<Xyz> light_on_surfaces(const TracedPicture& traced);

}  // namespace luxodus
