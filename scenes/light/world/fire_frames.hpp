// Which smoke a fire simulation has at a time that lies between two of its frames. Values only.
#pragma once

namespace luxodus {

enum class FireFrames {
  between,  // linear between the two: for light, pictures and films
  nearest,  // that of the nearer one: for verdicts, which are of what was computed
};

}  // namespace luxodus
