// Files of tables that the user edits and an import extends at the end: the names in them, and what
// is to be added. Existing text is never changed. Any thread, one import at a time.
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
  std::string text;  // as it was; "" if there is no file
  /// Kinds and names of the tables in it: {"sign_type", "exit"}.
  std::set<std::pair<std::string, std::string>> named;
  std::string added;

  bool has(const std::string& kind, const std::string& name) const {
    return named.contains({kind, name});
  }
  /// Whether a table of that kind, or one that is commented out, has this name.
  bool mentions(const std::string& kind, const std::string& name) const;
};

/// `kinds`: tables whose names count. Errors: a file that cannot be read or is not TOML.
Result<OwnTables> own_tables(const std::filesystem::path& file,
                             std::initializer_list<const char*> kinds);

/// Writes it with the additions; `head` begins a new file. Errors: as write_file_atomically.
Result<void> save(const OwnTables& tables, const std::string& head);

}  // namespace luxodus
