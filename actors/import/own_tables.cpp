#include "actors/import/own_tables.hpp"

#include "actors/import/import_files.hpp"
#include "runtime/core/atomic_file.hpp"
#include "runtime/core/regular_file.hpp"
#include "runtime/toml/document.hpp"

namespace luxodus {

namespace fs = std::filesystem;

namespace {

/// The limit of every scene file.
constexpr size_t max_table_bytes = size_t{16} << 20;

}  // namespace

bool OwnTables::mentions(const std::string& kind, const std::string& name) const {
  if (has(kind, name)) return true;
  const std::string words = "name = " + toml_text(name) + "\n", head = "[[" + kind + "]]";
  for (size_t at = text.find(words); at != std::string::npos; at = text.find(words, at + 1))
    if (const size_t table = text.rfind("[[", at);
        table != std::string::npos && text.compare(table, head.size(), head) == 0)
      return true;
  return false;
}

Result<OwnTables> own_tables(const fs::path& file, std::initializer_list<const char*> kinds) {
  OwnTables out;
  out.file = file;
  std::error_code failed;
  if (!fs::exists(fs::symlink_status(file, failed))) return out;
  auto text = read_regular_file(file, max_table_bytes);
  if (!text) return text.problem();
  out.text = std::move(text).value();
  const auto document = toml::parse(out.text, file.string(), max_table_bytes);
  if (!document) return document.problem();
  for (const char* kind : kinds) {
    const toml::Value* list = document->top.find(kind);
    if (list == nullptr || list->as_list() == nullptr) continue;
    for (const toml::Value& table : *list->as_list()) {
      const toml::Value* name = table.as_table() ? table.as_table()->find("name") : nullptr;
      if (name != nullptr && name->as_text()) out.named.insert({kind, *name->as_text()});
    }
  }
  return out;
}

Result<void> save(const OwnTables& tables, const std::string& head) {
  if (!tables.text.empty() && tables.added.empty()) return {};
  const std::string text = (tables.text.empty() ? head : tables.text) + tables.added;
  return write_file_atomically(tables.file, std::string_view(text));
}

}  // namespace luxodus
