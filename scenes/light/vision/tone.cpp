// Both operators preserve a pixel's colour: its XYZ is divided by its luminance and multiplied by
// the display's. If a channel would exceed the monitor's white, all three are scaled alike, so that
// hue and saturation stay and luminance decreases; except colours of fire, which turn yellow.
#include "scenes/light/vision/tone.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "scenes/light/optics/chromaticity.hpp"
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

double leading(const std::array<double, 3>& rgb) {
  return std::max({rgb[0], rgb[1], rgb[2]});
}

// Linear sRGB of luminance `shown` with the colour of `xyz`, unbounded above. A colour more
// saturated than the monitor's moves towards the grey of its luminance, just as far as needed.
std::array<double, 3> shown_colour(const Xyz& xyz, double shown) {
  const double k = shown / xyz[1];
  std::array<double, 3> rgb = linear_srgb_from_xyz({k * xyz[0], shown, k * xyz[2]});
  double saturation = 1;
  for (const double v : rgb) {
    if (v < 0) saturation = std::min(saturation, shown / (shown - v));
  }
  for (double& v : rgb) v = shown + saturation * (v - shown);
  return rgb;
}

// The colour with all channels scaled alike, so that the largest one becomes `to`.
void put_scaled(SrgbPicture& out, const std::array<double, 3>& rgb, double to) {
  const double most = leading(rgb);
  for (const double v : rgb) out.rgb.push_back(srgb_byte(most > 0 ? v / most * to : 0));
}

// Similarity of a colour to fire, from red to amber: 1 if its channels are a quarter of the largest
// one apart, red first and blue last; 0 in any other order. Beyond an automatically chosen white,
// such colours burn out channel by channel, as on film: the core of a flame turns yellow, and
// contrasts with a wall that it lights. A sign's green would turn cyan.
double warmth(const std::array<double, 3>& rgb) {
  const double apart = std::min(rgb[0] - rgb[1], rgb[1] - rgb[2]);
  return std::clamp(4 * apart / leading(rgb), 0.0, 1.0);
}

SrgbPicture empty_like(const XyzPicture& picture) {
  SrgbPicture out{picture.width, picture.height, {}};
  out.rgb.reserve(3 * picture.pixels());
  return out;
}

// ---- plain --------------------------------------------------------------------------------------

struct Exposure {
  double factor = 1;  // display value per cd/m2
  double white = 1;   // exposed value at which the shoulder reaches 1
};

Exposure exposure_of(const XyzPicture& picture, const PlainTone& tone) {
  if (tone.white_cd_m2 && *tone.white_cd_m2 > 0) return {1 / *tone.white_cd_m2, 1};
  double log_sum = 0;
  std::vector<double> lit;
  for (size_t i = 0; i < picture.pixels(); ++i) {
    const double l = pixel(picture, i).luminance;
    if (l <= darkest_cd_m2) continue;
    log_sum += std::log(l);
    lit.push_back(l);
  }
  if (lit.empty()) return {};
  const double factor = tone.key / std::exp(log_sum / static_cast<double>(lit.size()));
  // White is the luminance that one pixel in a thousand exceeds: a lamp may burn out, a wall may
  // not.
  const size_t rank = (lit.size() - 1) - lit.size() / 1000;
  std::nth_element(lit.begin(), lit.begin() + static_cast<std::ptrdiff_t>(rank), lit.end());
  return {factor, std::max(1.0, factor * lit[rank])};
}

// The share of a colour that burns out if its largest channel has this exposure.
double burnt_share(const Exposure& exposure, double lead, const std::array<double, 3>& rgb) {
  return lead > exposure.white ? (1 - exposure.white / lead) * warmth(rgb) : 0;
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

// The largest channel of a colour at this exposure.
double lead_of_colour(const Pixel& p, const Exposure& exposure) {
  return p.luminance > 0 ? leading(shown_colour(p.xyz, exposure.factor * p.luminance)) : 0;
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
  curve.display_white_cd_m2 = monitor.white_cd_m2;
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

double shoulder(double exposed, double white) {
  if (!(exposed > 0)) return 0;
  if (exposed <= shoulder_knee) return exposed;
  const double top = std::max(white, 1.0);
  if (exposed >= top) return 1;
  const double t = (exposed - shoulder_knee) / (top - shoulder_knee);
  const double slope = (top - shoulder_knee) / (1 - shoulder_knee);
  return shoulder_knee + (1 - shoulder_knee) * slope * t / (1 + (slope - 1) * t);
}

SrgbPicture tone_plain(const XyzPicture& picture, const PlainTone& tone) {
  const Exposure exposure = exposure_of(picture, tone);
  SrgbPicture out = empty_like(picture);
  for (size_t i = 0; i < picture.pixels(); ++i) {
    const Pixel p = pixel(picture, i);
    std::array<double, 3> rgb{};
    if (p.luminance > 0) rgb = shown_colour(p.xyz, exposure.factor * p.luminance);
    // The shoulder is applied to the largest channel, not to the luminance: a green as bright as
    // white would have to be white, and a sign's legend would be lost on it.
    const double lead = leading(rgb), to = shoulder(lead, exposure.white);
    const double burnt = tone.white_cd_m2 ? 0 : burnt_share(exposure, lead, rgb);
    for (double& v : rgb) {
      const double scaled = lead > 0 ? v / lead * to : 0;
      v = scaled + burnt * (shoulder(v, exposure.white) - scaled);
    }
    put_scaled(out, rgb, leading(rgb));
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
  if (linear) return std::min(factor * world_cd_m2, display_white_cd_m2);
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
  curve.display_white_cd_m2 = monitor.white_cd_m2;
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
  const Exposure exposure = exposure_of(picture, {});  // fire burns out beyond its white
  const double black = tone.monitor.black_cd_m2;
  const double range = tone.monitor.white_cd_m2 - black;
  for (int y = 0; y < picture.height; ++y)
    for (int x = 0; x < picture.width; ++x) {
      const size_t i =
          static_cast<size_t>(y) * static_cast<size_t>(picture.width) + static_cast<size_t>(x);
      Pixel p = pixel(picture, i);
      const double m = seen.cells.at_pixel(seen.cell_adaptation, x, y);
      const double l = mesopic_luminance_adapted(seen.pixel_photopic[i], seen.pixel_scotopic[i], m);
      if (tone.lose_colour && p.luminance > 0) {
        // Rods see no colour: the share of colour that is kept is the cones' share of the
        // adaptation.
        for (size_t k = 0; k < 3; ++k)
          p.xyz[k] = p.luminance * (m * p.xyz[k] / p.luminance + (1 - m) * d65_white[k]);
      }
      std::array<double, 3> rgb{};
      if (p.luminance > 0) {
        rgb = shown_colour(p.xyz, std::clamp((curve.display(l) - black) / range, 0.0, 1.0));
      }
      const double lead = leading(rgb), to = std::min(lead, 1.0);
      const double burnt = lead > 1 ? burnt_share(exposure, lead_of_colour(p, exposure), rgb) : 0;
      for (double& v : rgb) {
        const double scaled = lead > 0 ? v / lead * to : 0;
        v = scaled + burnt * (std::min(v, 1.0) - scaled);
      }
      put_scaled(out, rgb, leading(rgb));
    }
  return out;
}

}  // namespace luxodus
