// Files of tables that a person edits and an import adds to at the end: what they name already, and
// what is to be added. Nothing in them is ever changed. One import at a time.
#pragma once

#include <filesystem>
#include <initializer_list>
#include <set>
#include <string>
#include <utility>

#include "runtime/core/result.hpp"

namespace luxodus {

struct OwnTables {
  std::filesystem::path file;
  std::string text;  // as it was; "" where there is no file
  /// Kinds and names of the tables in it: {"sign_type", "exit"}.
  std::set<std::pair<std::string, std::string>> named;
  std::string added;

  bool has(const std::string& kind, const std::string& name) const {
    return named.contains({kind, name});
  }
  /// Named by a table of that kind, or by one that is commented out.
  bool mentions(const std::string& kind, const std::string& name) const;
};

/// `kinds` of tables whose names count. Errors: a file that cannot be read or is no TOML.
Result<OwnTables> own_tables(const std::filesystem::path& file,
                             std::initializer_list<const char*> kinds);

/// Writes it with what was added; `head` opens a new file. Errors: as write_file_atomically.
Result<void> save(const OwnTables& tables, const std::string& head);

}  // namespace luxodus
