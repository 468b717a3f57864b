// Writes the files of a camera's picture: light, errors and features (OpenEXR), and pictures for
// display (PNG). Any thread.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "actors/results/pictures/pictures.hpp"
#include "actors/results/pictures/white_balance.hpp"
#include "scenes/formats/images/write_image.hpp"
#include "scenes/light/optics/chromaticity.hpp"

namespace luxodus {

/// A picture with the content of all its files.
struct ShownView {
  /// Filters it, if it has enough paths. `options`: whether PNG files show traced light, and for
  /// which eye and monitor.
  ShownView(TracedPicture picture, int paths_per_pixel, const PictureOptions& options, int threads,
            const RegressionFilter& filter = {});

  /// The light that PNG files show.
  const XyzPicture& shown() const { return raw ? traced.light : filtered->light; }
  double error() const;  // error of that light; see relative_error

  TracedPicture traced;
  int paths;                             // per pixel
  std::optional<FilteredView> filtered;  // empty if there are too few paths
  bool raw;
  HumanTone human;
  PictureWhite white;
  ToneStyle tone;
  std::optional<double> flames_at_s;  // as in PictureOptions
  std::optional<Xyz> surfaces;        // the light on them, if that is white; none: none is lit
  std::optional<Exposure> exposure;   // of PNG files; nothing: the picture's own
};

/// "0.84,12,75": middle grey, white and the brightest sign [cd/m2], as `--exposure` takes them. The
/// text "Exposure" of plain PNG files.
std::string text_of(const Exposure& exposure);

/// In the order of `view_endings`.
enum class ViewFile : uint8_t { light, plain, human, luminance };
inline constexpr size_t view_file_count = 4;

/// Writes one file of a camera; `stem` is its path without ending. A luminance map that would be
/// too large is omitted (is_mapped). Errors: as write_exr and write_png.
Result<void> write_view_file(const std::filesystem::path& stem, ViewFile file, const LocalRun& run,
                             const Camera& camera, const ShownView& view);

/// What made a picture, from what.
std::vector<ImageText> texts_of(const LocalRun& run, const Camera& camera, const ShownView& view);
WhiteBalance white_balance_of(const LocalRun& run, const ShownView& view);
/// Luminance of the brightest face of a sign that a view shows [cd/m2]; 0: none.
double brightest_sign(const LocalRun& run, const Camera& camera, const ShownView& view);
/// The same, or that of the brightest steady flame (flames_in_view.hpp): plain pictures show
/// neither brighter than sign_level.
double brightest_sign_or_flame(const LocalRun& run, const Camera& camera, const ShownView& view);
/// The plain picture of this light, as it looks in its white.
PngImage plain_png(const XyzPicture& balanced, const Exposure& exposure, ToneStyle tone,
                   const WhiteBalance& white, std::vector<ImageText> texts);

/// The exposure of the plain PNG file: for the brightest sign or flame in view, or for what is
/// bright below a cut.
Exposure shown_exposure(const LocalRun& run, const Camera& camera, const ShownView& view);

/// The pixels of PNG files, as seen by a camera or by an eye.
PngImage shown_image(bool human, const LocalRun& run, const Camera& camera, const ShownView& view);
/// The pixels of a picture of half the size, enlarged to the camera's.
PngImage first_image(bool human, const LocalRun& run, const Camera& camera, const ShownView& half);

/// Filter of first pictures, whose pixels are twice as wide: a fifth of the time of the usual one.
inline constexpr RegressionFilter first_filter{.window_px = 5, .patch_px = 2, .closely = false};

/// Writes shown_image(). Errors: as write_png.
Result<void> write_shown_png(const std::filesystem::path& file, bool human, const LocalRun& run,
                             const Camera& camera, const ShownView& view);

/// Writes only the plain picture, from one of half the size.
Result<void> write_first_view(const std::filesystem::path& stem, const LocalRun& run,
                              const Camera& camera, const ShownView& half);

}  // namespace luxodus
