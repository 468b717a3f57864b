// Material and surface model at a hit, including reflectance textures and sign faces. Pure but for
// the resolver; any thread.
#pragma once

#include "scenes/light/geometry/real.hpp"
#include "scenes/light/intersect/embree_scene.hpp"
#include "scenes/light/transport/compiled_scene.hpp"

namespace luxodus {

/// Texture coordinates at a hit; (0, 0) is the picture's lower left corner, and pictures repeat.
Vec2 texture_uv(const GeometryCell& cell, const Hit& hit);

/// Column and row of the texel nearest to (u, v). Uses only the picture's size.
glm::ivec2 texel_of(const Image& image, const Vec2& uv);
/// Reflectance factor in a band for a texel of this many channels, in [0, 1].
Real texel_factor(const CompiledScene& scene, const float* texel, int channels, int band);

/// Texel of a sign's face at (u, v); (0, 0) is the reader's lower left corner.
size_t texel_at(const SignFace& face, const Vec2& uv);

/// The material on one side of the surface hit.
inline const CompiledMaterial& material_at(const CompiledScene& scene, const Hit& hit, bool front) {
  return scene.materials[scene.surfaces[hit.triangle->surface].material[front ? 0 : 1]];
}

/// The surface model at this hit: the material's, with the diffuse part from texture or sign face.
template <class Resolver>
SurfaceModel surface_at(const CompiledScene& scene, const Hit& hit, bool front, int band,
                        const CompiledMaterial& material, Resolver& resolver) {
  SurfaceModel model = material.by_band[static_cast<size_t>(band)];
  const CompiledSurface& surface = scene.surfaces[hit.triangle->surface];
  if (surface.sign != none_index && front) {
    const CompiledSign& sign = scene.signs[surface.sign];
    const SignFace& face = scene.description->signs[sign.sign].face;
    const ColourIndex colour = face.colour[texel_at(face, texture_uv(*hit.cell, hit))];
    if (colour != other_colour)
      model.reflectance = sign.colours[colour].reflectance[static_cast<size_t>(band)];
  } else if (material.image != none_index) {
    const Image& image = *scene.images[material.image];
    const glm::ivec2 at = texel_of(image, texture_uv(*hit.cell, hit));
    const float* texel = resolver.texel(material.image, at.x, at.y);
    model.reflectance *= texel_factor(scene, texel, image.channels, band);
  }
  return model;
}

}  // namespace luxodus
