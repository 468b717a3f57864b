#include "actors/import/luminaire_body.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <iterator>
#include <map>
#include <vector>

#include "actors/import/answer_folder.hpp"
#include "runtime/core/atomic_file.hpp"
#include "runtime/core/printable.hpp"
#include "runtime/core/reading_share.hpp"
#include "scenes/light/geometry/import.hpp"
#include "scenes/light/geometry/mesh_tools.hpp"

namespace luxodus {
namespace {

namespace fs = std::filesystem;

/// Adds triangles of one colour.
void add(LuminaireBody& body, const Mesh& mesh, const std::optional<glm::dvec3>& colour) {
  if (body.colours.empty() || body.colours.back().value != colour)
    body.colours.push_back({colour, body.mesh.triangles.size()});
  append(body.mesh, mesh);
}

/// The triangles of a shape, in metres, read from its files in a temporary folder.
Result<LuminaireBody> shape_body(const L3dShape& shape, const fs::path& folder,
                                 ReadingShare* reading) {
  const std::string who = "the shape \"" + excerpt(shape.name) + "\" of its model: ";
  const fs::path file = folder / "shape.obj";
  std::error_code failed;
  if (!fs::create_directory(folder, failed))
    return system_problem({}, who + "no folder can be made", failed.value());
  if (auto ok = write_file_atomically(file, std::string_view(shape.obj)); !ok) return ok.problem();
  if (!shape.colours.empty())
    if (auto ok = write_file_atomically(folder / l3d_library, std::string_view(shape.colours)); !ok)
      return ok.problem();
  const auto parts = import_mesh(file.string(), shape.metres_per_unit, UpAxis::z, nullptr, reading);
  if (!parts)
    return problem(who + parts.problem().what,
                   parts.problem().kind);  // the file is temporary, so its name is
                                           // omitted
  LuminaireBody body;
  for (ImportedPart part : parts.value()) {
    part.mesh.texture_uv.clear();
    add(body, part.mesh, shape.colours.empty() ? std::nullopt : part.base_colour);
  }
  return body;
}

bool is_of(const L3dPart& part, BodyParts which) {
  return which == BodyParts::all || part.measured == (which == BodyParts::measured);
}

/// A colour as a line of a material library.
std::string paint_words(const std::optional<glm::dvec3>& colour) {
  constexpr double largest = 0.9, otherwise = 0.7;
  const glm::dvec3 c = glm::min(colour.value_or(glm::dvec3(otherwise)), glm::dvec3(largest));
  return fmt::format("Kd {:.4g} {:.4g} {:.4g}", c.r, c.g, c.b);
}

}  // namespace

const L3dOpening* opening_of(const L3dModel& model, const std::string& name) {
  const auto it = std::find_if(model.openings.begin(), model.openings.end(),
                               [&](const L3dOpening& o) { return o.name == name; });
  if (it != model.openings.end()) return &*it;
  return model.openings.size() == 1 ? &model.openings.front() : nullptr;
}

bool has_parts(const L3dModel& model, BodyParts which) {
  return std::any_of(model.parts.begin(), model.parts.end(),
                     [&](const L3dPart& part) { return is_of(part, which); });
}

void foresee_body(const L3dModel& model, ReadingShare& reading) {
  for (const L3dShape& shape : model.shapes) reading.foresee(shape.obj.size());
}

Result<LuminaireBody> luminaire_body(const L3dModel& model, ReadingShare* reading,
                                     BodyParts which) {
  const AnswerFolder folder;
  if (folder.path().empty()) {
    std::error_code failed;
    return system_problem(fs::temp_directory_path(failed).string(), "no folder can be made", errno);
  }
  std::vector<LuminaireBody> shapes;
  for (const L3dShape& shape : model.shapes) {
    auto body = shape_body(shape, folder.path() / std::to_string(shapes.size()), reading);
    if (!body) {
      // Shapes after it are not read any more.
      for (size_t i = shapes.size() + 1; i < model.shapes.size(); ++i)
        ReadingPart(reading, model.shapes[i].obj.size());
      return body.problem();
    }
    shapes.push_back(std::move(body).value());
  }
  LuminaireBody out;
  for (const L3dPart& part : model.parts) {
    if (!is_of(part, which)) continue;
    const LuminaireBody& shape = shapes[part.shape];
    if (out.mesh.triangles.size() + shape.mesh.triangles.size() > limits::luminaire_body_triangles)
      return problem(
          fmt::format("its model has more than {} triangles", limits::luminaire_body_triangles));
    const size_t before = out.mesh.triangles.size();
    Mesh placed = shape.mesh;
    apply(part.place, placed);
    append(out.mesh, placed);
    for (const LuminaireBody::Colour& colour : shape.colours)
      if (out.colours.empty() || out.colours.back().value != colour.value)
        out.colours.push_back({colour.value, before + colour.first_triangle});
  }
  return out;
}

BodyPlace body_place(const L3dModel& model, const Mesh& body, const std::string& opening) {
  constexpr double gap_m = 1e-3, largest_lift_m = 0.1;
  const double low = bounds_of(body).low.z;
  const L3dOpening* at = opening_of(model, opening);
  if (at == nullptr) return {{0, 0, gap_m - low}};
  const double reach = at->centre_m.z - low;
  BodyPlace place;
  place.offset_m = -at->centre_m;
  place.down = at->down;
  if (at->down.z < straight_down && reach <= largest_lift_m) {
    place.offset_m.z = std::max(-at->centre_m.z, gap_m - low);
  } else {
    place.offset_m -= gap_m * at->down;  // away from the luminous face
    place.below_m = std::max(0.0, reach);
  }
  return place;
}

bool LuminaireBody::is_coloured() const {
  return std::any_of(colours.begin(), colours.end(), [](const Colour& c) { return c.value; });
}

Result<void> write_body(const LuminaireBody& body, const fs::path& file) {
  const bool coloured = body.is_coloured();
  const std::string library = file.stem().string() + ".mtl";
  std::string text = "# Made by `luxodus import gldf`: metres, z up.\n";
  if (coloured) text += "mtllib " + library + "\n";
  text += "o body\n";
  const auto out = std::back_inserter(text);
  for (const glm::dvec3& p : body.mesh.positions)
    fmt::format_to(out, "v {:.7g} {:.7g} {:.7g}\n", p.x, p.y, p.z);
  // Each material only once: readers make an object for every change of material.
  std::map<std::string, std::string> faces;  // of each material, by its words
  std::string* faces_here = &faces[""];
  auto next = body.colours.begin();
  for (size_t i = 0; i < body.mesh.triangles.size(); ++i) {
    for (; coloured && next != body.colours.end() && next->first_triangle == i; ++next)
      faces_here = &faces[paint_words(next->value)];
    const glm::uvec3& t = body.mesh.triangles[i];
    fmt::format_to(std::back_inserter(*faces_here), "f {} {} {}\n", t.x + 1, t.y + 1, t.z + 1);
  }
  std::string paints = "# Made by `luxodus import gldf`, of the model's colours.\n";
  int number = 0;
  for (const auto& [words, of_material] : faces) {
    if (!words.empty()) {
      fmt::format_to(out, "usemtl colour {}\n", ++number);
      paints += fmt::format("newmtl colour {}\n{}\n", number, words);
    }
    text += of_material;
  }
  if (coloured) {
    if (auto ok = write_file_atomically(file.parent_path() / library, std::string_view(paints));
        !ok)
      return ok.problem();
  }
  return write_file_atomically(file, std::string_view(text));
}

}  // namespace luxodus
