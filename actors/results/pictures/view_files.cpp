// Turns traced pictures into files.
#include "actors/results/pictures/view_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <optional>

#include "actors/results/files/result_files.hpp"
#include "actors/results/formats/false_colour_png.hpp"
#include "actors/results/formats/plot_axis.hpp"
#include "actors/results/pictures/flames_in_view.hpp"
#include "actors/results/pictures/light_in_view.hpp"
#include "actors/results/pictures/signs_in_view.hpp"
#include "scenes/light/optics/chromaticity.hpp"
#include "scenes/light/transport/flame_moment.hpp"
#include "scenes/light/vision/tone.hpp"

namespace luxodus {

namespace {

/// Linear sRGB from XYZ, the inverse of the standard's matrix.
glm::dmat3 srgb_from_xyz() {
  glm::dmat3 xyz;
  for (int c = 0; c < 3; ++c) {
    std::array<double, 3> primary{};
    primary[static_cast<size_t>(c)] = 1;
    const Xyz column = xyz_from_linear_srgb(primary);
    xyz[c] = {column[0], column[1], column[2]};
  }
  return glm::inverse(xyz);
}

/// Light by tristimulus values, as linear sRGB and as scotopic luminance, in a layer: "" or
/// "filtered.".
void add_light(ExrImage& image, const std::string& layer, const XyzPicture& light) {
  static const glm::dmat3 to_rgb = srgb_from_xyz();
  const size_t pixels = light.pixels();
  std::array<std::vector<float>, 3> xyz, rgb;
  for (size_t i = 0; i < pixels; ++i) {
    const float* p = &light.xyz[3 * i];
    const glm::dvec3 colour = to_rgb * glm::dvec3(p[0], p[1], p[2]);
    for (size_t c = 0; c < 3; ++c) {
      xyz[c].push_back(p[c]);
      rgb[c].push_back(static_cast<float>(colour[static_cast<int>(c)]));
    }
  }
  for (size_t c = 0; c < 3; ++c)
    image.channels.push_back({layer + "XYZ." + "XYZ"[c], std::move(xyz[c])});
  for (size_t c = 0; c < 3; ++c) image.channels.push_back({layer + "RGB"[c], std::move(rgb[c])});
  image.channels.push_back({layer + "scotopic", light.scotopic});
}

/// Features by their names in renderers and viewers: normal, depth, transmittance, albedo.
void add_features(ExrImage& image, const NoisyPicture& noisy) {
  static const glm::dmat3 to_rgb = srgb_from_xyz();
  constexpr std::array<const char*, picture_features> names{
      "N.X", "N.Y", "N.Z", "Z", "transmittance", "albedo.R", "albedo.G", "albedo.B"};
  std::array<std::vector<float>, picture_features> values;
  for (size_t i = 0; i < noisy.pixels(); ++i) {
    const float* f = &noisy.features[picture_features * i];
    const float nearness = f[3];
    const glm::dvec3 albedo =
        to_rgb * glm::dvec3(f[5] * d65_white[0], f[6] * d65_white[1], f[7] * d65_white[2]);
    const float depth_m = nearness > 0 ? 1 / nearness : std::numeric_limits<float>::infinity();
    size_t k = 0;
    for (const float value : {f[0], f[1], f[2], depth_m, f[4], static_cast<float>(albedo.x),
                              static_cast<float>(albedo.y), static_cast<float>(albedo.z)})
      values[k++].push_back(value);
  }
  for (size_t k = 0; k < picture_features; ++k)
    image.channels.push_back({names[k], std::move(values[k])});
}

/// Angle of view of a pixel in the centre, from bottom to top.
double degrees_per_pixel(const Camera& camera) {
  return glm::degrees(2 * std::tan(glm::radians(camera.vertical_fov_deg) / 2) / camera.height);
}

ExrImage exr_of(const LocalRun& run, const Camera& camera, const ShownView& view) {
  const TracedPicture& traced = view.traced;
  const FilteredView* filtered = view.filtered ? &*view.filtered : nullptr;
  ExrImage image;
  image.width = camera.width;
  image.height = camera.height;
  add_light(image, "", traced.light);
  // An error needs two paths: without them its channel is omitted instead of NaN.
  const bool has_error = view.paths >= 2;
  if (has_error) {
    image.channels.push_back({"standard_error.Y", traced.standard_error_y});
    image.channels.push_back({"flux_error.Y", traced.flux_error_y});
  }
  if (filtered != nullptr) {
    add_light(image, "filtered.", filtered->light);
    image.channels.push_back({"filtered_error.Y", filtered->standard_error_y});
  }
  add_features(image, traced.noisy);
  image.chromaticities = Chromaticities{};
  image.white_luminance_cd_m2 = 1.0f;
  image.text = texts_of(run, camera, view);
  image.text.emplace_back(
      "comments",
      std::string("R, G, B: linear sRGB, not clipped; white of 1 is 1 cd/m2. XYZ: CIE 1931 of the "
                  "same light, Y in cd/m2. scotopic: scotopic cd/m2. All as traced, not "
                  "filtered. ") +
          (has_error ? "standard_error.Y: of the pixel's paths and of the flux that they end in; "
                       "flux_error.Y: of the latter alone. "
                     : "No standard error: it needs two paths per pixel. ") +
          (filtered != nullptr ? "filtered: the same without most of its noise, and its error by "
                                 "the difference of two halves. "
                               : "") +
          "N: normal; Z: distance [m]; transmittance of smoke up to the surface; albedo: linear "
          "sRGB, 1 for white.");
  image.numbers = {{"paths_per_pixel", static_cast<double>(view.paths)},
                   {"particles", static_cast<double>(run.particles())},
                   {"display_white_cd_m2", view.human.monitor.white_cd_m2},
                   {"display_black_cd_m2", view.human.monitor.black_cd_m2},
                   {"degrees_per_pixel", degrees_per_pixel(camera)}};
  return image;
}

PngImage png_of(SrgbPicture picture, std::vector<ImageText> texts, const std::string& description) {
  texts.emplace_back("Description", description);
  return {picture.width, picture.height, std::move(picture.rgb), std::move(texts)};
}

/// Shares of the pixels below and above a luminance map's scale: lamps are a thousand times as
/// bright as what they light.
constexpr double left_out_below = 0.01, left_out_above = 0.005;

struct Range {
  double low = 0.1, high = 1;
};

/// The scale for these luminances [cd/m2]: of steps 1, 2, 5, and at least a factor of 2.
Range luminance_range(const std::vector<double>& values) {
  std::vector<double> lit;
  std::copy_if(values.begin(), values.end(), std::back_inserter(lit),
               [](double v) { return std::isfinite(v) && v > 0; });
  if (lit.empty()) return {};
  std::sort(lit.begin(), lit.end());
  const auto at = [&](double share) {
    return lit[static_cast<size_t>(share * static_cast<double>(lit.size() - 1))];
  };
  const double high = round_up_125(at(1 - left_out_above));
  return {round_down_125(std::min(at(left_out_below), high / 2)), high};
}

FalseColourPicture luminance_map(const LocalRun& run, const Camera& camera, const ShownView& view) {
  const SceneDescription& scene = *run.scene().description;
  FalseColourPicture p;
  p.title = "View \"" + camera.name + "\"";
  p.subtitle = (scene.title.empty() ? scene.name : scene.title) + ", scenario \"" +
               run.scene().scenario.name + "\"";
  p.quantity = "Luminance";
  p.unit = "cd/m2";
  p.label_u = "from the left edge";
  p.label_v = "from the lower edge";
  p.length_unit = "px";
  p.cells_u = camera.width;
  p.cells_v = camera.height;
  p.length_u_m = camera.width;
  p.length_v_m = camera.height;
  p.scale = ColourScale::logarithmic;
  p.smooth = false;
  p.mark_minimum = false;
  const auto width = static_cast<size_t>(camera.width);
  for (size_t row = static_cast<size_t>(camera.height); row-- > 0;) {
    for (size_t column = 0; column < width; ++column) {
      p.values.push_back(
          static_cast<double>(view.traced.light.xyz[3 * (row * width + column) + 1]));
    }
  }
  const Range range = luminance_range(p.values);
  p.scale_low = range.low;
  p.scale_high = range.high;
  p.notes = {fmt::format("Scale: {:g} to {:g} cd/m2, without the darkest {:g} % and the brightest "
                         "{:g} % of the pixels",
                         range.low, range.high, 100 * left_out_below, 100 * left_out_above),
             std::to_string(view.paths) + " paths per pixel, flux of " +
                 std::to_string(run.particles()) + " particles"};
  p.text = texts_of(run, camera, view);
  return p;
}

/// The limits of sight that a human view applies.
std::string limits_of_sight(const HumanTone& human) {
  std::string out = "contrast";
  if (human.glare) out += ", glare";
  if (human.lose_acuity) out += ", acuity";
  if (human.lose_colour) out += ", colour";
  return out;
}

/// The picture as an eye in front of it would see the scene.
PngImage human_png(const LocalRun& run, const Camera& camera, const ShownView& view,
                   const XyzPicture& balanced, HumanTone human) {
  human.degrees_per_pixel = degrees_per_pixel(camera);
  const MonitorModel& monitor = human.monitor;
  std::vector<ImageText> texts = texts_of(run, camera, view);
  texts.emplace_back("Display white [cd/m2]", fmt::format("{:g}", monitor.white_cd_m2));
  texts.emplace_back("Display black [cd/m2]", fmt::format("{:g}", monitor.black_cd_m2));
  texts.emplace_back("Degrees per pixel", fmt::format("{:.6g}", human.degrees_per_pixel));
  texts.emplace_back("Limits of sight", limits_of_sight(human));
  texts.emplace_back("White", white_balance_of(run, view).text());
  return png_of(tone_human(balanced, human), texts,
                fmt::format("What an adapted eye tells apart (Ward Larson, Rushmeier and Piatko "
                            "1997), shown on a monitor of {:g} cd/m2; luminance data is in the EXR "
                            "file",
                            monitor.white_cd_m2));
}

/// Enlarges a picture of half the size, linearly between pixels.
XyzPicture enlarged(const XyzPicture& half, int width, int height) {
  XyzPicture out{width, height, {}, {}};
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const int x0 = x / 2, x1 = std::min(x0 + x % 2, half.width - 1);
      const int y0 = y / 2, y1 = std::min(y0 + y % 2, half.height - 1);
      const auto mean = [&](const std::vector<float>& values, size_t stride, size_t c) {
        const auto at = [&](int column, int row) {
          return values[stride * (static_cast<size_t>(row) * static_cast<size_t>(half.width) +
                                  static_cast<size_t>(column)) +
                        c];
        };
        return (at(x0, y0) + at(x1, y0) + at(x0, y1) + at(x1, y1)) / 4;
      };
      for (const size_t c : {size_t{0}, size_t{1}, size_t{2}})
        out.xyz.push_back(mean(half.xyz, 3, c));
      out.scotopic.push_back(mean(half.scotopic, 1, 0));
    }
  return out;
}

}  // namespace

std::string text_of(const Exposure& exposure) {
  return fmt::format("{:.4g},{:.4g},{:.4g}", exposure.grey_cd_m2, exposure.white_cd_m2,
                     exposure.sign_cd_m2);
}

ShownView::ShownView(TracedPicture picture, int paths_per_pixel, const PictureOptions& options,
                     int threads, const RegressionFilter& filter)
    : traced(std::move(picture)),
      paths(paths_per_pixel),
      human(options.human),
      white(options.white),
      tone(options.tone),
      flames_at_s(options.flames_at_s),
      exposure(options.exposure) {
  if (white == PictureWhite::adapted) surfaces = light_on_surfaces(traced);
  if (paths >= min_filtered_paths) filtered = filter_traced(traced, threads, filter);
  raw = options.raw || !filtered;
}

std::vector<ImageText> texts_of(const LocalRun& run, const Camera& camera, const ShownView& view) {
  const CompiledScene& scene = run.scene();
  std::vector<ImageText> out{{"Software", "luxodus"},
                             {"Scene", scene.description->name},
                             {"Scenario", scene.scenario.name},
                             {"View", camera.name}};
  if (!steady_flames(scene).empty())
    out.emplace_back("Flames", view.flames_at_s
                                   ? fmt::format("a moment, at {:g} s; the light they cast and all "
                                                 "verdicts are of their mean",
                                                 *view.flames_at_s)
                                   : "their mean");
  return out;
}

WhiteBalance white_balance_of(const LocalRun& run, const ShownView& view) {
  WhiteBalance out{view.white, {}, view.surfaces, view.human.monitor.white_cd_m2};
  if (view.white == PictureWhite::lamps) out.lamps = white_of_lamps(run.scene());
  return out;
}

double brightest_sign(const LocalRun& run, const Camera& camera, const ShownView& view) {
  return brightest_face(view.shown(), signs_in_view(run.scene(), camera, view.traced.noisy));
}

double brightest_sign_or_flame(const LocalRun& run, const Camera& camera, const ShownView& view) {
  return std::max(brightest_sign(run, camera, view),
                  brightest_flame(run.scene(), camera, view.traced.noisy, view.shown()));
}

PngImage plain_png(const XyzPicture& balanced, const Exposure& exposure, ToneStyle tone,
                   const WhiteBalance& white, std::vector<ImageText> texts) {
  CameraCurve curve = exposure.curve();
  curve.film = tone == ToneStyle::film;
  texts.emplace_back("Exposure", text_of(exposure));
  if (curve.film) texts.emplace_back("Tone", "contrast of film");
  texts.emplace_back("White", white.text());
  return png_of(tone_plain(balanced, curve), std::move(texts),
                "One exposure, as a camera takes it; luminance data is in the EXR file");
}

double ShownView::error() const {
  return raw ? relative_error(traced.light, traced.standard_error_y)
             : relative_error(filtered->light, filtered->standard_error_y);
}

namespace {

/// `light`: what `view` shows, of the camera's size.
PngImage image_of(bool human, const LocalRun& run, const Camera& camera, const ShownView& view,
                  const XyzPicture& light) {
  const WhiteBalance white = white_balance_of(run, view);
  const XyzPicture balanced = white.balanced(light);
  if (!human)
    return plain_png(balanced, shown_exposure(run, camera, view), view.tone, white,
                     texts_of(run, camera, view));
  HumanTone tone = view.human;
  tone.sign_cd_m2 = brightest_sign(run, camera, view);
  return human_png(run, camera, view, balanced, tone);
}

/// Shares of a picture from above a cut: as much is brighter than the middle grey, and than white.
/// Around the building is nothing, so that a mean over the picture says little.
constexpr double brighter_than_grey = 0.2, brighter_than_white = 0.01;
constexpr double least_grey_cd_m2 = 1e-6, least_white_over_grey = 6;

Exposure exposure_from_above(const XyzPicture& picture) {
  std::vector<float> luminances;
  for (size_t i = 0; i < picture.pixels(); ++i) luminances.push_back(picture.xyz[3 * i + 1]);
  const auto exceeded_by = [&](double share) {
    const auto count = static_cast<double>(luminances.size());
    const auto at = luminances.begin() + static_cast<std::ptrdiff_t>((1 - share) * (count - 1));
    std::nth_element(luminances.begin(), at, luminances.end());
    return std::max(least_grey_cd_m2, static_cast<double>(*at));
  };
  const double grey = exceeded_by(brighter_than_grey);
  return {grey, std::max(least_white_over_grey * grey, exceeded_by(brighter_than_white)), 0};
}

}  // namespace

Exposure shown_exposure(const LocalRun& run, const Camera& camera, const ShownView& view) {
  if (view.exposure) return *view.exposure;
  const XyzPicture balanced = white_balance_of(run, view).balanced(view.shown());
  return camera.cut_m ? exposure_from_above(balanced)
                      : exposure_of(balanced, brightest_sign_or_flame(run, camera, view));
}

PngImage shown_image(bool human, const LocalRun& run, const Camera& camera, const ShownView& view) {
  return image_of(human, run, camera, view, view.shown());
}

PngImage first_image(bool human, const LocalRun& run, const Camera& camera, const ShownView& half) {
  return image_of(human, run, camera, half, enlarged(half.shown(), camera.width, camera.height));
}

Result<void> write_shown_png(const std::filesystem::path& file, bool human, const LocalRun& run,
                             const Camera& camera, const ShownView& view) {
  return write_png(file, shown_image(human, run, camera, view));
}

Result<void> write_view_file(const std::filesystem::path& stem, ViewFile file, const LocalRun& run,
                             const Camera& camera, const ShownView& view) {
  const auto path = [&](const char* ending) { return std::filesystem::path(stem) += ending; };
  switch (file) {
    case ViewFile::light:
      return write_exr(path(".exr"), exr_of(run, camera, view));
    case ViewFile::plain:
      return write_shown_png(path(".png"), false, run, camera, view);
    case ViewFile::human:
      return write_shown_png(path("_human.png"), true, run, camera, view);
    case ViewFile::luminance:
      break;
  }
  if (!is_mapped(camera)) return {};
  return write_false_colour_png(path("_luminance.png"), luminance_map(run, camera, view));
}

Result<void> write_first_view(const std::filesystem::path& stem, const LocalRun& run,
                              const Camera& camera, const ShownView& half) {
  return write_png(std::filesystem::path(stem) += ".png", first_image(false, run, camera, half));
}

}  // namespace luxodus
