// Parses untrusted XML without document types, and so without entities. Internal to the sources of
// this room that include pugixml: gldf_product.cpp and l3d.cpp. Any thread.
#pragma once

#include <fmt/format.h>

#include <optional>
#include <pugixml.hpp>
#include <string>

namespace luxodus {

/// Parses `xml`, which the document does not refer to afterwards. Returns the fault: no XML, or a
/// document type, which could define entities. `name`: of the file within its archive.
inline std::optional<std::string> load_plain_xml(pugi::xml_document& document,
                                                 const std::string& xml, const char* name) {
  const auto parsed =
      document.load_buffer(xml.data(), xml.size(), pugi::parse_default | pugi::parse_doctype);
  if (!parsed)
    return fmt::format("'{}' in it is no XML: {} at byte {}", name, parsed.description(),
                       parsed.offset);
  for (const pugi::xml_node node : document.children())
    if (node.type() == pugi::node_doctype)
      return fmt::format(
          "'{}' in it has a document type (DOCTYPE), which the format has not and "
          "which may hide entities: it is not read",
          name);
  return std::nullopt;
}

}  // namespace luxodus
