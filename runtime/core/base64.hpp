// Bytes as text (RFC 4648), for pages and messages that hold everything in themselves. Pure; any
// thread.
#pragma once

#include <string>
#include <string_view>

namespace luxodus {

std::string base64(std::string_view bytes);

}  // namespace luxodus
