// Parses TOML text into values. The text is bounded in length and nesting before the parser sees
// it. document.cpp is the only file of the program that includes the parser. Pure; any thread.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <string_view>

#include "runtime/core/result.hpp"
#include "runtime/toml/value.hpp"

namespace luxodus::toml {

/// A parsed text. Its values refer to it.
struct Document {
  std::shared_ptr<const std::string> file;  // all origins point to it
  Table top;
};

/// Whether a problem may quote the text.
enum class QuotePolicy { allowed, withheld };

/// `file` names the text in problems.
/// Errors: longer than `max_bytes`; nested too deep; not TOML.
Result<Document> parse(std::string_view text, const std::string& file, size_t max_bytes,
                       QuotePolicy quoting = QuotePolicy::allowed);

}  // namespace luxodus::toml
