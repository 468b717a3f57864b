#include "scenes/light/transport/eye_paths.hpp"

namespace luxodus {

FaceTexels list_texels(const SignFace& face) {
  FaceTexels out;
  for (uint32_t i = 0; i < face.colour.size(); ++i) {
    if (face.colour[i] == SignColour::white) out.white.push_back(i);
    if (face.colour[i] == SignColour::green) out.green.push_back(i);
  }
  return out;
}

}  // namespace luxodus
