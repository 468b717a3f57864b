#include "scenes/light/transport/textures.hpp"

#include <algorithm>
#include <cmath>

namespace luxodus {

namespace {

int texel_index(Real coordinate, int size) {
  const Real wrapped = coordinate - std::floor(coordinate);
  return std::clamp(static_cast<int>(wrapped * static_cast<Real>(size)), 0, size - 1);
}

}  // namespace

Vec2 texture_uv(const GeometryCell& cell, const Hit& hit) {
  const auto* uv = cell.uv_of(hit.index);
  if (uv == nullptr) return {0, 0};
  return Vec2(uv->corner[0]) * (1 - hit.u - hit.v) + Vec2(uv->corner[1]) * hit.u +
         Vec2(uv->corner[2]) * hit.v;
}

glm::ivec2 texel_of(const Image& image, const Vec2& uv) {
  return {texel_index(uv.x, image.width), texel_index(1 - uv.y, image.height)};
}

Real texel_factor(const CompiledScene& scene, const float* texel, int channels, int band) {
  if (channels < 3) return texel[0];
  const std::array<Real, 3>& basis = scene.image_basis[static_cast<size_t>(band)];
  return std::clamp(texel[0] * basis[0] + texel[1] * basis[1] + texel[2] * basis[2], 0.0_r, 1.0_r);
}

size_t texel_at(const SignFace& face, const Vec2& uv) {
  const int x =
      std::clamp(static_cast<int>(uv.x * static_cast<Real>(face.width)), 0, face.width - 1);
  const int y =
      std::clamp(static_cast<int>((1 - uv.y) * static_cast<Real>(face.height)), 0, face.height - 1);
  return static_cast<size_t>(y * face.width + x);
}

}  // namespace luxodus
