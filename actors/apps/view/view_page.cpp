// The page as bytes of the program. CMake selects the file: what npm has built, or a page that says
// why there is none.
#include <cstddef>

#include "actors/apps/view/view_server.hpp"

asm(".section .rodata\n"
    ".global lux_view_page_begin\n"
    "lux_view_page_begin:\n"
    ".incbin \"" LUX_VIEW_PAGE
    "\"\n"
    ".global lux_view_page_end\n"
    "lux_view_page_end:\n"
    ".byte 0\n"
    ".previous\n");

extern "C" {
extern const char lux_view_page_begin[];
extern const char lux_view_page_end[];
}

namespace luxodus {

std::string_view view_page() {
  return {lux_view_page_begin, static_cast<size_t>(lux_view_page_end - lux_view_page_begin)};
}

}  // namespace luxodus
