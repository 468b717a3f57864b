// Reads spectra: properties (reflectances, albedos, transmittances) and shapes of emission.
// README.md lists the forms. Plain functions; single-threaded like the KeyReader.
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <string_view>
#include <vector>

#include "scenes/formats/scene_file/key_reader.hpp"
#include "scenes/light/optics/spectrum.hpp"

namespace luxodus {

/// A property within the key's range. Nothing where the key is wrong, or absent without a default.
std::optional<Spectrum> maybe_property(KeyReader& keys, std::string_view key);
/// As above; a value within the range where it gives nothing.
Spectrum property(KeyReader& keys, std::string_view key);

/// A shape of emission, integral 1 over 380..780 nm.
Spectrum emission_shape(KeyReader& keys, std::string_view key);

/// The property that is linear between the rows (nm, value) and constant outside them.
Spectrum spectrum_through(const std::vector<glm::dvec2>& rows);
/// The emission that is linear between the rows and zero outside them, averaged over the 5 nm
/// around each sample, so that lines narrower than the grid keep their power.
Spectrum emission_through(const std::vector<glm::dvec2>& rows);

}  // namespace luxodus
