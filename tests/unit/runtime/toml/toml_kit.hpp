// A small schema and short helpers for tests of the reader. Test code; one thread.
#pragma once

#include <catch2/catch.hpp>
#include <string>
#include <vector>

#include "runtime/toml/document.hpp"
#include "runtime/toml/table_reader.hpp"

namespace luxodus::toml {

inline const Schema& lamp_schema() {
  static const Schema schema{
      {{"lamp",
        "Top of the file",
        {{"title", "text", "", "\"\"", "", "a line for people"},
         {"name", "name", "", "required", "", "of the lamp"},
         {"height_m", "number", "m", "2.5", "(0, 10]", "above the floor"},
         {"max_tubes", "integer", "", "2", "[1, 8]", "tubes of it"},
         {"cache", "size", "B", "\"1 KiB\"", "[16, 1e6]", "memory"},
         {"lit", "flag", "", "true", "", "whether it shines"},
         {"colour", "choice", "", "\"warm\"", "warm, cold", "of its light"},
         {"at", "point", "m", "[1, 2, 3]", "[-10, 10]", "where it is"},
         {"curve", "pairs", "", "", "[0, 1]", "rows"},
         {"corners", "corners", "m", "", "[0, 1]", "rows"},
         {"levels", "numbers", "", "", "[0, 100]", "numbers"},
         {"tags", "texts", "", "", "", "words"},
         {"dims", "factors", "", "", "[0, 1]", "name = number"},
         {"says", "words", "", "", "", "name = text"},
         {"to", "names", "", "", "", "names"},
         {"links", "name pairs", "", "", "", "pairs"},
         {"plan", "path", "", "", "", "a file"},
         {"kind", "choice", "", "\"round\"", "round, long", "shape"},
         {"part", "tables", "", "", "", "parts"},
         {"mount", "table", "", "", "", "how it hangs"}}},
       {"lamp.round", "a round one", {{"radius_m", "number", "m", "required", "(0, 1]", "radius"}}},
       {"lamp.long", "a long one", {{"length_m", "number", "m", "1", "(0, 9]", "length"}}},
       {"mount", "`[mount]`", {{"hooks", "integer", "", "4", "[1, 8]", "hooks"}}}},
      {{"name", [](std::string_view text) { return text.find('/') == text.npos; },
        "a word without slashes"}}};
  return schema;
}

inline Document parsed(const std::string& text) {
  auto document = parse(text, "dir/lamp.toml", 1 << 20);
  if (!document) FAIL(document.problem().text());
  return std::move(document).value();
}

/// The messages that `read` causes for a text.
template <class Read>
std::vector<std::string> problems_of(const std::string& text, const Read& read) {
  const Document document = parsed(text);
  Findings findings;
  TableReader keys(document.top, lamp_schema(), {"lamp"}, findings);
  read(keys);
  std::vector<std::string> out;
  const Problems problems = findings.take_problems();
  for (const Problem& problem : problems.list()) out.push_back(problem.text());
  return out;
}

}  // namespace luxodus::toml
