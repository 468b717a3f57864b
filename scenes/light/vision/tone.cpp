// Both operators decide how bright a pixel is shown by its luminance alone; its colour is then
// fitted into the display's gamut at that luminance. So no colour, however saturated, is shown
// brighter than one of more luminance, and a sign's legend stays apart from its ground.
#include "scenes/light/vision/tone.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "scenes/light/optics/chromaticity.hpp"
#include "scenes/light/vision/display_colour.hpp"
#include "scenes/light/vision/eye_glare.hpp"
#include "scenes/light/vision/foveal_cells.hpp"
#include "scenes/light/vision/mesopic.hpp"

namespace luxodus {
namespace {

// The absolute threshold of vision is about 1e-6 cd/m2; this also keeps logarithms finite.
constexpr double darkest_cd_m2 = 1e-6;

struct Pixel {
  Xyz xyz{};
  double luminance = 0;  // [cd/m2], 0 for an invalid pixel
};

Pixel pixel(const XyzPicture& picture, size_t i) {
  Pixel p;
  for (size_t k = 0; k < 3; ++k) p.xyz[k] = static_cast<double>(picture.xyz[3 * i + k]);
  const bool usable =
      std::isfinite(p.xyz[0]) && std::isfinite(p.xyz[1]) && std::isfinite(p.xyz[2]) && p.xyz[1] > 0;
  if (usable) {
    p.luminance = p.xyz[1];
  } else {
    p.xyz = {};
  }
  return p;
}

void put(SrgbPicture& out, const Xyz& xyz, double shown) {
  std::array<double, 3> rgb{};
  if (shown > 0) rgb = display_colour(xyz, shown);
  for (const double v : rgb) out.rgb.push_back(srgb_byte(v));
}

SrgbPicture empty_like(const XyzPicture& picture) {
  SrgbPicture out{picture.width, picture.height, {}};
  out.rgb.reserve(3 * picture.pixels());
  return out;
}

// ---- plain --------------------------------------------------------------------------------------

// The largest luminance that a monitor shows of a colour: 1 for white, 0.2 for red. A room in the
// light of a fire is exposed for its orange; exposed as a grey room, its walls would be pale.
double brightest_shown(const Xyz& colour) {
  const std::array<double, 3> rgb = linear_srgb_from_xyz(colour);
  return std::clamp(colour[1] / std::max({rgb[0], rgb[1], rgb[2]}), 0.0, 1.0);
}

// The value that one pixel in a thousand exceeds: a lamp may burn out, a wall may not.
// Requires: values is not empty.
double white_of(std::vector<double> values) {
  const size_t rank = (values.size() - 1) - values.size() / 1000;
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(rank),
                   values.end());
  return values[rank];
}

// ---- human --------------------------------------------------------------------------------------

constexpr int histogram_bins = 100;       // Ward Larson et al. 1997
constexpr double trim_tolerance = 0.025;  // their share that a pass may still cut
constexpr int max_passes = 200;

struct LogHistogram {
  double log_low = 0;
  double step = 0;
  std::vector<double> count;

  double total() const {
    double sum = 0;
    for (const double c : count) sum += c;
    return sum;
  }
  double log_centre(size_t b) const { return log_low + (static_cast<double>(b) + 0.5) * step; }
};

LogHistogram histogram_of(const std::vector<double>& luminances) {
  double low = std::log(luminances.front());
  double high = low;
  for (const double l : luminances) {
    low = std::min(low, std::log(l));
    high = std::max(high, std::log(l));
  }
  LogHistogram h{low, (high - low) / histogram_bins, std::vector<double>(histogram_bins, 0.0)};
  for (const double l : luminances) {
    const double position = h.step > 0 ? (std::log(l) - low) / h.step : 0;
    h.count[std::min(static_cast<size_t>(position), h.count.size() - 1)] += 1;
  }
  return h;
}

// Cuts every bin to the count at which the curve is as steep as an eye allows:
//   f(b) <= dL_t(L_d)/dL_t(L_w) * T step L_w / (log(L_dmax/L_dmin) L_d)     (their eq. 10)
// until a pass cuts little. False if hardly anything is left: the scene has less contrast than the
// display.
bool trim_to_human_contrast(LogHistogram& h, double log_black, double log_white) {
  const double whole = h.total();
  for (int pass = 0; pass < max_passes; ++pass) {
    const double total = h.total();
    if (total < trim_tolerance * whole) return false;
    double trimmed = 0;
    double below = 0;
    for (size_t b = 0; b < h.count.size(); ++b) {
      const double share = (below + 0.5 * h.count[b]) / total;
      below += h.count[b];
      const double display = std::exp(log_black + (log_white - log_black) * share);
      const double world = std::exp(h.log_centre(b));
      const double ceiling = threshold_difference_cd_m2(display) /
                             threshold_difference_cd_m2(world) * total * h.step * world /
                             ((log_white - log_black) * display);
      if (h.count[b] > ceiling) {
        trimmed += h.count[b] - ceiling;
        h.count[b] = ceiling;
      }
    }
    if (trimmed <= trim_tolerance * total) return true;
  }
  return true;
}

// One factor for all, so that what is just visible in the scene is just visible on the display
// (Ward 1994): an observer of the display adapts to half of its white.
ToneCurve linear_curve(const std::vector<double>& luminances, const MonitorModel& monitor) {
  double log_sum = 0;
  for (const double l : luminances) log_sum += std::log(l);
  const double world =
      luminances.empty() ? 1 : std::exp(log_sum / static_cast<double>(luminances.size()));
  ToneCurve curve;
  curve.linear = true;
  curve.factor =
      threshold_difference_cd_m2(monitor.white_cd_m2 / 2) / threshold_difference_cd_m2(world);
  return curve;
}

// The light of each pixel for the adapted eye, and its mean over cells of one degree.
struct Seen {
  FovealCells cells;
  std::vector<double> cell_adaptation;  // m of CIE 191, per cell
  std::vector<double> cell_luminance;   // mesopic [cd/m2], per cell
  std::vector<double> pixel_photopic;   // [cd/m2]
  std::vector<double> pixel_scotopic;   // [scotopic cd/m2]
};

Seen see(const XyzPicture& picture, const HumanTone& tone) {
  Seen seen{FovealCells(picture, tone.degrees_per_pixel), {}, {}, {}, {}};
  const size_t cells = seen.cells.count();
  std::vector<double> photopic(cells, 0.0), scotopic(cells, 0.0), members(cells, 0.0);
  for (int y = 0; y < picture.height; ++y)
    for (int x = 0; x < picture.width; ++x) {
      const size_t i = seen.pixel_photopic.size();
      const Pixel p = pixel(picture, i);
      double s = scotopic_from_xyz(p.xyz[0], p.xyz[1], p.xyz[2]);
      if (!picture.scotopic.empty()) s = static_cast<double>(picture.scotopic[i]);
      if (!(s > 0) || !std::isfinite(s)) s = 0;
      seen.pixel_photopic.push_back(p.luminance);
      seen.pixel_scotopic.push_back(s);
      const size_t c = seen.cells.cell_of(x, y);
      photopic[c] += p.luminance;
      scotopic[c] += s;
      members[c] += 1;
    }
  for (size_t c = 0; c < cells; ++c) {
    const MesopicLuminance m =
        mesopic_luminance(photopic[c] / members[c], scotopic[c] / members[c]);
    seen.cell_adaptation.push_back(m.adaptation);
    seen.cell_luminance.push_back(std::max(m.cd_m2, darkest_cd_m2));
  }
  return seen;
}

// Sums over all pixels above and to the left; four look-ups give the mean over a rectangle.
class SummedArea {
 public:
  // `value(i)`: value of pixel i.
  template <class ValueOf>
  SummedArea(int width, int height, ValueOf&& value)
      : stride_(static_cast<size_t>(width) + 1),
        sums_(stride_ * (static_cast<size_t>(height) + 1)) {
    size_t i = 0;
    for (size_t y = 1; y <= static_cast<size_t>(height); ++y) {
      double row = 0;
      for (size_t x = 1; x < stride_; ++x) {
        row += value(i++);
        sums_[y * stride_ + x] = sums_[(y - 1) * stride_ + x] + row;
      }
    }
  }

  // Mean over columns [x0, x1) and rows [y0, y1).
  double mean(int x0, int y0, int x1, int y1) const {
    const double sum = at(x1, y1) - at(x0, y1) - at(x1, y0) + at(x0, y0);
    return std::max(0.0, sum / (static_cast<double>(x1 - x0) * (y1 - y0)));
  }

 private:
  double at(int x, int y) const {
    return sums_[static_cast<size_t>(y) * stride_ + static_cast<size_t>(x)];
  }
  size_t stride_;
  std::vector<double> sums_;
};

// Mean over a square of real-valued width around a pixel, interpolated between those of the nearest
// odd widths; pixels beyond the edge are left out.
double mean_around(const SummedArea& sums, const XyzPicture& picture, int x, int y, double width) {
  const int reach = static_cast<int>((width - 1) / 2);
  const double more = (width - 1) / 2 - reach;
  const auto within = [&](int r) {
    return sums.mean(std::max(0, x - r), std::max(0, y - r), std::min(picture.width, x + r + 1),
                     std::min(picture.height, y + r + 1));
  };
  return (1 - more) * within(reach) + more * within(reach + 1);
}

// The picture as an eye resolves it: each pixel is the mean over the finest spot, half a cycle of
// the finest grating, for an eye adapted to its degree of view.
XyzPicture as_resolved(const XyzPicture& picture, const Seen& seen, double degrees_per_pixel) {
  const auto spot_px = [&](int x, int y) {
    const double adaptation = seen.cells.at_pixel(seen.cell_luminance, x, y);
    return 0.5 / (visual_acuity_cycles_per_degree(adaptation) * degrees_per_pixel);
  };
  const double darkest = *std::min_element(seen.cell_luminance.begin(), seen.cell_luminance.end());
  if (0.5 / (visual_acuity_cycles_per_degree(darkest) * degrees_per_pixel) <= 1) return picture;
  std::vector<SummedArea> sums;
  for (const size_t c : {size_t{0}, size_t{1}, size_t{2}})
    sums.emplace_back(picture.width, picture.height,
                      [&](size_t i) { return pixel(picture, i).xyz[c]; });
  if (!picture.scotopic.empty())
    sums.emplace_back(picture.width, picture.height,
                      [&](size_t i) { return seen.pixel_scotopic[i]; });
  XyzPicture out = picture;
  size_t i = 0;
  for (int y = 0; y < picture.height; ++y)
    for (int x = 0; x < picture.width; ++x, ++i) {
      const double width = spot_px(x, y);
      if (width <= 1 || !is_light(picture, i)) continue;
      for (size_t c = 0; c < sums.size(); ++c)
        (c < 3 ? out.xyz[3 * i + c] : out.scotopic[i]) =
            static_cast<float>(mean_around(sums[c], picture, x, y, width));
    }
  return out;
}

}  // namespace

// Below the knee x (1 + bend x)^(p - 1): its slope in logarithms falls from 1 to p. Above it a
// hyperbola that continues with the same slope and reaches 1 at white.
double CameraCurve::bent(double exposed) const {
  return exposed * std::pow(1 + bend * exposed, least_slope - 1);
}

double CameraCurve::slope_at(double exposed) const {
  const double share = bend * exposed / (1 + bend * exposed);
  return bent(exposed) / exposed * (1 + (least_slope - 1) * share);
}

double CameraCurve::shown(double cd_m2) const {
  const double exposed = factor * cd_m2;
  if (!(exposed > 0)) return 0;
  const double value = neutral(exposed);
  return film ? film_contrast(value) : value;
}

double CameraCurve::neutral(double exposed) const {
  if (exposed <= knee) return bent(exposed);
  if (exposed >= white) return 1;
  const double begin = bent(knee);
  const double t = (exposed - knee) / (white - knee);
  const double slope = slope_at(knee) * (white - knee) / (1 - begin);
  return begin + (1 - begin) * slope * t / (1 + (slope - 1) * t);
}

double film_contrast(double shown) {
  constexpr double power = 0.93, toe = 0.012;
  if (shown >= sign_level || !(shown > 0)) return shown;
  const auto curve = [](double v) { return std::pow(v, power) * v / (v + toe); };
  return sign_level * curve(shown) / curve(sign_level);
}

CameraCurve camera_curve(double factor, double white_cd_m2, double sign_cd_m2) {
  CameraCurve curve;
  curve.factor = factor;
  curve.white = std::max(1.0, factor * white_cd_m2);
  if (!(curve.shown(sign_cd_m2) > sign_level)) return curve;
  curve.knee = factor * sign_cd_m2;
  // bent(knee) is sign_level.
  curve.bend =
      std::max(0.0, std::pow(curve.knee / sign_level, 1 / (1 - CameraCurve::least_slope)) - 1) /
      curve.knee;
  // A hyperbola that begins flatter than its chord would rise towards white.
  const double straight = curve.knee + (1 - sign_level) / curve.slope_at(curve.knee);
  curve.white = std::max(curve.white, straight);
  return curve;
}

void LightMeter::add(const LightMeter& other) {
  pixels += other.pixels;
  log_luminance += other.log_luminance;
  brightest_shown += other.brightest_shown;
  white_cd_m2 = std::max(white_cd_m2, other.white_cd_m2);
  sign_cd_m2 = std::max(sign_cd_m2, other.sign_cd_m2);
}

Exposure LightMeter::exposure() const {
  if (pixels == 0) return {};
  return {std::exp(log_luminance / pixels) / (brightest_shown / pixels), white_cd_m2, sign_cd_m2};
}

LightMeter metered(const XyzPicture& picture, double sign_cd_m2) {
  LightMeter meter;
  std::vector<double> lit;
  for (size_t i = 0; i < picture.pixels(); ++i) {
    const Pixel p = pixel(picture, i);
    if (p.luminance <= darkest_cd_m2) continue;
    meter.log_luminance += std::log(p.luminance);
    meter.brightest_shown += brightest_shown(p.xyz);
    lit.push_back(p.luminance);
  }
  if (lit.empty()) return {};
  meter.pixels = static_cast<double>(lit.size());
  meter.white_cd_m2 = white_of(std::move(lit));
  meter.sign_cd_m2 = sign_cd_m2;
  return meter;
}

Exposure exposure_of(const XyzPicture& picture, double sign_cd_m2) {
  return metered(picture, sign_cd_m2).exposure();
}

SrgbPicture tone_plain(const XyzPicture& picture, const CameraCurve& curve) {
  SrgbPicture out = empty_like(picture);
  for (size_t i = 0; i < picture.pixels(); ++i) {
    const Pixel p = pixel(picture, i);
    put(out, p.xyz, curve.shown(p.luminance));
  }
  return out;
}

double threshold_difference_cd_m2(double adaptation_cd_m2) {
  // Rods below about 0.0148 cd/m2 ... cones above 15.4: five pieces in l = log10 L_a.
  if (!(adaptation_cd_m2 > 1.148e-4)) return 1.38e-3;
  const double l = std::log10(adaptation_cd_m2);
  double log_difference = 0;
  if (l < -1.44) {
    log_difference = std::pow(0.405 * l + 1.6, 2.18) - 2.86;
  } else if (l < -0.0184) {
    log_difference = l - 0.395;
  } else if (l < 1.9) {
    log_difference = std::pow(0.249 * l + 0.65, 2.7) - 0.72;
  } else {
    log_difference = l - 1.255;
  }
  return std::pow(10.0, log_difference);
}

double ToneCurve::display(double world_cd_m2) const {
  if (!(world_cd_m2 > 0)) return 0;
  if (linear) return factor * world_cd_m2;
  const double l = std::log(world_cd_m2);
  if (l <= log_world.front()) {
    // Darker than every degree of the scene: keep the ratio to the darkest, so that black stays
    // black.
    return std::exp(log_display.front()) * world_cd_m2 / std::exp(log_world.front());
  }
  if (l >= log_world.back()) return std::exp(log_display.back());
  const auto above = std::upper_bound(log_world.begin(), log_world.end(), l);
  const auto k = static_cast<size_t>(above - log_world.begin());
  const double f = (l - log_world[k - 1]) / (log_world[k] - log_world[k - 1]);
  return std::exp(log_display[k - 1] + f * (log_display[k] - log_display[k - 1]));
}

ToneCurve human_curve(const std::vector<double>& adaptation_cd_m2, const MonitorModel& monitor) {
  std::vector<double> lit;
  for (const double l : adaptation_cd_m2)
    if (std::isfinite(l) && l > 0) lit.push_back(std::max(l, darkest_cd_m2));
  if (lit.empty()) return linear_curve(lit, monitor);
  const double log_black = std::log(monitor.black_cd_m2);
  const double log_white = std::log(monitor.white_cd_m2);
  LogHistogram h = histogram_of(lit);
  const bool fits = h.step * histogram_bins <= log_white - log_black;
  if (fits || !trim_to_human_contrast(h, log_black, log_white)) return linear_curve(lit, monitor);

  ToneCurve curve;
  const double total = h.total();
  double below = 0;
  for (size_t b = 0; b <= h.count.size(); ++b) {
    curve.log_world.push_back(h.log_low + static_cast<double>(b) * h.step);
    curve.log_display.push_back(log_black + (log_white - log_black) * below / total);
    if (b < h.count.size()) below += h.count[b];
  }
  return curve;
}

double visual_acuity_cycles_per_degree(double adaptation_cd_m2) {
  const double l = std::log10(std::max(adaptation_cd_m2, darkest_cd_m2));
  return 17.25 * std::atan(1.4 * l + 0.35) + 25.72;
}

SrgbPicture tone_human(const XyzPicture& whole, const HumanTone& tone) {
  SrgbPicture out = empty_like(whole);
  if (whole.pixels() == 0) return out;
  const bool angles_known = tone.degrees_per_pixel > 0;
  XyzPicture picture =
      tone.glare && angles_known ? with_eye_glare(whole, tone.degrees_per_pixel) : whole;
  Seen seen = see(picture, tone);
  if (tone.lose_acuity && angles_known) {
    picture = as_resolved(picture, seen, tone.degrees_per_pixel);
    // Cells stay unchanged: adaptation is taken before the blur.
    const Seen resolved = see(picture, tone);
    seen.pixel_photopic = resolved.pixel_photopic;
    seen.pixel_scotopic = resolved.pixel_scotopic;
  }
  const ToneCurve curve = human_curve(seen.cell_luminance, tone.monitor);
  const auto on_monitor = [&](double cd_m2) {  // 0 black, 1 white
    const MonitorModel& monitor = tone.monitor;
    return std::max(0.0, (curve.display(cd_m2) - monitor.black_cd_m2) /
                             (monitor.white_cd_m2 - monitor.black_cd_m2));
  };
  std::vector<double> wanted;  // above 1 where the monitor cannot show it
  for (int y = 0; y < picture.height; ++y)
    for (int x = 0; x < picture.width; ++x) {
      const size_t i = wanted.size();
      const double m = seen.cells.at_pixel(seen.cell_adaptation, x, y);
      const double l = mesopic_luminance_adapted(seen.pixel_photopic[i], seen.pixel_scotopic[i], m);
      wanted.push_back(seen.pixel_photopic[i] > 0 ? on_monitor(l) : 0);
    }
  const CameraCurve highlights = camera_curve(1, white_of(wanted), on_monitor(tone.sign_cd_m2));
  size_t i = 0;
  for (int y = 0; y < picture.height; ++y)
    for (int x = 0; x < picture.width; ++x, ++i) {
      Pixel p = pixel(picture, i);
      if (tone.lose_colour && p.luminance > 0) {
        // Rods see no colour: the share of colour that is kept is the cones' share of the
        // adaptation.
        const double m = seen.cells.at_pixel(seen.cell_adaptation, x, y);
        for (size_t k = 0; k < 3; ++k)
          p.xyz[k] = p.luminance * (m * p.xyz[k] / p.luminance + (1 - m) * d65_white[k]);
      }
      put(out, p.xyz, highlights.shown(wanted[i]));
    }
  return out;
}

}  // namespace luxodus
