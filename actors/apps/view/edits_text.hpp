// Edits of viewers as text, which is sent to the nodes that trace them. Pure; any thread.
#pragma once

#include <string>
#include <string_view>

#include "actors/apps/view/live_scene.hpp"

namespace luxodus {

namespace limits {
inline constexpr size_t edits_bytes = 1 << 20;
}  // namespace limits

/// Equal edits have equal texts, and numbers keep every bit.
std::string edits_text(const SceneEdits& edits);

/// Errors: malformed text.
Result<SceneEdits> parse_edits(std::string_view text);

}  // namespace luxodus
