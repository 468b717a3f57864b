#include "scenes/formats/scene_file/read_colours.hpp"

#include <algorithm>
#include <array>

#include "scenes/formats/scene_file/read_spectrum.hpp"
#include "scenes/light/signs/sign_colours.hpp"

namespace luxodus {

namespace {

constexpr std::array white_green_keys{"mains_white",       "mains_green",      "emergency_white",
                                      "emergency_green",   "white_spectrum",   "green_spectrum",
                                      "white_reflectance", "green_reflectance"};
/// Results of a sign stand under the names of its colours, beside these.
constexpr std::array<std::string_view, 7> other_names{"other",  "sign",   "observer", "surround",
                                                      "legend", "ground", "distance"};

/// An externally lit sign has no luminance of its own; the others say it.
void check_luminance_keys(KeyReader& keys, const Sign& sign, const std::vector<const char*>& mains,
                          const std::vector<const char*>& emergency) {
  const auto needed = [&](const std::vector<const char*>& names) {
    for (const char* key : names)
      if (!keys.has(key))
        keys.problem("the key '" + std::string(key) + "' is missing: a sign with lighting = \"" +
                     (sign.lighting == SignLighting::internal ? "internal" : "photoluminescent") +
                     "\" shines of itself");
  };
  if (sign.lighting != SignLighting::external) {
    if (sign.lighting == SignLighting::internal) needed(mains);
    needed(emergency);
    return;
  }
  for (const auto* names : {&mains, &emergency})
    for (const char* key : *names)
      if (keys.has(key))
        return keys.problem(key, "'" + std::string(key) +
                                     "' is given, but an externally lit sign shows only "
                                     "what falls on it");
}

void read_white_and_green(KeyReader& keys, Sign& sign) {
  const auto mains_white = keys.maybe_number("mains_white");
  const auto mains_green = keys.maybe_number("mains_green");
  const auto emergency_white = keys.maybe_number("emergency_white");
  const auto emergency_green = keys.maybe_number("emergency_green");
  sign.colours = white_and_green({mains_white.value_or(0), mains_green.value_or(0)},
                                 {emergency_white.value_or(0), emergency_green.value_or(0)});
  FaceColour &white = sign.colours[0], &green = sign.colours[1];
  white.shape = emission_shape(keys, "white_spectrum");
  green.shape = keys.has("green_spectrum") ? emission_shape(keys, "green_spectrum")
                                           : film_before(white.shape, green.drawn);
  white.reflectance = property(keys, "white_reflectance");
  green.reflectance = property(keys, "green_reflectance");
  check_luminance_keys(keys, sign, {"mains_white", "mains_green"},
                       {"emergency_white", "emergency_green"});
}

Srgb read_drawn(KeyReader& keys, const std::string& name) {
  const auto text = keys.maybe_text("drawn");
  const auto usual = drawn_as(name);
  if (!text) {
    if (!usual && keys.clean())
      keys.problem("name", "the colour \"" + name +
                               "\" needs 'drawn', how drawings print it, such as \"#9B2423\"; "
                               "white, green, red, blue, yellow and black are known");
    return usual.value_or(Srgb{});
  }
  const auto drawn = from_hex_text(*text);
  if (!drawn)
    keys.problem("drawn",
                 "'drawn' is a colour like \"#9B2423\": red, green, blue, two digits each");
  return drawn.value_or(Srgb{});
}

void check_name(KeyReader& keys, const std::string& name, const std::vector<FaceColour>& before) {
  const bool plain = std::all_of(name.begin(), name.end(), [](char c) { return c != '_'; });
  if (!plain || std::find(other_names.begin(), other_names.end(), name) != other_names.end())
    keys.problem("name",
                 "\"" + name + "\" cannot name a colour: results use it for something else");
  if (colour_named(before, name))
    keys.problem("name", "the colour \"" + name + "\" is there twice");
}

FaceColour read_colour(const toml::Table& table, const Sign& sign, SceneReading& reading) {
  KeyReader keys(table, {"sign.colours"}, reading);
  FaceColour colour;
  colour.name = keys.text("name");
  check_name(keys, colour.name, sign.colours);
  colour.drawn = read_drawn(keys, colour.name);
  colour.mains_cd_m2 = keys.maybe_number("mains").value_or(0);
  colour.emergency_cd_m2 = keys.maybe_number("emergency").value_or(0);
  const Spectrum lamp = emission_shape(keys, "spectrum");
  const bool white = safety_name_of(colour.drawn) == "white";
  colour.shape = keys.has("spectrum") || white ? lamp : film_before(lamp, colour.drawn);
  colour.reflectance = maybe_property(keys, "reflectance").value_or(paint_of(colour.drawn));
  check_luminance_keys(keys, sign, {"mains"}, {"emergency"});
  for (const FaceColour& other : sign.colours)
    if (keys.clean() &&
        colour_difference(colour.drawn, other.drawn) < limits::min_sign_colour_distance)
      keys.problem("drawn", "\"" + colour.name + "\" (" + hex_text(colour.drawn) + ") and \"" +
                                other.name + "\" (" + hex_text(other.drawn) +
                                ") are drawn so alike that drawings cannot tell them apart");
  return colour;
}

}  // namespace

bool names_its_colours(const KeyReader& keys) {
  return keys.has("colours");
}

void read_colours(KeyReader& keys, Sign& sign) {
  if (!names_its_colours(keys)) return read_white_and_green(keys, sign);
  for (const char* key : white_green_keys)
    if (keys.has(key))
      keys.problem(key, "'" + std::string(key) +
                            "' belongs to a sign of white and green without [[sign.colours]]");
  sign.colours.clear();
  for (const toml::Table* table : keys.tables("colours", limits::max_face_colours))
    sign.colours.push_back(read_colour(*table, sign, keys.reading()));
  if (sign.colours.empty()) {
    keys.problem("colours", "a sign needs a colour at least");
    sign.colours = white_and_green();
  }
}

std::optional<ColourIndex> colour_of_key(KeyReader& keys, std::string_view key, const Sign& sign) {
  const auto name = keys.maybe_text(key);
  if (!name) return std::nullopt;
  const auto found = colour_named(sign.colours, *name);
  if (!found)
    keys.problem(key, "'" + std::string(key) + "' is \"" + *name +
                          "\", and the sign's colours are " + colour_names(sign.colours) +
                          (names_its_colours(keys) ? "" : "; state others in [[sign.colours]]"));
  return found;
}

}  // namespace luxodus
