#include "actors/import/hand_changes.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <string_view>

namespace luxodus {

namespace {

/// A table with what follows it, up to the next; the part before the first has no key.
struct Block {
  std::string key;  // kind, GlobalId, and how many of these came before; "" if it has no GlobalId
  std::string name;
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
    Block block{{}, {}, text.substr(from, end - from)};
    const auto kind = std::find_if(kinds.begin(), kinds.end(),
                                   [&](std::string_view k) { return block.text.starts_with(k); });
    const std::string guid = quoted_after(block.text, "ifc_guid = ");
    if (kind != kinds.end() && !guid.empty()) {
      const std::string key = std::string(*kind) + " " + guid;
      block.key = key + " " + std::to_string(++count[key]);
      block.name = quoted_after(block.text, "name = ");
    }
    out.push_back(std::move(block));
    from = end;
  }
  return out;
}

std::string_view trimmed(std::string_view text) {
  const size_t end = text.find_last_not_of(" \t\r\n");
  return end == std::string_view::npos ? std::string_view() : text.substr(0, end + 1);
}

}  // namespace

HandChanges with_hand_changes(const std::string& fresh, const std::string& now,
                              const std::string& written) {
  std::map<std::string, Block> in_now, in_written;
  for (Block& block : blocks_of(now))
    if (!block.key.empty()) in_now.emplace(block.key, block);
  for (Block& block : blocks_of(written))
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
  return out;
}

}  // namespace luxodus
