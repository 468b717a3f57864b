#include "scenes/light/signs/sign_colours.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numeric>

#include "scenes/light/signs/sign_face.hpp"

namespace luxodus {

namespace {

/// Largest ratio of two areas that leaves open which of them is larger: edges are a texel wide.
constexpr double alike_areas = 1.1;

/// IEC 61966-2-1 decoding.
double linear_from_srgb(uint8_t code) {
  const double c = code / 255.0;
  return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
}

std::array<double, 3> linear_of(const Srgb& c) {
  return {linear_from_srgb(c[0]), linear_from_srgb(c[1]), linear_from_srgb(c[2])};
}

Spectrum reflectance_of(const Srgb& drawn) {
  const auto rgb = linear_of(drawn);
  return reflectance_from_linear_srgb(rgb[0], rgb[1], rgb[2]);
}

bool are_white_and_green(const FaceColour& a, const FaceColour& b) {
  const auto is = [](const FaceColour& c, std::string_view name) {
    return safety_name_of(c.drawn) == name;
  };
  return (is(a, "white") && is(b, "green")) || (is(a, "green") && is(b, "white"));
}

std::string choices_of(const std::vector<FaceColour>& colours) {
  return "write legend and ground, each one of: " + colour_names(colours);
}

}  // namespace

std::array<double, 3> lab_from_srgb(uint8_t r8, uint8_t g8, uint8_t b8) {
  const auto [r, g, b] = linear_of({r8, g8, b8});
  // sRGB to XYZ (IEC 61966-2-1), divided by its own white so that white is exactly (100, 0, 0).
  const double x = (0.4124 * r + 0.3576 * g + 0.1805 * b) / 0.9505;
  const double y = 0.2126 * r + 0.7152 * g + 0.0722 * b;
  const double z = (0.0193 * r + 0.1192 * g + 0.9505 * b) / 1.0890;
  const auto f = [](double t) {
    constexpr double delta = 6.0 / 29.0;
    return t > delta * delta * delta ? std::cbrt(t) : t / (3 * delta * delta) + 4.0 / 29.0;
  };
  return {116 * f(y) - 16, 500 * (f(x) - f(y)), 200 * (f(y) - f(z))};
}

double colour_difference(const Srgb& one, const Srgb& other) {
  const auto a = lab_from_srgb(one[0], one[1], one[2]);
  const auto b = lab_from_srgb(other[0], other[1], other[2]);
  return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

std::optional<Srgb> drawn_as(std::string_view name) {
  for (const SafetyColour& colour : safety_colours)
    if (colour.name == name) return colour.drawn;
  return std::nullopt;
}

std::string_view safety_name_of(const Srgb& drawn) {
  const auto nearer = [&](const SafetyColour& a, const SafetyColour& b) {
    return colour_difference(a.drawn, drawn) < colour_difference(b.drawn, drawn);
  };
  return std::min_element(safety_colours.begin(), safety_colours.end(), nearer)->name;
}

std::string hex_text(const Srgb& colour) {
  constexpr std::string_view digits = "0123456789ABCDEF";
  std::string out = "#";
  for (const uint8_t c : colour) out += {digits[c / 16u], digits[c % 16u]};
  return out;
}

std::optional<Srgb> from_hex_text(std::string_view text) {
  if (text.size() != 7 || text.front() != '#') return std::nullopt;
  Srgb out{};
  for (size_t i = 0; i < 3; ++i) {
    const char* first = text.data() + 1 + 2 * i;
    const auto [end, error] = std::from_chars(first, first + 2, out[i], 16);
    if (error != std::errc() || end != first + 2) return std::nullopt;
  }
  return out;
}

Spectrum paint_of(const Srgb& drawn) {
  return reflectance_of(drawn);
}

Spectrum film_before(const Spectrum& lamp, const Srgb& drawn) {
  const Spectrum light = lamp * reflectance_of(drawn);
  return light * (1 / light.integral());
}

std::optional<ColourIndex> colour_named(const std::vector<FaceColour>& colours,
                                        std::string_view name) {
  for (size_t i = 0; i < colours.size(); ++i)
    if (colours[i].name == name) return static_cast<ColourIndex>(i);
  return std::nullopt;
}

std::optional<ColourIndex> safety_colour_of(const Sign& sign, std::string_view name) {
  for (size_t i = 0; i < sign.colours.size(); ++i)
    if (safety_name_of(sign.colours[i].drawn) == name) return static_cast<ColourIndex>(i);
  return std::nullopt;
}

std::string colour_names(const std::vector<FaceColour>& colours) {
  std::string out;
  for (const FaceColour& colour : colours) out += (out.empty() ? "" : ", ") + colour.name;
  return out;
}

Result<void> choose_legend(SignFace& face, const std::vector<FaceColour>& colours,
                           std::optional<ColourIndex> legend, std::optional<ColourIndex> ground) {
  if (legend && legend == ground)
    return problem("legend and ground are both " + colours[*legend].name + "; " +
                   choices_of(colours));
  // The others, those with the largest area first.
  std::vector<ColourIndex> left(colours.size());
  std::iota(left.begin(), left.end(), ColourIndex{0});
  std::erase_if(left, [&](ColourIndex c) { return c == legend || c == ground; });
  const auto area = [&](ColourIndex c) { return colour_share(face, c); };
  std::stable_sort(left.begin(), left.end(),
                   [&](ColourIndex a, ColourIndex b) { return area(a) > area(b); });
  const size_t missing = (legend ? 0u : 1u) + (ground ? 0u : 1u);
  if (left.size() < missing || (missing > 0 && area(left[missing - 1]) == 0))
    return problem("the face has no two of its colours, so it has no legend on a ground; use " +
                   std::string("'plain' for a face of one colour"));
  const auto alike = [&](ColourIndex a, ColourIndex b) { return area(a) < alike_areas * area(b); };
  if (missing > 0 && left.size() > missing && alike(left[missing - 1], left[missing]))
    return problem("its colours " + colours[left[missing - 1]].name + " and " +
                   colours[left[missing]].name + " cover about as much: " + choices_of(colours));
  if (missing == 2) {
    const FaceColour &larger = colours[left[0]], &smaller = colours[left[1]];
    if (are_white_and_green(larger, smaller)) {
      if (safety_name_of(larger.drawn) == "white") std::swap(left[0], left[1]);
    } else if (alike(left[0], left[1])) {
      return problem("its colours " + larger.name + " and " + smaller.name +
                     " cover about as much: " + choices_of(colours));
    }
  }
  face.ground = ground ? *ground : left.front();
  face.legend = legend ? *legend : left[missing - 1];
  return {};
}

double max_mains_cd_m2(const Sign& sign) {
  double most = 0;
  for (const FaceColour& colour : sign.colours) most = std::max(most, colour.mains_cd_m2);
  return most;
}

double max_emergency_cd_m2(const Sign& sign) {
  double most = 0;
  for (const FaceColour& colour : sign.colours) most = std::max(most, colour.emergency_cd_m2);
  return most;
}

void scale_luminances(Sign& sign, double mains, double emergency) {
  for (FaceColour& colour : sign.colours) {
    colour.mains_cd_m2 *= mains;
    colour.emergency_cd_m2 *= emergency;
  }
}

}  // namespace luxodus
