#include "scenes/formats/fds_input/colours.hpp"

#include <algorithm>
#include <charconv>
#include <iterator>

namespace luxodus::fds_input {

namespace {

struct NamedColour {
  std::string_view name;
  uint8_t red, green, blue;
};

/// Sorted by name. Values: FDS User's Guide, table of colours; most are those of X11.
constexpr NamedColour named_colours[] = {
    {"ALICE BLUE", 240, 248, 255},
    {"ANTIQUE WHITE", 250, 235, 215},
    {"AQUAMARINE", 127, 255, 212},
    {"AZURE", 240, 255, 255},
    {"BANANA", 227, 207, 87},
    {"BEIGE", 245, 245, 220},
    {"BISQUE", 255, 228, 196},
    {"BLACK", 0, 0, 0},
    {"BLANCHED ALMOND", 255, 235, 205},
    {"BLUE", 0, 0, 255},
    {"BLUE VIOLET", 138, 43, 226},
    {"BRICK", 156, 102, 31},
    {"BROWN", 165, 42, 42},
    {"BURLY WOOD", 222, 184, 135},
    {"BURNT ORANGE", 204, 85, 0},
    {"BURNT SIENNA", 138, 54, 15},
    {"BURNT UMBER", 138, 51, 36},
    {"CADET BLUE", 95, 158, 160},
    {"CADMIUM ORANGE", 255, 97, 3},
    {"CADMIUM YELLOW", 255, 153, 18},
    {"CARROT", 237, 145, 33},
    {"CHARTREUSE", 127, 255, 0},
    {"CHOCOLATE", 210, 105, 30},
    {"COBALT", 61, 89, 171},
    {"COBALT GREEN", 61, 145, 64},
    {"COLD GREY", 128, 138, 135},
    {"CORAL", 255, 127, 80},
    {"CORNFLOWER BLUE", 100, 149, 237},
    {"CORNSILK", 255, 248, 220},
    {"CRIMSON", 220, 20, 60},
    {"CYAN", 0, 255, 255},
    {"DARK GOLDENROD", 184, 134, 11},
    {"DARK GRAY", 169, 169, 169},
    {"DARK GREEN", 0, 100, 0},
    {"DARK KHAKI", 189, 183, 107},
    {"DARK OLIVE GREEN", 85, 107, 47},
    {"DARK ORANGE", 255, 140, 0},
    {"DARK ORCHID", 153, 50, 204},
    {"DARK SALMON", 233, 150, 122},
    {"DARK SEA GREEN", 143, 188, 143},
    {"DARK SLATE BLUE", 72, 61, 139},
    {"DARK SLATE GRAY", 47, 79, 79},
    {"DARK TURQUOISE", 0, 206, 209},
    {"DARK VIOLET", 148, 0, 211},
    {"DEEP PINK", 255, 20, 147},
    {"DEEP SKYBLUE", 0, 191, 255},
    {"DIM GRAY", 105, 105, 105},
    {"DODGERBLUE", 30, 144, 255},
    {"EGGSHELL", 252, 230, 201},
    {"EMERALD GREEN", 0, 201, 87},
    {"FIREBRICK", 178, 34, 34},
    {"FLESH", 255, 125, 64},
    {"FLORAL WHITE", 255, 250, 240},
    {"FOREST GREEN", 34, 139, 34},
    {"GAINSBORO", 220, 220, 220},
    {"GHOST WHITE", 248, 248, 255},
    {"GOLD", 255, 215, 0},
    {"GOLDENROD", 218, 165, 32},
    {"GRAY", 128, 128, 128},
    {"GREEN", 0, 255, 0},
    {"GREEN YELLOW", 173, 255, 47},
    {"HONEYDEW", 240, 255, 240},
    {"HOT PINK", 255, 105, 180},
    {"INDIAN RED", 205, 92, 92},
    {"INDIGO", 75, 0, 130},
    {"IVORY", 255, 255, 240},
    {"IVORY BLACK", 41, 36, 33},
    {"KELLY GREEN", 0, 128, 0},
    {"KHAKI", 240, 230, 140},
    {"LAVENDER", 230, 230, 250},
    {"LAVENDER BLUSH", 255, 240, 245},
    {"LAWN GREEN", 124, 252, 0},
    {"LEMON CHIFFON", 255, 250, 205},
    {"LIGHT BLUE", 173, 216, 230},
    {"LIGHT CORAL", 240, 128, 128},
    {"LIGHT CYAN", 224, 255, 255},
    {"LIGHT GOLDENROD", 255, 236, 139},
    {"LIGHT GOLDENROD YELLOW", 250, 250, 210},
    {"LIGHT GREY", 211, 211, 211},
    {"LIGHT PINK", 255, 182, 193},
    {"LIGHT SALMON", 255, 160, 122},
    {"LIGHT SEA GREEN", 32, 178, 170},
    {"LIGHT SKY BLUE", 135, 206, 250},
    {"LIGHT SLATE BLUE", 132, 112, 255},
    {"LIGHT SLATE GRAY", 119, 136, 153},
    {"LIGHT STEEL BLUE", 176, 196, 222},
    {"LIME GREEN", 50, 205, 50},
    {"LINEN", 250, 240, 230},
    {"MAGENTA", 255, 0, 255},
    {"MANGANESE BLUE", 3, 168, 158},
    {"MAROON", 128, 0, 0},
    {"MEDIUM ORCHID", 186, 85, 211},
    {"MEDIUM PURPLE", 147, 112, 219},
    {"MEDIUM SEA GREEN", 60, 179, 113},
    {"MEDIUM SLATE BLUE", 123, 104, 238},
    {"MEDIUM SPRING GREEN", 0, 250, 154},
    {"MEDIUM TURQUOISE", 72, 209, 204},
    {"MEDIUM VIOLET RED", 199, 21, 133},
    {"MELON", 227, 168, 105},
    {"MIDNIGHT BLUE", 25, 25, 112},
    {"MINT", 189, 252, 201},
    {"MINT CREAM", 245, 255, 250},
    {"MISTY ROSE", 255, 228, 225},
    {"MOCCASIN", 255, 228, 181},
    {"NAVAJO WHITE", 255, 222, 173},
    {"NAVY", 0, 0, 128},
    {"OLD LACE", 253, 245, 230},
    {"OLIVE", 128, 128, 0},
    {"OLIVE DRAB", 192, 255, 62},
    {"ORANGE", 255, 128, 0},
    {"ORANGE RED", 255, 69, 0},
    {"ORCHID", 218, 112, 214},
    {"PALE GOLDENROD", 238, 232, 170},
    {"PALE GREEN", 152, 251, 152},
    {"PALE TURQUOISE", 187, 255, 255},
    {"PALE VIOLET RED", 219, 112, 147},
    {"PAPAYA WHIP", 255, 239, 213},
    {"PEACH PUFF", 255, 218, 185},
    {"PEACOCK", 51, 161, 201},
    {"PINK", 255, 192, 203},
    {"PLUM", 221, 160, 221},
    {"POWDER BLUE", 176, 224, 230},
    {"PURPLE", 128, 0, 128},
    {"RASPBERRY", 135, 38, 87},
    {"RAW SIENNA", 199, 97, 20},
    {"RED", 255, 0, 0},
    {"ROSY BROWN", 188, 143, 143},
    {"ROYAL BLUE", 65, 105, 225},
    {"SALMON", 250, 128, 114},
    {"SANDY BROWN", 244, 164, 96},
    {"SAP GREEN", 48, 128, 20},
    {"SEA GREEN", 84, 255, 159},
    {"SEASHELL", 255, 245, 238},
    {"SEPIA", 94, 38, 18},
    {"SIENNA", 160, 82, 45},
    {"SILVER", 192, 192, 192},
    {"SKY BLUE", 135, 206, 235},
    {"SLATE BLUE", 106, 90, 205},
    {"SLATE GRAY", 112, 128, 144},
    {"SNOW", 255, 250, 250},
    {"SPRING GREEN", 0, 255, 127},
    {"STEEL BLUE", 70, 130, 180},
    {"TAN", 210, 180, 140},
    {"TEAL", 0, 128, 128},
    {"THISTLE", 216, 191, 216},
    {"TOMATO", 255, 99, 71},
    {"TURQUOISE", 64, 224, 208},
    {"TURQUOISE BLUE", 0, 199, 140},
    {"VIOLET", 238, 130, 238},
    {"VIOLET RED", 208, 32, 144},
    {"WARM GREY", 128, 128, 105},
    {"WHEAT", 245, 222, 179},
    {"WHITE", 255, 255, 255},
    {"WHITE SMOKE", 245, 245, 245},
    {"YELLOW", 255, 255, 0},
};

const NamedColour* colour_of_name(std::string_view name) {
  const auto at = std::lower_bound(
      std::begin(named_colours), std::end(named_colours), name,
      [](const NamedColour& colour, std::string_view wanted) { return colour.name < wanted; });
  return at != std::end(named_colours) && at->name == name ? at : nullptr;
}

glm::dvec3 rgb_of(const NamedColour& colour) {
  return glm::dvec3(colour.red, colour.green, colour.blue) / 255.0;
}

}  // namespace

std::optional<glm::dvec3> colour_rgb(std::string_view name) {
  if (const NamedColour* colour = colour_of_name(name)) return rgb_of(*colour);
  const size_t blank = name.rfind(' ');
  if (blank == std::string_view::npos) return std::nullopt;
  int number = 0;
  const char* const last = name.data() + name.size();
  const auto [end, error] = std::from_chars(name.data() + blank + 1, last, number);
  if (error != std::errc() || end != last || number < 1) return std::nullopt;
  const std::string_view base = name.substr(0, blank);
  if (base == "GRAY" || base == "GREY")  // per cent of white
    return number <= 100 ? std::optional(glm::dvec3(number / 100.0)) : std::nullopt;
  const NamedColour* colour = colour_of_name(base);
  constexpr double shades[] = {1, 0.932, 0.804, 0.548};  // of X11
  if (colour == nullptr || number > static_cast<int>(std::size(shades))) return std::nullopt;
  return rgb_of(*colour) * shades[number - 1];
}

}  // namespace luxodus::fds_input
