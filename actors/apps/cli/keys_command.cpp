// luxodus keys: prints help about keys from the schemas by which files are read.
#include <algorithm>
#include <cstdio>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "actors/apps/cli/command.hpp"
#include "actors/apps/cli/commands.hpp"
#include "actors/apps/cli/words.hpp"
#include "actors/import/write_plan.hpp"
#include "actors/lab/study/study_schema.hpp"
#include "runtime/config/cluster_schema.hpp"
#include "runtime/toml/words.hpp"
#include "scenes/formats/scene_file/scene_schema.hpp"

namespace luxodus::cli {

namespace {

struct KeysOptions {
  std::string kind;
  std::vector<std::string> names;
  bool markdown = false;
};

const toml::Schema& schema_of(const std::string& kind) {
  return kind == "cluster" ? config::cluster_schema()
         : kind == "study" ? study_schema()
         : kind == "plan"  ? plan_schema()
                           : scene_schema();
}

/// Removes backquotes from headings and meanings, which are written for Markdown.
std::string without_backquotes(std::string_view text) {
  std::string out;
  std::copy_if(text.begin(), text.end(), std::back_inserter(out), [](char c) { return c != '`'; });
  return out;
}

std::string described_key(const toml::KeySpec& key) {
  std::vector<std::string> more{std::string(key.type)};
  if (!key.unit.empty()) more.back() += " in " + std::string(key.unit);
  if (!key.range.empty()) more.emplace_back(key.range);
  if (key.fallback == "required")
    more.emplace_back(key.fallback);
  else if (!key.fallback.empty())
    more.push_back("default: " + std::string(key.fallback));
  return without_backquotes(key.meaning) + " (" + joined(more, "; ") + ")";
}

/// A table with those keys for which `wanted` holds; "" without any.
template <class Wanted>
std::string table_text(const toml::TableSpec& table, const Wanted& wanted) {
  std::string rows;
  for (const toml::KeySpec& key : table.keys)
    if (wanted(key)) rows += entry(std::string(key.name), described_key(key));
  return rows.empty() ? rows : "\n" + filled(without_backquotes(table.heading), 0) + "\n" + rows;
}

/// `word` names a table, which is shown with its kinds, or a key.
std::string text_of(const toml::Schema& schema, const std::string& word) {
  std::string out;
  const auto every = [](const toml::KeySpec&) { return true; };
  for (const toml::TableSpec& table : schema.tables)
    if (table.name == word || table.name.starts_with(word + ".")) out += table_text(table, every);
  if (!out.empty()) return out;
  for (const toml::TableSpec& table : schema.tables)
    out += table_text(table, [&](const toml::KeySpec& key) { return key.name == word; });
  return out;
}

Problem unknown(const toml::Schema& schema, const std::string& word) {
  std::vector<std::string_view> known;
  for (const toml::TableSpec& table : schema.tables) {
    known.push_back(table.name);
    for (const toml::KeySpec& key : table.keys) known.push_back(key.name);
  }
  const auto near = toml::nearest_word(word, known);
  return problem("no table or key is called \"" + word + "\"" +
                 (near ? ": did you mean " + std::string(*near) + "?"
                       : "; without a name all tables are listed"));
}

std::string tables_text(const toml::Schema& schema) {
  std::string out;
  for (const toml::TableSpec& table : schema.tables)
    out += entry(std::string(table.name), without_backquotes(table.heading));
  return out;
}

Result<void> print_keys(const KeysOptions& options) {
  const toml::Schema& schema = schema_of(options.kind);
  std::string out;
  if (options.markdown)
    out = toml::schema_markdown(schema);
  else if (options.names.empty())
    out = tables_text(schema);
  for (const std::string& word : options.names) {
    const std::string text = text_of(schema, word);
    if (text.empty()) return unknown(schema, word);
    out += text;
  }
  if (out.starts_with('\n')) out.erase(0, 1);
  std::fputs(out.c_str(), stdout);
  return {};
}

}  // namespace

Command keys_command() {
  const auto o = std::make_shared<KeysOptions>();
  return {.name = "keys",
          .summary = "Explain the keys of scene, cluster, study and plan files",
          .heading = "Tools",
          .options = {{"kind",
                       &o->kind,
                       "Kind of the file",
                       {.choices = {"scene", "cluster", "study", "plan"}, .required = true}},
                      {"name",
                       &o->names,
                       "Tables or keys that are shown",
                       {.otherwise = "a list of all tables"}},
                      {"--markdown",
                       &o->markdown,
                       "All tables as the reference of the documents has them",
                       {.excludes = "name"}}},
          .notes =
              "  luxodus keys scene                  all tables of a scene file\n"
              "  luxodus keys scene medium           the keys of [[medium]], of all its kinds\n"
              "  luxodus keys scene maintenance_factor",
          .run = [o] { return exit_code_of(print_keys(*o)); }};
}

}  // namespace luxodus::cli
