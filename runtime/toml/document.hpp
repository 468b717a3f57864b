// From a text to the values in it. The text is bounded in length and in depth before the parser
// sees it. The only file of the program that includes the parser is document.cpp. Any thread.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <string_view>

#include "runtime/core/result.hpp"
#include "runtime/toml/value.hpp"

namespace luxodus::toml {

/// A parsed text. What is found in it refers to it.
struct Document {
  std::shared_ptr<const std::string> file;  // to which all origins point
  Table top;
};

/// Whether a problem may repeat words of the text.
enum class Quoting { allowed, withheld };

/// `file` names the text in problems.
/// Errors: longer than `max_bytes`; nested too deep; not TOML.
Result<Document> parse(std::string_view text, const std::string& file, size_t max_bytes,
                       Quoting quoting = Quoting::allowed);

}  // namespace luxodus::toml
