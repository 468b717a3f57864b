// Texels of each face are projected into the picture. A texel is hidden if the first surface of its
// pixel is at another distance, or faces another way.
#include "actors/results/pictures/signs_in_view.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "actors/results/pictures/pixel_sums.hpp"
#include "actors/results/pictures/pixel_tracer.hpp"
#include "scenes/light/signs/sign_face.hpp"

namespace luxodus {

namespace {

/// Largest relative difference of distances between a texel and what its pixel shows. Features are
/// means over a pixel, in which a face may share its pixel with a wall behind it.
constexpr double same_distance = 0.05;
/// Least cosine between the normals of a face and of what its pixel shows.
constexpr double same_way = 0.95;
/// Texels looked at across and down a face: more than the pixels that signs have in pictures.
constexpr int max_samples = 256;

/// Whether the surface that a pixel shows is that of a face at this place.
bool shows_face(const NoisyPicture& features, size_t pixel, const glm::dvec3& normal,
                double distance_m) {
  const float* f = &features.features[features.feature_count * pixel];
  const glm::dvec3 seen(f[0], f[1], f[2]);
  const double nearness = static_cast<double>(f[3]);
  return std::abs(nearness * distance_m - 1) < same_distance && glm::dot(seen, normal) > same_way;
}

void keep_each_once(std::vector<size_t>& pixels) {
  std::sort(pixels.begin(), pixels.end());
  pixels.erase(std::unique(pixels.begin(), pixels.end()), pixels.end());
}

/// Leaves each pixel to the only list that has it. A pixel of several colours is of none.
void drop_shared(std::vector<std::vector<size_t>>& lists) {
  std::vector<size_t> all;
  for (std::vector<size_t>& pixels : lists) {
    keep_each_once(pixels);
    all.insert(all.end(), pixels.begin(), pixels.end());
  }
  std::sort(all.begin(), all.end());
  for (std::vector<size_t>& pixels : lists)
    std::erase_if(pixels, [&](size_t pixel) {
      const auto [first, last] = std::equal_range(all.begin(), all.end(), pixel);
      return last - first > 1;
    });
}

/// The pixels that show a face.
SignInView face_in_view(const CompiledSign& compiled, const Sign& sign, const Pinhole& pinhole,
                        const glm::dvec3& eye, const NoisyPicture& features) {
  const size_t count = sign.colours.size();
  std::vector<std::vector<size_t>> pixels(count + 1);  // the last ones: of none of its colours
  const SignFace& face = sign.face;
  const int across = std::min(face.width, max_samples), down = std::min(face.height, max_samples);
  const Frame& frame = compiled.frame;
  for (int row = 0; row < down; ++row)
    for (int column = 0; column < across; ++column) {
      const double u = (column + 0.5) / across, v = (row + 0.5) / down;
      const glm::dvec3 place =
          frame.origin +
          frame.axes * glm::dvec3((u - 0.5) * sign.width_m, (0.5 - v) * sign.height_m, 0.0);
      const auto at = pinhole.pixel_of(place);
      if (!at) continue;
      const size_t pixel = static_cast<size_t>(at->y) * static_cast<size_t>(features.width) +
                           static_cast<size_t>(at->x);
      if (!shows_face(features, pixel, frame.axes[2], glm::distance(place, eye))) continue;
      const ColourIndex colour = face.colour[texel_index(face, u, v)];
      pixels[std::min<size_t>(colour, count)].push_back(pixel);
    }
  drop_shared(pixels);
  pixels.pop_back();
  return {compiled.sign, compiled.back, std::move(pixels)};
}

}  // namespace

std::vector<SignInView> signs_in_view(const CompiledScene& scene, const Camera& camera,
                                      const NoisyPicture& features) {
  Camera seen = camera;
  seen.width = features.width;
  seen.height = features.height;
  const Pinhole pinhole(seen, glm::dvec3(0));
  std::vector<SignInView> out;
  for (const CompiledSign& face : scene.signs) {
    if (glm::dot(camera.eye - face.frame.origin, face.frame.axes[2]) <= 0) continue;
    SignInView shown =
        face_in_view(face, scene.description->signs[face.sign], pinhole, camera.eye, features);
    if (std::any_of(shown.colours.begin(), shown.colours.end(),
                    [](const std::vector<size_t>& pixels) { return !pixels.empty(); }))
      out.push_back(std::move(shown));
  }
  return out;
}

double mean_luminance(const XyzPicture& picture, const std::vector<size_t>& pixels) {
  double sum = 0;
  for (const size_t pixel : pixels)
    if (is_light(picture, pixel)) sum += static_cast<double>(picture.xyz[3 * pixel + 1]);
  return pixels.empty() ? 0 : sum / static_cast<double>(pixels.size());
}

double brightest_face(const XyzPicture& picture, const std::vector<SignInView>& signs) {
  double most = 0;
  for (const SignInView& sign : signs)
    for (const std::vector<size_t>& pixels : sign.colours)
      most = std::max(most, mean_luminance(picture, pixels));
  return most;
}

}  // namespace luxodus
