#include "scenes/light/transport/eye_paths.hpp"

namespace luxodus {

FaceTexels list_texels(const SignFace& face) {
  FaceTexels out;
  const auto parts = face.parts();
  for (uint32_t i = 0; i < face.colour.size(); ++i)
    for (size_t part = 0; part < parts.size(); ++part)
      if (face.colour[i] == parts[part] && parts[part] != other_colour) out[part].push_back(i);
  return out;
}

}  // namespace luxodus
