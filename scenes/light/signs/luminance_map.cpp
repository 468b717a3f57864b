// The brightness pattern of a face: the exact average of a map over each texel, by colour.
#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "scenes/light/signs/sign_face.hpp"

namespace luxodus {
namespace {

/// Relative luminance of a pixel: IEC 61966-2-1 primaries for three channels, grey for one.
double luminance_of(const Image& map, size_t pixel) {
  const auto channels = static_cast<size_t>(map.channels);
  const float* texel = map.texels.data() + pixel * channels;
  if (channels == 1) return texel[0];
  return 0.2126 * texel[0] + 0.7152 * texel[1] + 0.0722 * texel[2];
}

/// Whether the image keeps its own rules.
Result<void> check_map(const Image& map) {
  const bool layout = map.width > 0 && map.height > 0 &&
                      (map.channels == 1 || map.channels == 3 || map.channels == 4) &&
                      map.texels.size() == static_cast<size_t>(map.width) *
                                               static_cast<size_t>(map.height) *
                                               static_cast<size_t>(map.channels);
  if (!layout)
    return problem("the luminance map is empty or incomplete; give a grey or colour picture");
  for (float value : map.texels)
    if (!(std::isfinite(value) && value >= 0))
      return problem("the luminance map has a value that is negative or not a number");
  return {};
}

/// Visits the cells of a row of `count` that [low, high) overlaps, each with its overlap.
template <class Visit>
void for_overlaps(double low, double high, int count, Visit&& visit) {
  const int first = std::clamp(static_cast<int>(low), 0, count - 1);
  for (int cell = first; cell < count && cell < high; ++cell) {
    const double overlap = std::min(high, cell + 1.0) - std::max(low, static_cast<double>(cell));
    if (overlap > 0) visit(static_cast<size_t>(cell), overlap);
  }
}

/// Area average of the map over one texel of the face.
double average(const Image& map, const SignFace& face, int column, int row) {
  const double across = static_cast<double>(map.width) / face.width;
  const double down = static_cast<double>(map.height) / face.height;
  double sum = 0, area = 0;
  for_overlaps(row * down, (row + 1) * down, map.height, [&](size_t y, double high) {
    for_overlaps(column * across, (column + 1) * across, map.width, [&](size_t x, double wide) {
      sum += high * wide * luminance_of(map, y * static_cast<size_t>(map.width) + x);
      area += high * wide;
    });
  });
  return sum / area;
}

}  // namespace

Result<SignFace> with_luminance_map(SignFace face, const std::vector<FaceColour>& colours,
                                    const Image& map) {
  if (auto ok = check_map(map); !ok) return ok.problem();
  std::vector<double> luminance;
  luminance.reserve(face.colour.size());
  for (int row = 0; row < face.height; ++row)
    for (int column = 0; column < face.width; ++column)
      luminance.push_back(average(map, face, column, row));

  face.relative_luminance.assign(face.colour.size(), 1.0f);
  for (size_t c = 0; c < colours.size(); ++c) {
    const auto colour = static_cast<ColourIndex>(c);
    double sum = 0;
    int64_t texels = 0;
    for (size_t i = 0; i < luminance.size(); ++i) {
      if (face.colour[i] != colour) continue;
      sum += luminance[i];
      ++texels;
    }
    if (texels == 0) continue;
    if (!(sum > 0) || !std::isfinite(sum))
      return problem(std::string("the luminance map is black wherever the sign is ") +
                     colours[c].name + "; state that colour's luminance as 0 instead");
    for (size_t i = 0; i < luminance.size(); ++i)
      if (face.colour[i] == colour)
        face.relative_luminance[i] =
            static_cast<float>(luminance[i] * static_cast<double>(texels) / sum);
  }
  return face;
}

}  // namespace luxodus
