#include "actors/results/formats/html_page.hpp"

#include <fmt/format.h>

#include "runtime/core/output_text.hpp"

namespace luxodus {

std::string html_page(const HtmlHead& head, std::string_view body) {
  return fmt::format(
      "<!doctype html>\n<html lang=\"{}\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
      "<title>{}</title>\n<style>\n{}</style>\n</head>\n<body>\n{}</body>\n</html>\n",
      head.language, xml_escape(head.title), head.style, body);
}

}  // namespace luxodus
