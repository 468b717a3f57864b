// From a file to the tables in it: what every reader of our TOML files does first. The text is
// bounded, in length and in depth, before the parser sees it. Any thread.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

#include "runtime/config/table_reader.hpp"
#include "runtime/core/toml_nesting.hpp"

namespace luxodus::config {

/// The text of a file. Errors: a folder; not there, not readable. What is longer than `most_bytes`
/// comes with one byte more, for read_document() to refuse.
Result<std::string> text_of_file(const std::filesystem::path& file, size_t most_bytes);

/// Parses a text and has `read(table)` go through it; what is wrong with it is in `findings` by
/// then, or told of the text as a whole. `start` names the file.
template <class Read>
Problems read_document(std::string_view text, const SourcePlace& start, size_t most_bytes,
                       Findings& findings, Read&& read) {
  const auto only = [&](int line, std::string what) {
    Problems problems;
    problems.add({start.file, line}, std::move(what));
    return problems;
  };
  if (text.size() > most_bytes)
    return only(0, "this file is longer than " + std::to_string(most_bytes) +
                       " bytes, the most that is read");
  if (const auto deep = too_deep_toml(text, start.file)) return only(deep->where.line, deep->what);
  try {
    read(toml::parse(text, start.file));
  } catch (const toml::parse_error& e) {
    return only(static_cast<int>(e.source().begin.line),
                "this is not TOML: " + std::string(e.description()));
  }
  return findings.take();
}

}  // namespace luxodus::config
