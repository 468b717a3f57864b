// Smoke of a fire simulation at a time between two of its frames. Plain values; any thread.
#pragma once

namespace luxodus {

enum class FireFrames {
  between,  // linear interpolation: for light, pictures and films
  nearest,  // the nearer frame: for verdicts, which refer to computed states
};

}  // namespace luxodus
