#include "actors/import/hand_changes.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <string_view>

#include "runtime/core/text.hpp"

namespace luxodus {

namespace {

/// A table with what follows it, up to the next; the part before the first has no key.
struct Block {
  std::string key;   // kind, GlobalId, and how many of these came before; "" if it has no GlobalId
  std::string head;  // "[[import]]"; "" before the first table
  std::string name;  // or what the table matches
  std::string_view text;
};

/// The text in quotes of a line `key = "text"`, also of one that is a comment.
std::string quoted_after(std::string_view text, std::string_view key) {
  for (size_t at = text.find(key); at != std::string_view::npos; at = text.find(key, at + 1)) {
    const size_t line = text.rfind('\n', at) + 1;
    const std::string_view before = text.substr(line, at - line);
    if (before.find_first_not_of("# ") != std::string_view::npos) continue;
    const size_t open = text.find('"', at), end = text.find('\n', at);
    const size_t close = open == std::string_view::npos ? open : text.find('"', open + 1);
    if (close == std::string_view::npos || close > end) continue;
    return std::string(text.substr(open + 1, close - open - 1));
  }
  return {};
}

std::vector<Block> blocks_of(std::string_view text) {
  constexpr std::array<std::string_view, 4> kinds{"[[open_area]]", "[[emphasis]]", "[[luminaire]]",
                                                  "[[sign]]"};
  std::vector<Block> out;
  std::map<std::string, int> count;
  for (size_t from = 0; from < text.size();) {
    size_t end = text.find("\n[[", from + 1);
    end = end == std::string_view::npos ? text.size() : end + 1;
    Block block{{}, {}, {}, text.substr(from, end - from)};
    if (block.text.starts_with("[[")) block.head = block.text.substr(0, block.text.find("]]") + 2);
    block.name = quoted_after(block.text, "name = ");
    if (block.name.empty()) block.name = quoted_after(block.text, "match = ");
    const auto kind = std::find_if(kinds.begin(), kinds.end(),
                                   [&](std::string_view k) { return block.text.starts_with(k); });
    const std::string guid = quoted_after(block.text, "ifc_guid = ");
    if (kind != kinds.end() && !guid.empty()) {
      const std::string key = std::string(*kind) + " " + guid;
      block.key = key + " " + std::to_string(++count[key]);
    }
    out.push_back(std::move(block));
    from = end;
  }
  return out;
}

/// Without comments: that before the first table names the file of the model, and others state
/// elevations.
std::string settings_of(std::string_view text) {
  std::string out;
  while (!text.empty()) {
    const std::string_view line = text.substr(0, text.find('\n'));
    text.remove_prefix(std::min(line.size() + 1, text.size()));
    if (line.find_first_not_of(" \t\r") == std::string_view::npos) continue;
    if (line[line.find_first_not_of(" \t")] != '#') out += std::string(trimmed(line)) + "\n";
  }
  return out;
}

/// Tables that a person has changed or added, and that the text to be written does not have.
std::vector<std::string> lost_changes(const std::vector<Block>& now,
                                      const std::vector<Block>& written, const std::string& text) {
  std::set<std::string> known;
  for (const std::vector<Block>& blocks : {written, blocks_of(text)})
    for (const Block& block : blocks) known.insert(settings_of(block.text));
  std::vector<std::string> out;
  for (const Block& block : now)
    if (!known.contains(settings_of(block.text)))
      out.push_back(
          "not kept: " + (block.head.empty() ? "the lines before the first table" : block.head) +
          (block.name.empty() ? "" : " \"" + block.name + "\"") +
          "; make the change in scene.toml");
  return out;
}

}  // namespace

HandChanges with_hand_changes(const std::string& fresh, const std::string& now,
                              const std::string& written) {
  const std::vector<Block> all_now = blocks_of(now), all_written = blocks_of(written);
  std::map<std::string, Block> in_now, in_written;
  for (const Block& block : all_now)
    if (!block.key.empty()) in_now.emplace(block.key, block);
  for (const Block& block : all_written)
    if (!block.key.empty()) in_written.emplace(block.key, block);
  HandChanges out;
  for (const Block& block : blocks_of(fresh)) {
    const auto was = in_written.find(block.key);
    if (block.key.empty() || was == in_written.end()) {
      out.text += block.text;
      continue;
    }
    const auto is = in_now.find(block.key);
    if (is == in_now.end()) {
      out.notes.push_back("\"" + block.name + "\" was left out, as in building.toml");
    } else if (trimmed(is->second.text) != trimmed(was->second.text)) {
      out.text += trimmed(is->second.text);
      out.text += "\n\n";
      out.notes.push_back("\"" + is->second.name + "\" was kept as building.toml had it changed");
    } else {
      out.text += block.text;
    }
  }
  for (std::string& note : lost_changes(all_now, all_written, out.text))
    out.notes.push_back(std::move(note));
  return out;
}

}  // namespace luxodus
