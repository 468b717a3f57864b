// What viewers wish, as text that travels to the nodes that trace it. Pure; any thread.
#pragma once

#include <string>
#include <string_view>

#include "actors/view/live_scene.hpp"

namespace luxodus {

namespace limits {
inline constexpr size_t wish_bytes = 1 << 20;
}  // namespace limits

/// Equal wishes have equal texts, and numbers keep every bit.
std::string wish_text(const LiveWish& wish);

/// Errors: not such a text.
Result<LiveWish> parse_wish(std::string_view text);

}  // namespace luxodus
