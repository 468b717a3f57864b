// The frame of every page that is a single file: head, style and end. The caller writes the
// content. The page of the live view is built by npm instead. Pure; any thread.
#pragma once

#include <string>
#include <string_view>

namespace luxodus {

struct HtmlHead {
  std::string_view language = "en";  // BCP 47
  std::string_view title;            // plain text
  std::string_view style;            // CSS
};

std::string html_page(const HtmlHead& head, std::string_view body);

/// Style of pages of tables and drawings, for people who check numbers.
inline constexpr std::string_view html_table_style =
    "body { font-family: sans-serif; max-width: 72rem; margin: 2rem auto; padding: 0 1rem; }\n"
    "table { border-collapse: collapse; font-size: 0.8rem; margin: 0.5rem 0; }\n"
    "td, th { border: 1px solid #bbb; padding: 0.15rem 0.4rem; text-align: right; }\n";

}  // namespace luxodus
