// Draws a grid of values so that people can read numbers from it: false colours
// (light_colours.hpp), a scale bar with its unit, axes in metres, labelled contour lines at given
// values, a mark at the smallest value, and minimum, mean and maximum as text. Values are shown as
// computed; between cell centres they are interpolated (can be turned off). Pure; any thread.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "runtime/core/result.hpp"
#include "scenes/formats/images/write_image.hpp"

namespace luxodus {

namespace limits {
inline constexpr int max_grid_edge = 8192;  // cells
inline constexpr uint64_t max_drawn_cells = uint64_t{1} << 24;
inline constexpr size_t max_contours = 32;
inline constexpr int min_picture_edge_px = 480;
inline constexpr int max_picture_edge_px = 8192;
}  // namespace limits

enum class ColourScale {
  automatic,  // logarithmic where the largest value is over 15 times the smallest above zero
  linear,
  logarithmic,  // values at or below zero take the lowest colour
};

struct FalseColourPicture {
  std::string title;          // above the picture
  std::string subtitle;       // one line below the title: scene, scenario
  std::string quantity;       // "Illuminance"
  std::string unit;           // "lx"
  std::string label_u = "x";  // names of the axes; their unit is added
  std::string label_v = "y";
  std::string length_unit = "m";  // "px" for a grid that is a picture; unit of the lengths below
  int cells_u = 0;
  int cells_v = 0;
  std::vector<double>
      values;             // values[v * cells_u + u]; row 0 is drawn lowest; not finite: no value
  double origin_u_m = 0;  // coordinate of the grid's corner on each axis
  double origin_v_m = 0;
  double length_u_m = 1;
  double length_v_m = 1;
  std::vector<double> contours;
  ColourScale scale = ColourScale::automatic;
  std::optional<double> scale_low;  // ends of the scale; automatic where not given
  std::optional<double> scale_high;
  bool smooth = true;  // interpolate between cell centres
  bool mark_minimum = true;
  int width_px = 1600;
  std::vector<std::string> notes;  // lines under the picture: method, particles, standard error
  std::vector<ImageText> text;     // metadata of the PNG; Title and Description are always set
};

/// Errors: a grid whose sizes do not match, lengths that are not positive, a scale whose ends are
/// not ascending.
Result<PngImage> draw_false_colour(const FalseColourPicture& picture, const SourcePlace& place);
/// Errors: as draw_false_colour and write_png.
Result<void> write_false_colour_png(const std::filesystem::path& path,
                                    const FalseColourPicture& picture);

}  // namespace luxodus
