// The files of a camera's picture, from what was traced: light, errors and features (OpenEXR), and
// what people look at (PNG). Any thread.
#pragma once

#include <filesystem>
#include <optional>

#include "actors/results/pictures/pictures.hpp"
#include "scenes/formats/images/write_image.hpp"

namespace luxodus {

/// A picture with all that its files hold.
struct ShownView {
  /// Filters it, where it has the paths for that. `options`: whether PNG files show what was
  /// traced, and as what eye on what monitor.
  ShownView(TracedPicture picture, int paths_per_pixel, const PictureOptions& options, int threads,
            const RegressionFilter& filter = {});

  /// As PNG files show it.
  const XyzPicture& shown() const { return raw ? traced.light : filtered->light; }
  double error() const;  // of that; see relative_error

  TracedPicture traced;
  int paths;                             // per pixel
  std::optional<FilteredView> filtered;  // nothing where there are too few paths
  bool raw;
  HumanTone human;
};

/// In the order of `view_endings`.
enum class ViewFile : uint8_t { light, plain, human, luminance };
inline constexpr size_t view_file_count = 4;

/// Writes one file of a camera; `stem` is its path without ending. A luminance map is left out
/// where it is too large (is_mapped). Errors: as write_exr and write_png.
Result<void> write_view_file(const std::filesystem::path& stem, ViewFile file, const LocalRun& run,
                             const Camera& camera, const ShownView& view);

/// What PNG files show, as a camera takes it or as an eye sees it.
PngImage shown_image(bool human, const LocalRun& run, const Camera& camera, const ShownView& view);
/// The same of a picture of half the size, enlarged to the camera's.
PngImage first_image(bool human, const LocalRun& run, const Camera& camera, const ShownView& half);

/// Of first pictures, whose pixels are twice as wide: a fifth of the time of the usual one.
inline constexpr RegressionFilter first_filter{.window_px = 5, .patch_px = 2, .closely = false};

/// Writes shown_image(). Errors: as write_png.
Result<void> write_shown_png(const std::filesystem::path& file, bool human, const LocalRun& run,
                             const Camera& camera, const ShownView& view);

/// Writes the plain picture alone, from one of half the size.
Result<void> write_first_view(const std::filesystem::path& stem, const LocalRun& run,
                              const Camera& camera, const ShownView& half);

}  // namespace luxodus
