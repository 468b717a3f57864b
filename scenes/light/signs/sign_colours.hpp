// Colours of signs: the safety colours of ISO 3864, what a drawn colour counts as, which colours of
// a face are its legend and its ground, and what is done to the luminances of all of them. Not
// here: light (sign_light.hpp). Pure functions; any thread. Design: README.md of this folder.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/core/result.hpp"
#include "scenes/light/world/description.hpp"

namespace luxodus {

namespace limits {
/// Largest CIE 1976 colour difference of a pixel to a colour of the sign. White and green are 61
/// apart: 35 leaves no unclassified seam along their edges, and excludes mid grey, black and red.
inline constexpr double max_sign_colour_distance = 35.0;
/// Least difference between two colours of a sign. Closer ones are hard to tell apart in a drawing;
/// the closest two safety colours, blue and black, are 38 apart.
inline constexpr double min_sign_colour_distance = 10.0;
}  // namespace limits

using Srgb = std::array<uint8_t, 3>;

struct SafetyColour {
  std::string_view name;
  Srgb drawn;
};
/// ISO 3864 safety and contrast colours, as public drawings print the RAL colours of ISO 3864-4.
inline constexpr std::array safety_colours{
    SafetyColour{"white", {0xEC, 0xEC, 0xE7}},   // RAL 9003
    SafetyColour{"green", {0x23, 0x7F, 0x52}},   // RAL 6032
    SafetyColour{"red", {0x9B, 0x24, 0x23}},     // RAL 3001
    SafetyColour{"blue", {0x00, 0x53, 0x87}},    // RAL 5005
    SafetyColour{"yellow", {0xF9, 0xA8, 0x00}},  // RAL 1003
    SafetyColour{"black", {0x2B, 0x2B, 0x2C}},   // RAL 9004
};

/// CIE L*a*b* (D65, 2 degrees) of an sRGB colour. Law: CIE 15:2004, 8.2.1.
std::array<double, 3> lab_from_srgb(uint8_t r, uint8_t g, uint8_t b);

/// CIE 1976 colour difference of two sRGB colours.
double colour_difference(const Srgb& a, const Srgb& b);

/// How a colour is drawn that has this name; none if it is no safety colour.
std::optional<Srgb> drawn_as(std::string_view name);
/// The safety colour that is drawn most alike.
std::string_view safety_name_of(const Srgb& drawn);

/// "#9B2423"; the other way, none if it is not written so.
std::string hex_text(const Srgb& colour);
std::optional<Srgb> from_hex_text(std::string_view text);

/// The sRGB colour of a paint as it is drawn, and the light of a lamp of this shape behind a film
/// of that colour: beside the lamp's white it looks as drawn, whatever the lamp.
Spectrum paint_of(const Srgb& drawn);
Spectrum film_before(const Spectrum& lamp, const Srgb& drawn);

/// Place of the colour that has this name.
std::optional<ColourIndex> colour_named(const std::vector<FaceColour>& colours,
                                        std::string_view name);
/// Place of the first colour that counts as this safety colour.
std::optional<ColourIndex> safety_colour_of(const Sign& sign, std::string_view name);
/// "red, white".
std::string colour_names(const std::vector<FaceColour>& colours);

/// Sets legend and ground of a drawn face: as named, else the two colours that cover most of it.
/// The one with the smaller area is the legend, except for white and green, where white is. Errors,
/// each with what to write: a colour in both places, none that covers clearly more or less.
Result<void> choose_legend(SignFace& face, const std::vector<FaceColour>& colours,
                           std::optional<ColourIndex> legend, std::optional<ColourIndex> ground);

/// Largest luminance along the normal over its colours [cd/m2].
double max_mains_cd_m2(const Sign& sign);
double max_emergency_cd_m2(const Sign& sign);
/// Multiplies the luminances of all colours.
void scale_luminances(Sign& sign, double mains, double emergency);
inline void scale_luminances(Sign& sign, double factor) {
  scale_luminances(sign, factor, factor);
}

}  // namespace luxodus
