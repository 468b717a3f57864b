#include "scenes/light/transport/eye_paths.hpp"

namespace luxodus {

int64_t value_score(double mean) {
  constexpr double most = 0x1p62;
  const double scaled = mean / limits::value_quantum;
  return static_cast<int64_t>(std::llround(std::clamp(scaled, -most, most)));
}

FaceTexels list_texels(const SignFace& face) {
  FaceTexels out;
  for (uint32_t i = 0; i < face.colour.size(); ++i) {
    if (face.colour[i] == SignColour::white) out.white.push_back(i);
    if (face.colour[i] == SignColour::green) out.green.push_back(i);
  }
  return out;
}

}  // namespace luxodus
