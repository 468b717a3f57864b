#include "scenes/light/geometry/mesh_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string_view>
#include <vector>

#include "runtime/core/printable.hpp"
#include "scenes/light/geometry/import.hpp"

namespace luxodus {
namespace {

// ---- lines of words: OBJ and MTL ---------------------------------------------------------------

/// Removes and returns the first word of a line; "" if there is none.
std::string_view take_word(std::string_view& line) {
  constexpr std::string_view blanks = " \t\r";
  line.remove_prefix(std::min(line.find_first_not_of(blanks), line.size()));
  const std::string_view word = line.substr(0, line.find_first_of(blanks));
  line.remove_prefix(word.size());
  return word;
}

/// The rest of a line as one name, which may contain blanks.
std::string_view without_blanks(std::string_view rest) {
  constexpr std::string_view blanks = " \t\r";
  rest.remove_prefix(std::min(rest.find_first_not_of(blanks), rest.size()));
  return rest.substr(0, rest.find_last_not_of(blanks) + 1);
}

/// Whether a word could be a number, NaN and infinity included.
bool starts_like_number(std::string_view word) {
  if (word.front() == '-' || word.front() == '+') word.remove_prefix(1);
  return word.find_first_of("0123456789.nNiI") == 0;
}

/// Whether a word that starts like a number is a number that a float can hold.
bool is_finite(std::string_view word) {
  if (word.front() == '+') word.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error == std::errc::result_out_of_range) return word.find("e-") != std::string_view::npos;
  return error == std::errc() && std::isfinite(static_cast<float>(value));
}

/// Whether the words are those of a vertex or texture vertex.
Result<void> check_vertex(std::string_view rest, int numbers, bool must_be_finite) {
  for (int i = 0; i < numbers; ++i) {
    const std::string_view word = take_word(rest);
    if (word.empty() || word == "\\") break;  // continues in the next line, or left to Assimp
    if (!starts_like_number(word))
      return problem(
          fmt::format("a coordinate of this vertex is no number: give {} numbers", numbers));
    if (must_be_finite && !is_finite(word))
      return problem("a texture coordinate is not a finite number: give two numbers");
  }
  return {};
}

// ---- glTF --------------------------------------------------------------------------------------

/// The JSON of a glTF, text or binary. Errors: no binary glTF of version 2, one cut short.
Result<std::string> json_of(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  std::string text(12, '\0');
  in.read(text.data(), 12);
  text.resize(static_cast<size_t>(in.gcount()));
  if (!text.starts_with("glTF")) {
    in.clear();
    in.seekg(0);
    return std::string(std::istreambuf_iterator<char>(in), {});
  }
  // glTF 2.0, 4.4: a chunk begins with its length and its type; the first is the JSON.
  uint32_t words[2] = {0, 0};
  in.read(reinterpret_cast<char*>(words), sizeof words);
  if (!in || words[1] != 0x4E4F534A || words[0] > limits::mesh_file_bytes)
    return problem_in(path, "it is no binary glTF 2.0: no chunk of JSON follows its head");
  text.clear();
  std::copy_n(std::istreambuf_iterator<char>(in), words[0], std::back_inserter(text));
  if (text.size() < words[0]) return problem_in(path, "it is cut short: copy it again");
  return text;
}

/// Whether brackets outside strings nest deeper than the limit.
bool nests_too_deep(std::string_view json) {
  int depth = 0;
  bool in_string = false;
  for (size_t i = 0; i < json.size(); ++i) {
    const char c = json[i];
    if (in_string) {
      if (c == '\\') ++i;
      in_string = c != '"';
    } else if (c == '"') {
      in_string = true;
    } else if (c == '[' || c == '{') {
      if (++depth > limits::gltf_nesting) return true;
    } else if (c == ']' || c == '}') {
      --depth;
    }
  }
  return false;
}

/// The parent of each node; -1 for roots. Errors: a node with two parents.
Result<std::vector<int64_t>> parents_of(const nlohmann::json& nodes, const std::string& path) {
  std::vector<int64_t> parents(nodes.size(), -1);
  for (size_t i = 0; i < nodes.size(); ++i) {
    const auto children = nodes[i].is_object() ? nodes[i].find("children") : nodes[i].end();
    if (children == nodes[i].end() || !children->is_array()) continue;
    for (const nlohmann::json& child : *children) {
      if (!child.is_number_unsigned() || child.get<uint64_t>() >= nodes.size())
        return problem_in(path, fmt::format("node {} has a child that there is not", i));
      int64_t& parent = parents[child.get<uint64_t>()];
      if (parent >= 0)
        return problem_in(
            path, fmt::format("node {} is a child of node {} and again of node {}: the nodes "
                              "of a glTF form trees; export it anew",
                              child.get<uint64_t>(), parent, i));
      parent = static_cast<int64_t>(i);
    }
  }
  return parents;
}

Result<void> check_nodes(const nlohmann::json& gltf, const std::string& path) {
  const auto nodes = gltf.find("nodes");
  if (nodes == gltf.end() || !nodes->is_array()) return {};
  if (nodes->size() > limits::mesh_parts)
    return problem_in(path, fmt::format("it has {} nodes, the most are {}: simplify or split it",
                                        nodes->size(), limits::mesh_parts));
  const auto parents = parents_of(*nodes, path);
  if (!parents) return parents.problem();
  // Walks up from each node and stops at a node whose depth is already known.
  std::vector<int> depth(nodes->size(), 0);
  std::vector<size_t> way;
  for (size_t start = 0; start < depth.size(); ++start) {
    way.clear();
    auto at = static_cast<int64_t>(start);
    for (; at >= 0 && depth[static_cast<size_t>(at)] == 0;
         at = parents.value()[static_cast<size_t>(at)]) {
      way.push_back(static_cast<size_t>(at));
      depth[static_cast<size_t>(at)] = -1;
    }
    int above = at < 0 ? 0 : depth[static_cast<size_t>(at)];
    if (above < 0) return problem_in(path, fmt::format("node {} is its own ancestor", at));
    for (auto node = way.rbegin(); node != way.rend(); ++node) depth[*node] = ++above;
    if (above > limits::gltf_node_depth)
      return problem_in(path,
                        fmt::format("its nodes are more than {} deep: flatten the tree of objects "
                                    "before exporting",
                                    limits::gltf_node_depth));
  }
  return {};
}

/// Reads a line that ends in LF, CR LF or CR.
bool get_any_line(std::istream& in, std::string& line) {
  line.clear();
  for (int c = in.get(); c != std::istream::traits_type::eof(); c = in.get()) {
    if (c == '\r' && in.peek() == '\n') in.get();
    if (c == '\r' || c == '\n') return true;
    line.push_back(static_cast<char>(c));
  }
  return !line.empty();
}

}  // namespace

std::string mesh_ending(const std::string& path) {
  std::string ending = std::filesystem::path(path).extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return ending;
}

void ObjMaterials::names_library(std::string_view rest) {
  libraries_.emplace_back(without_blanks(rest));
}

void ObjMaterials::uses(std::string_view rest, int line) {
  first_use_.try_emplace(std::string(without_blanks(rest)), line);
}

void ObjMaterials::add_library(const std::string& path) {
  read_.push_back(path);
  std::ifstream in(path, std::ios::binary);
  std::string line;
  Declared* material = nullptr;
  for (int number = 1; get_any_line(in, line); ++number) {
    std::string_view rest = line;
    const std::string_view word = take_word(rest);
    if (word == "newmtl") {
      const std::string name(without_blanks(rest));
      material = &declared_.try_emplace(name, Declared{{path, number}}).first->second;
    } else if (material != nullptr && (word == "Kd" || word == "kd")) {
      const std::string_view value = take_word(rest);  // "spectral" and "xyz" are not colours
      material->has_colour |= !value.empty() && starts_like_number(value);
    } else if (material != nullptr && (word == "map_Kd" || word == "map_kd")) {
      material->has_picture |= !without_blanks(rest).empty();
    }
  }
}

Result<void> ObjMaterials::has_colour(const std::string& material) const {
  const std::string name = "'" + excerpt(material) + "'";
  const auto known = declared_.find(material);
  if (known != declared_.end()) {
    const auto& [place, has_colour, has_picture] = known->second;
    if (has_picture)
      return problem_in(place, "the colour of the material " + name +
                                   " is in a picture (\"map_Kd\"), and pictures are not read");
    if (has_colour) return {};
    return problem_in(place, "the material " + name +
                                 " has no colour here: give it \"Kd\" with three numbers from 0 to "
                                 "1");
  }
  const auto use = first_use_.find(material);
  const SourcePlace place{obj_, use != first_use_.end() ? use->second : 0};
  if (libraries_.empty())
    return problem_in(place, "the material " + name +
                                 " has no colour: this file names no material library "
                                 "(\"mtllib FILE.mtl\")");
  if (read_.empty())
    return problem_in(place, "the material " + name + " has no colour: the material library '" +
                                 excerpt(libraries_.front()) +
                                 "' is not there; it lies beside this file where it was exported "
                                 "(one \"mtllib\" line for each file, without blanks at its end)");
  return problem_in(place, "the material " + name + " has no colour: no \"newmtl " +
                               excerpt(material) + "\" is in " + excerpt(read_.front(), 200));
}

Result<void> check_obj(const std::string& path, ObjMaterials& materials) {
  std::ifstream in(path, std::ios::binary);
  std::string line;
  uint64_t groups = 0;
  for (int number = 1; std::getline(in, line); ++number) {
    std::string_view rest = line;
    const std::string_view word = take_word(rest);
    if (word == "v" || word == "vt") {
      if (auto ok = check_vertex(rest, word == "v" ? 3 : 2, word == "vt"); !ok)
        return problem_in(path, number, ok.problem());
    } else if (word == "o" || word == "g") {
      if (++groups > limits::obj_groups)
        return problem_in(path, number,
                          fmt::format("more than {} objects and groups: join some before exporting",
                                      limits::obj_groups));
    } else if (word == "mtllib") {
      materials.names_library(rest);
    } else if (word == "usemtl") {
      materials.uses(rest, number);
    }
  }
  return {};
}

Result<void> check_mtl(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  std::string line;
  for (int number = 1; std::getline(in, line); ++number) {
    std::string_view rest = line;
    const std::string_view word = take_word(rest);
    if (word == "newmtl") return {};
    if (word.empty() || word.front() == '#') continue;
    return problem_in(path, number,
                      "this stands before the first material: begin it with \"newmtl NAME\"");
  }
  return {};
}

Result<void> check_gltf(const std::string& path) {
  const Result<std::string> text = json_of(path);
  if (!text) return text.problem();
  if (nests_too_deep(text.value()))
    return problem_in(
        path, fmt::format("its JSON is nested deeper than {}: export it anew, without extras",
                          limits::gltf_nesting));
  const auto gltf = nlohmann::json::parse(text.value(), nullptr, false);
  if (!gltf.is_object()) return problem_in(path, "it is no glTF: its JSON is damaged");
  return check_nodes(gltf, path);
}

}  // namespace luxodus
