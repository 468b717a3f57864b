// First all lines are read: vertices into lists, faces into one list of corners. Faces may name
// vertices that come later, so parts are made at the end. A part is a run of faces of one object or
// group and one material.
#include "scenes/light/geometry/obj_import.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <set>
#include <unordered_map>

#include "runtime/core/isolated_job.hpp"
#include "runtime/core/printable.hpp"
#include "runtime/core/regular_file.hpp"
#include "scenes/light/geometry/mesh_parts.hpp"
#include "scenes/light/geometry/obj_materials.hpp"
#include "scenes/light/geometry/polygon.hpp"

namespace luxodus {
namespace {

constexpr uint32_t no_texture = 0xffffffff;

struct Corner {
  uint32_t position = 0, texture = no_texture;
};
struct Face {
  size_t first = 0;
  uint32_t corners = 0;
  int line = 0;
};
struct Run {
  std::string name, material;
  size_t first_face = 0;
};

/// Words that may begin a line, besides those that are read: normals, points, lines, and what only
/// concerns how it looks.
bool is_passed_over(std::string_view word) {
  static const std::set<std::string_view> known = {
      "vn",         "vp",        "p",     "l",      "s",        "mg",
      "usemap",     "lod",       "bevel", "maplib", "c_interp", "d_interp",
      "shadow_obj", "trace_obj", "call",  "csh",    "ctech",    "stech"};
  return known.contains(word);
}

/// Free-form curves and surfaces.
bool is_free_form(std::string_view word) {
  static const std::set<std::string_view> known = {"curv", "curv2", "surf"};
  return known.contains(word);
}

bool is_of_free_form(std::string_view word) {
  static const std::set<std::string_view> known = {"cstype", "deg",  "bmat", "step", "parm", "trim",
                                                   "hole",   "scrv", "sp",   "end",  "con"};
  return known.contains(word);
}

class ObjReader {
 public:
  ObjReader(const std::string& path, double metres_per_unit, UpAxis up, MeshExtras& extras)
      : path_(path), materials_(path), parts_(path, metres_per_unit, up), extras_(extras) {}

  Result<std::vector<ImportedPart>> read() {
    const auto text = read_regular_file(path_, limits::mesh_file_bytes);
    if (!text) return text.problem();
    if (text->starts_with("\xff\xfe") || text->starts_with("\xfe\xff"))
      return problem_in(path_, "this is text in UTF-16: save it in ASCII or UTF-8");
    if (auto ok = read_lines(text.value()); !ok) return ok.problem();
    const auto libraries = materials_.read_libraries();
    for (const std::string& file : materials_.files()) extras_.files.push_back(file);
    if (!libraries) return libraries.problem();
    if (auto ok = make_parts(); !ok) return ok.problem();
    tell_notes();
    return parts_.take();
  }

 private:
  Problem problem(int line, std::string what) const {
    return problem_in(path_, line, std::move(what));
  }

  // ---- lines ---------------------------------------------------------------------------------

  Result<void> read_lines(std::string_view text) {
    constexpr int lines_of_a_word = 65'536;
    constexpr double of_all = 0.5;
    MeshLines lines(text);
    std::string_view line;
    while (lines.next(line)) {
      if (auto ok = take_line(line, lines.number()); !ok) return ok.problem();
      if (positions_.size() > limits::mesh_vertices || faces_.size() > limits::mesh_triangles)
        return problem(lines.number(),
                       fmt::format("more than {} vertices or {} faces: simplify or split the file",
                                   limits::mesh_vertices, limits::mesh_triangles));
      if (lines.number() % lines_of_a_word == 0)
        tell_share(of_all * static_cast<double>(lines.at()) / static_cast<double>(text.size()));
    }
    return {};
  }

  Result<void> take_line(std::string_view rest, int line) {
    const std::string_view word = take_word(rest);
    if (word.empty() || word.front() == '#') return {};
    if (word == "v") return take_position(rest, line);
    if (word == "vt") return take_texture(rest, line);
    if (word == "f" || word == "fo") return take_face(rest, line);
    if (word == "o" || word == "g") {
      begin_object(word == "g", without_blanks(rest));
    } else if (word == "usemtl") {
      const std::string_view name = without_blanks(rest);
      materials_.uses(name, line);
      if (name != material_) run_open_ = false;
      material_ = name;
    } else if (word == "mtllib") {
      materials_.names_library(rest);
    } else if (is_free_form(word)) {
      ++free_forms_;
    } else if (!is_passed_over(word) && !is_of_free_form(word)) {
      if (unknown_++ == 0) first_unknown_ = line;
    }
    return {};
  }

  /// Up to `most` numbers of a line. Errors: a word that is none.
  Result<size_t> take_numbers(std::string_view rest, int line, double* out, size_t most,
                              const char* of_what, size_t least) {
    size_t count = 0;
    for (std::string_view word = take_word(rest); !word.empty() && count < most;
         word = take_word(rest)) {
      if (word.front() == '#') break;
      const auto number = mesh_number(word);
      if (!number)
        return problem(line, fmt::format("a coordinate of this {} is no number: give {} numbers",
                                         of_what, least));
      if (!std::isfinite(*number))
        return problem(line, fmt::format("a {} coordinate is not a finite number", of_what));
      out[count++] = *number;
    }
    if (count < least)
      return problem(
          line, fmt::format("this {} has {} coordinates: give {} numbers", of_what, count, least));
    return count;
  }

  Result<void> take_position(std::string_view rest, int line) {
    double v[7] = {};
    const auto count = take_numbers(rest, line, v, 7, "vertex", 3);
    if (!count) return count.problem();
    // A fourth number is a weight; three more are a colour.
    const bool weighted = count.value() == 4 || count.value() == 7;
    if (weighted && v[3] == 0) return problem(line, "the weight of this vertex is 0");
    positions_.push_back(glm::dvec3(v[0], v[1], v[2]) / (weighted ? v[3] : 1.0));
    return {};
  }

  Result<void> take_texture(std::string_view rest, int line) {
    double v[2] = {};
    const auto count = take_numbers(rest, line, v, 2, "texture", 1);
    if (!count) return count.problem();
    const glm::vec2 uv(v[0], v[1]);
    if (!std::isfinite(uv.x) || !std::isfinite(uv.y))
      return problem(line, "a texture coordinate is not a finite number");
    texture_.push_back(uv);
    return {};
  }

  /// The place of a vertex in its list: from 1 on, or backwards from -1. Forward references are
  /// checked at the end.
  static bool take_index(std::string_view word, size_t so_far, uint32_t& out) {
    int64_t index = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), index);
    if (error != std::errc() || end != word.data() + word.size() || index == 0) return false;
    if (index < 0) index += static_cast<int64_t>(so_far) + 1;
    if (index < 1 || index >= no_texture) return false;
    out = static_cast<uint32_t>(index - 1);
    return true;
  }

  Result<void> take_face(std::string_view rest, int line) {
    Face face{corners_.size(), 0, line};
    for (std::string_view word = take_word(rest); !word.empty(); word = take_word(rest)) {
      if (word.front() == '#') break;
      Corner corner;
      const size_t slash = std::min(word.find('/'), word.size());
      const std::string_view after = word.substr(std::min(slash + 1, word.size()));
      const std::string_view texture = after.substr(0, after.find('/'));
      if (!take_index(word.substr(0, slash), positions_.size(), corner.position) ||
          (!texture.empty() && !take_index(texture, texture_.size(), corner.texture)))
        return problem(line,
                       "a corner of this face is none: give numbers of vertices as V, V/T, "
                       "V//N or V/T/N");
      corners_.push_back(corner);
      ++face.corners;
    }
    if (face.corners < 3) {  // a point or a line
      corners_.resize(face.first);
      return {};
    }
    if (!run_open_) {
      const bool first = runs_.empty() || object_begun_;
      runs_.push_back({first || material_.empty() ? object_ : object_ + "/" + material_, material_,
                       faces_.size()});
      run_open_ = true;
      object_begun_ = false;
    }
    faces_.push_back(face);
    return {};
  }

  void begin_object(bool is_group, std::string_view name) {
    if (is_group && name == group_) return;
    if (is_group) group_ = name;
    object_ = name.empty() ? "defaultobject" : std::string(name);
    run_open_ = false;
    object_begun_ = true;
  }

  // ---- parts ---------------------------------------------------------------------------------

  Result<void> make_parts() {
    for (size_t i = 0; i < runs_.size(); ++i) {
      const size_t end = i + 1 < runs_.size() ? runs_[i + 1].first_face : faces_.size();
      if (auto ok = make_part(runs_[i], end); !ok) return ok.problem();
      tell_share(0.5 + 0.5 * static_cast<double>(end) / static_cast<double>(faces_.size()));
    }
    return {};
  }

  Result<void> make_part(const Run& run, size_t end) {
    ImportedPart part;
    part.name = run.name;
    part.material_name = run.material;
    std::unordered_map<uint64_t, uint32_t> known;
    bool textured = false;
    std::vector<uint32_t> ring;
    for (size_t i = run.first_face; i < end; ++i) {
      const Face& face = faces_[i];
      ring.clear();
      for (size_t k = face.first; k < face.first + face.corners; ++k) {
        const Corner& corner = corners_[k];
        const bool has_texture = corner.texture != no_texture;
        if (corner.position >= positions_.size() ||
            (has_texture && corner.texture >= texture_.size()))
          return problem(face.line, "this face names a vertex that there is not");
        const uint64_t key = static_cast<uint64_t>(corner.position) << 32 | corner.texture;
        const auto [it, is_new] =
            known.try_emplace(key, static_cast<uint32_t>(part.mesh.positions.size()));
        if (is_new) {
          part.mesh.positions.push_back(positions_[corner.position]);
          part.mesh.texture_uv.push_back(has_texture ? texture_[corner.texture] : glm::vec2(0));
          textured |= has_texture;
        }
        ring.push_back(it->second);
      }
      add_polygon(ring, part.mesh);
    }
    if (!textured) part.mesh.texture_uv.clear();
    if (!run.material.empty()) {
      const auto colour = materials_.colour(run.material);
      if (colour)
        part.base_colour = colour.value();
      else
        part.no_colour = colour.problem();
    }
    return parts_.add(std::move(part), parts_.to_scene());
  }

  /// Cuts a face into triangles. Its normal is the mean one (Newell's method).
  void add_polygon(const std::vector<uint32_t>& ring, Mesh& mesh) {
    const auto fan = [&](size_t from) {
      const size_t n = ring.size();
      for (size_t i = 1; i + 1 < n; ++i)
        mesh.triangles.push_back({ring[from], ring[(from + i) % n], ring[(from + i + 1) % n]});
    };
    if (ring.size() == 3) return fan(0);
    const std::vector<glm::dvec2> outline = flattened(ring, mesh);
    const auto turns_right = [&](size_t i) {
      const size_t n = outline.size();
      const glm::dvec2 a = outline[(i + n - 1) % n], b = outline[i], c = outline[(i + 1) % n];
      return (b.x - a.x) * (c.y - b.y) - (b.y - a.y) * (c.x - b.x) < 0;
    };
    size_t concave = 0, last = 0;
    for (size_t i = 0; i < outline.size(); ++i)
      if (turns_right(i)) ++concave, last = i;
    if (concave == 0) return fan(0);
    if (ring.size() == 4 && concave == 1) return fan(last);
    if (const auto sound = checked_outline(outline)) {
      if (const auto triangles = triangulate(outline)) {
        for (const glm::uvec3& t : triangles.value())
          mesh.triangles.push_back({ring[t.x], ring[t.y], ring[t.z]});
        return;
      }
    }
    ++odd_faces_;
    fan(0);
  }

  /// The corners of a face in its mean plane, counter-clockwise.
  static std::vector<glm::dvec2> flattened(const std::vector<uint32_t>& ring, const Mesh& mesh) {
    const glm::dvec3 origin = mesh.positions[ring[0]];
    glm::dvec3 normal(0);
    for (size_t i = 0; i < ring.size(); ++i)
      normal += glm::cross(mesh.positions[ring[i]] - origin,
                           mesh.positions[ring[(i + 1) % ring.size()]] - origin);
    const glm::dvec3 size = glm::abs(normal);
    const glm::dvec3 aside = size.x <= size.y && size.x <= size.z ? glm::dvec3(1, 0, 0)
                             : size.y <= size.z                   ? glm::dvec3(0, 1, 0)
                                                                  : glm::dvec3(0, 0, 1);
    const glm::dvec3 u = glm::cross(aside, normal), v = glm::cross(normal, u);
    const double along = glm::length(u), across = glm::length(v);
    std::vector<glm::dvec2> out;
    for (const uint32_t corner : ring) {
      const glm::dvec3 p = mesh.positions[corner] - origin;
      out.emplace_back(along > 0 ? glm::dot(p, u) / along : 0,
                       across > 0 ? glm::dot(p, v) / across : 0);
    }
    return out;
  }

  void tell_notes() {
    std::vector<std::string>& notes = extras_.notes;
    if (free_forms_ > 0)
      notes.push_back(
          fmt::format("free-form curves and surfaces are not read: {}; export them as "
                      "polygons",
                      free_forms_));
    if (odd_faces_ > 0)
      notes.push_back(
          fmt::format("faces that touch or cross themselves are cut from their first "
                      "corner: {}",
                      odd_faces_));
    if (unknown_ > 0)
      notes.push_back(
          fmt::format("lines that begin with a word that OBJ does not have are not "
                      "read: {}, the first is line {}",
                      unknown_, first_unknown_));
    for (std::string& note : materials_.notes()) notes.push_back(std::move(note));
  }

  const std::string& path_;
  ObjMaterials materials_;
  MeshParts parts_;
  MeshExtras& extras_;
  std::vector<glm::dvec3> positions_;
  std::vector<glm::vec2> texture_;
  std::vector<Corner> corners_;
  std::vector<Face> faces_;
  std::vector<Run> runs_;
  std::string object_ = "defaultobject", group_, material_;
  bool run_open_ = false, object_begun_ = true;
  size_t free_forms_ = 0, odd_faces_ = 0, unknown_ = 0;
  int first_unknown_ = 0;
};

}  // namespace

Result<std::vector<ImportedPart>> import_obj(const std::string& path, double metres_per_unit,
                                             UpAxis up, MeshExtras& extras) {
  extras.files = {path};
  return ObjReader(path, metres_per_unit, up, extras).read();
}

}  // namespace luxodus
