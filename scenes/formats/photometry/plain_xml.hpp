// Parses untrusted XML without document types, and so without entities. Internal to the sources of
// this room that include pugixml: gldf_product.cpp and l3d.cpp. Any thread.
#pragma once

#include <fmt/format.h>

#include <pugixml.hpp>
#include <string>

#include "runtime/core/result.hpp"

namespace luxodus {

/// Parses `xml`, which the document does not refer to afterwards. Errors: no XML, or a document
/// type, with which entities come. `name`: of the file within its archive.
inline Result<void> load_plain_xml(pugi::xml_document& document, const std::string& xml,
                                   const char* name) {
  const auto parsed =
      document.load_buffer(xml.data(), xml.size(), pugi::parse_default | pugi::parse_doctype);
  if (!parsed)
    return problem(fmt::format("'{}' in it is no XML: {} at byte {}", name, parsed.description(),
                               parsed.offset));
  for (const pugi::xml_node node : document.children())
    if (node.type() == pugi::node_doctype)
      return problem(
          fmt::format("'{}' in it has a document type (DOCTYPE), which the format has not and "
                      "which may hide entities: it is not read",
                      name));
  return {};
}

}  // namespace luxodus
