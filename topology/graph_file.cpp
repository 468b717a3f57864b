#include "topology/graph_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <optional>
#include <utility>
#include <vector>

#include "runtime/core/printable.hpp"

namespace luxodus {
namespace {

constexpr std::string_view format_name = "luxodus graph 1";

constexpr std::array<std::pair<std::string_view, ControllerRole>, 3> roles{{
    {"none", ControllerRole::none},
    {"endpoint", ControllerRole::endpoint},
    {"forwards", ControllerRole::forwards},
}};

std::string_view name_of(ControllerRole role) {
  for (const auto& [name, known] : roles) {
    if (known == role) return name;
  }
  return {};
}

}  // namespace

std::string graph_text(const Graph& graph) {
  constexpr size_t columns = 96;
  std::string text = fmt::format(
      "format = \"{}\"\n"
      "nodes = {}\n"
      "max_links = {}  # of a node\n"
      "controller = \"{}\"{}\n"
      "rotation = {}  # turned by 1/{}, node v becomes v + {}, the links stay the same\n"
      "links = [  # {}\n",
      format_name, graph.workers(), graph.max_links(), name_of(graph.controller_role()),
      graph.has_controller() ? fmt::format("  # vertex {}", graph.controller()) : "",
      graph.rotation(), graph.rotation(), graph.workers() / graph.rotation(), graph.links().size());
  std::string line = " ";
  for (const GraphLink& link : graph.links()) {
    const std::string item = fmt::format(" [{}, {}],", link.a, link.b);
    if (line.size() + item.size() > columns) {
      text += line + "\n";
      line = " ";
    }
    line += item;
  }
  if (line.size() > 1) text += line + "\n";
  return text + fmt::format("]\nhash = \"{:016x}\"\n", graph.hash());
}

namespace {

/// Parses the text from front to back. The first fault is kept, and all later calls fail.
class GraphParser {
 public:
  GraphParser(std::string_view text, const std::string& file) : text_(text), file_(file) {}

  Result<Graph> parse() {
    if (text_.size() > limits::graph_file_bytes) {
      fail(fmt::format("this file is longer than {} bytes, the most a graph takes",
                       limits::graph_file_bytes));
    }
    read_keys();
    if (fault_) return *fault_;
    if (const auto wrong = fault_of(plan_)) {
      line_ = wrong->link ? link_lines_[*wrong->link] : key_lines_[links_key];
      return problem_in(file_, line_, wrong->what);
    }
    Graph graph(std::move(plan_));
    const std::string hash = fmt::format("{:016x}", graph.hash());
    if (hash != hash_) {
      return problem_in(
          file_, key_lines_[hash_key],
          fmt::format("the hash of this graph is {}: the file was changed or cut; write "
                      "that hash if the change is meant",
                      hash));
    }
    return graph;
  }

 private:
  enum Key {
    format_key,
    nodes_key,
    max_links_key,
    controller_key,
    rotation_key,
    links_key,
    hash_key,
    keys
  };
  static constexpr std::array<std::string_view, keys> key_names{
      "format", "nodes", "max_links", "controller", "rotation", "links", "hash"};

  void read_keys() {
    for (skip_blanks(); !fault_ && at_ < text_.size(); skip_blanks()) {
      const int line = line_;
      const std::string_view name = word();
      size_t key = 0;
      while (key < keys && key_names[key] != name) ++key;
      if (key == keys) return fail(fmt::format("there is no key \"{}\" in a graph", excerpt(name)));
      if (key_lines_[key] > 0) return fail(fmt::format("\"{}\" is given twice", name));
      if (key != format_key && key_lines_[format_key] == 0) break;
      key_lines_[key] = line;
      if (expect('=')) read_value(static_cast<Key>(key));
      end_line();
    }
    if (key_lines_[format_key] == 0) {
      line_ = 1;
      return fail(fmt::format("a graph begins with format = \"{}\"", format_name));
    }
    for (size_t key = 0; key < keys; ++key) {
      if (key_lines_[key] == 0) return fail(fmt::format("\"{}\" is missing", key_names[key]));
    }
  }

  void read_value(Key key) {
    switch (key) {
      case format_key:
        if (const auto name = quoted(); !fault_ && name != format_name) {
          fail(
              fmt::format("this format is not known here; this program reads \"{}\"", format_name));
        }
        return;
      case nodes_key:
        plan_.workers = number();
        return;
      case max_links_key:
        plan_.max_links = number();
        return;
      case controller_key:
        read_role();
        return;
      case rotation_key:
        plan_.rotation = number();
        return;
      case links_key:
        read_links();
        return;
      default:
        hash_ = quoted();
    }
  }

  void read_role() {
    const std::string_view name = quoted();
    for (const auto& [known, role] : roles) {
      if (known == name) {
        plan_.controller = role;
        return;
      }
    }
    fail("the controller is \"none\", \"endpoint\" (it forwards nothing) or \"forwards\"");
  }

  void read_links() {
    if (!expect('[')) return;
    while (!fault_ && !next_is(']')) {
      const int line = line_;
      if (!expect('[')) return;
      const Vertex a = number();
      if (!expect(',')) return;
      const Vertex b = number();
      if (!expect(']')) return;
      plan_.links.push_back({a, b});
      link_lines_.push_back(line);
      if (!next_is(',')) {
        expect(']');
        return;
      }
      expect(',');
    }
    expect(']');
  }

  void fail(std::string what) {
    if (!fault_) fault_ = problem_in(file_, line_, std::move(what));
  }

  void skip_blanks() {
    for (; at_ < text_.size(); ++at_) {
      const char c = text_[at_];
      if (c == '#') {
        at_ = std::min(text_.find('\n', at_), text_.size()) - 1;
      } else if (c == '\n') {
        ++line_;
      } else if (c != ' ' && c != '\t' && c != '\r') {
        return;
      }
    }
  }

  void end_line() {
    const int line = line_;
    skip_blanks();
    if (at_ < text_.size() && line == line_) fail("one key and its value stand on a line");
  }

  bool next_is(char c) {
    skip_blanks();
    return at_ < text_.size() && text_[at_] == c;
  }

  bool expect(char c) {
    if (fault_) return false;
    if (!next_is(c)) {
      fail(fmt::format("\"{}\" is missing here", c));
      return false;
    }
    ++at_;
    return true;
  }

  /// Letters and underscores; empty if there are none.
  std::string_view word() {
    const size_t start = at_;
    while (at_ < text_.size() && ((text_[at_] >= 'a' && text_[at_] <= 'z') || text_[at_] == '_')) {
      ++at_;
    }
    return text_.substr(start, at_ - start);
  }

  uint32_t number() {
    skip_blanks();
    uint32_t value = 0;
    const char* end = text_.data() + text_.size();
    const auto [stop, error] = std::from_chars(text_.data() + at_, end, value);
    if (error != std::errc{}) fail("a whole number from 0 to 4294967295 is missing here");
    at_ = static_cast<size_t>(stop - text_.data());
    return value;
  }

  std::string_view quoted() {
    if (!expect('"')) return {};
    const size_t end = text_.find_first_of("\"\n", at_);
    if (end == std::string_view::npos || text_[end] != '"') {
      fail("the closing quotation mark is missing");
      return {};
    }
    const std::string_view inside = text_.substr(at_, end - at_);
    at_ = end + 1;
    return inside;
  }

  std::string_view text_;
  const std::string& file_;
  size_t at_ = 0;
  int line_ = 1;
  std::optional<Problem> fault_;
  GraphPlan plan_;
  std::string hash_;
  std::array<int, keys> key_lines_{};  // 0: not read yet
  std::vector<int> link_lines_;
};

}  // namespace

Result<Graph> parse_graph(std::string_view text, const std::string& file) {
  return GraphParser(text, file).parse();
}

}  // namespace luxodus
