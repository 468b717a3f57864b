#include "scenes/light/geometry/obj_materials.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <filesystem>

#include "runtime/core/isolated_job.hpp"
#include "runtime/core/printable.hpp"
#include "runtime/core/regular_file.hpp"
#include "scenes/light/geometry/import.hpp"

namespace luxodus {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view blanks = " \t\r\f\v";

/// Three numbers, or one that stands for all; "spectral" and "xyz" are not colours. Nothing where
/// it is none of these.
Result<std::optional<glm::dvec3>> colour_of(std::string_view rest, const SourcePlace& place) {
  glm::dvec3 out(0);
  for (int i = 0; i < 3; ++i) {
    const std::string_view word = take_word(rest);
    if (i == 0 && (word.empty() || word == "spectral" || word == "xyz"))
      return std::optional<glm::dvec3>();
    if (i == 1 && word.empty()) return std::optional(glm::dvec3(out.x));
    const auto number = mesh_number(word);
    if (!number || !std::isfinite(*number))
      return problem_in(place, "a component of this colour is no number: give three numbers");
    out[i] = *number;
  }
  return std::optional(out);
}

}  // namespace

MeshLines::MeshLines(std::string_view text) : text_(text) {
  if (text.starts_with("\xef\xbb\xbf")) text_.remove_prefix(3);
}

bool MeshLines::next(std::string_view& line) {
  joined_.clear();
  number_ = ended_ + 1;
  while (at_ < text_.size()) {
    const size_t end = std::min(text_.find_first_of("\r\n", at_), text_.size());
    const std::string_view piece = text_.substr(at_, end - at_);
    at_ = end + (text_.substr(end, 2) == "\r\n" ? 2 : end < text_.size() ? 1 : 0);
    ++ended_;
    const size_t last = piece.find_last_not_of(blanks);
    if (last != std::string_view::npos && piece[last] == '\\' && at_ < text_.size()) {
      joined_ += piece.substr(0, last);
      joined_ += ' ';
      continue;
    }
    if (joined_.empty()) {
      line = piece;
    } else {
      joined_ += piece;
      line = joined_;
    }
    return true;
  }
  line = joined_;
  return !joined_.empty();
}

std::string_view take_word(std::string_view& line) {
  line.remove_prefix(std::min(line.find_first_not_of(blanks), line.size()));
  const std::string_view word = line.substr(0, line.find_first_of(blanks));
  line.remove_prefix(word.size());
  return word;
}

std::string_view without_blanks(std::string_view rest) {
  rest.remove_prefix(std::min(rest.find_first_not_of(blanks), rest.size()));
  return rest.substr(0, rest.find_last_not_of(blanks) + 1);
}

std::optional<double> mesh_number(std::string_view word) {
  if (word.starts_with('+')) word.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (end != word.data() + word.size() || word.empty()) return std::nullopt;
  if (error == std::errc::result_out_of_range)
    return std::strtod(std::string(word).c_str(), nullptr);
  return error == std::errc() ? std::optional(value) : std::nullopt;
}

void ObjMaterials::names_library(std::string_view rest) {
  libraries_.emplace_back(without_blanks(rest));
}

void ObjMaterials::uses(std::string_view name, int line) {
  first_use_.try_emplace(std::string(name), line);
}

Result<void> ObjMaterials::read_libraries() {
  const fs::path folder = fs::path(obj_).parent_path();
  const auto there = [&](std::string name) -> std::optional<std::string> {
    std::replace(name.begin(), name.end(), '\\', '/');
    std::error_code unknown;
    if (!fs::is_regular_file(folder / name, unknown)) return std::nullopt;
    return (folder / name).string();
  };
  for (const std::string& library : libraries_) {
    std::vector<std::string> files;
    if (const auto whole = there(library)) {
      files.push_back(*whole);
    } else {
      std::string_view rest = library;  // several names in one line
      for (std::string_view word = take_word(rest); !word.empty(); word = take_word(rest))
        if (const auto one = there(std::string(word))) files.push_back(*one);
    }
    for (const std::string& file : files) {
      if (std::find(read_.begin(), read_.end(), file) != read_.end()) continue;
      read_.push_back(file);
      if (auto ok = read_library(file); !ok) return ok.problem();
    }
  }
  return {};
}

Result<void> ObjMaterials::read_library(const std::string& path) {
  std::error_code unknown;
  allow_more(import_limits(std::min(fs::file_size(path, unknown), limits::mesh_file_bytes)));
  const auto text = read_regular_file(path, limits::mesh_file_bytes);
  if (!text) return text.problem();
  MeshLines lines(text.value());
  std::string_view line;
  Declared* material = nullptr;
  while (lines.next(line)) {
    std::string_view rest = line;
    const std::string_view word = take_word(rest);
    const SourcePlace place{path, lines.number()};
    if (word == "newmtl") {
      const std::string name(without_blanks(rest));
      material = &declared_.try_emplace(name, Declared{place, {}}).first->second;
    } else if (material != nullptr) {
      if (auto ok = take_line(word, rest, *material, place); !ok) return ok.problem();
    }
  }
  return {};
}

Result<void> ObjMaterials::take_line(std::string_view word, std::string_view rest,
                                     Declared& material, const SourcePlace& place) {
  if (word == "Kd" || word == "kd") {
    const auto colour = colour_of(rest, place);
    if (!colour) return colour.problem();
    if (colour.value()) material.colour = colour.value();
  } else if (word == "map_Kd" || word == "map_kd") {
    material.has_picture |= !without_blanks(rest).empty();
  } else if (word == "Ke" || word == "ke") {
    const auto glow = colour_of(rest, place);
    if (!glow) return glow.problem();
    if (const auto& c = glow.value()) material.emits = std::max({c->x, c->y, c->z}) > 0;
  } else if (word == "d") {
    if (const auto opacity = mesh_number(take_word(rest))) material.lets_pass |= *opacity < 1;
  } else if (word == "map_d") {
    material.lets_pass = true;
  }
  return {};
}

Result<glm::dvec3> ObjMaterials::colour(const std::string& material) const {
  const std::string name = "'" + excerpt(material) + "'";
  const auto known = declared_.find(material);
  if (known != declared_.end()) {
    const Declared& found = known->second;
    if (found.has_picture)
      return problem_in(found.place, "the colour of the material " + name +
                                         " is in a picture (\"map_Kd\"), and pictures are not "
                                         "read");
    if (found.colour) return *found.colour;
    return problem_in(found.place, "the material " + name +
                                       " has no colour here: give it \"Kd\" with three numbers "
                                       "from 0 to 1");
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
                                 "' is not there; it lies beside this file where it was exported");
  return problem_in(place, "the material " + name + " has no colour: no \"newmtl " +
                               excerpt(material) + "\" is in " + excerpt(read_.front(), 200));
}

std::vector<std::string> ObjMaterials::notes() const {
  std::vector<std::string> out;
  const auto tell = [&](const char* what, auto member, const char* then) {
    std::string names;
    size_t count = 0;
    constexpr size_t most = 5;
    for (const auto& [name, material] : declared_) {
      if (!(material.*member) || !first_use_.contains(name)) continue;
      if (++count <= most) names += (count > 1 ? ", \"" : "\"") + excerpt(name) + "\"";
    }
    if (count > most) names += fmt::format(" and {} more", count - most);
    if (count > 0) out.push_back(what + names + then);
  };
  tell("the light of materials that emit (\"Ke\") is not read: ", &Declared::emits,
       "; state emitters in the scene");
  tell("materials that let light pass (\"d\") are read as opaque: ", &Declared::lets_pass,
       "; map them to a material of the scene");
  return out;
}

}  // namespace luxodus
