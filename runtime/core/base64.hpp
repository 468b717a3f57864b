// Base64 (RFC 4648), for pages and messages that embed binary data. Pure; any thread.
#pragma once

#include <string>
#include <string_view>

namespace luxodus {

std::string base64(std::string_view bytes);

}  // namespace luxodus
