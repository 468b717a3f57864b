#include "actors/import/luminaire_body.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <iterator>
#include <vector>

#include "actors/import/answer_folder.hpp"
#include "runtime/core/atomic_file.hpp"
#include "runtime/core/printable.hpp"
#include "runtime/core/reading_share.hpp"
#include "scenes/geometry/import.hpp"
#include "scenes/geometry/mesh_tools.hpp"

namespace luxodus {
namespace {

namespace fs = std::filesystem;

/// The triangles of a shape, in metres.
Result<Mesh> shape_mesh(const L3dShape& shape, const fs::path& file, ReadingShare* reading) {
  const std::string who = "the shape \"" + excerpt(shape.name) + "\" of its model: ";
  if (auto ok = write_file_atomically(file, std::string_view(shape.obj)); !ok) return ok.problem();
  const auto parts = import_mesh(file.string(), shape.metres_per_unit, UpAxis::z, nullptr, reading);
  if (!parts) return problem(who + parts.problem().what);  // the file is ours, for a moment
  Mesh mesh;
  for (ImportedPart part : parts.value()) {
    part.mesh.texture_uv.clear();
    append(mesh, part.mesh);
  }
  return mesh;
}

/// The opening of this name, or the only one.
const L3dOpening* opening_of(const L3dModel& model, const std::string& name) {
  const auto it = std::find_if(model.openings.begin(), model.openings.end(),
                               [&](const L3dOpening& o) { return o.name == name; });
  if (it != model.openings.end()) return &*it;
  return model.openings.size() == 1 ? &model.openings.front() : nullptr;
}

}  // namespace

void foresee_body(const L3dModel& model, ReadingShare& reading) {
  for (const L3dShape& shape : model.shapes) reading.foresee(shape.obj.size());
}

Result<Mesh> luminaire_body(const L3dModel& model, ReadingShare* reading) {
  const AnswerFolder folder;
  if (folder.path().empty()) {
    std::error_code failed;
    return system_problem(fs::temp_directory_path(failed).string(), "no folder can be made", errno);
  }
  std::vector<Mesh> shapes;
  for (const L3dShape& shape : model.shapes) {
    auto mesh = shape_mesh(shape, folder.path() / fmt::format("{}.obj", shapes.size()), reading);
    if (!mesh) {
      // Those after it are not read any more.
      for (size_t i = shapes.size() + 1; i < model.shapes.size(); ++i)
        ReadingPart(reading, model.shapes[i].obj.size());
      return mesh.problem();
    }
    shapes.push_back(std::move(mesh).value());
  }
  Mesh body;
  for (const L3dPart& part : model.parts) {
    const Mesh& shape = shapes[part.shape];
    if (body.triangles.size() + shape.triangles.size() > limits::luminaire_body_triangles)
      return problem(
          fmt::format("its model has more than {} triangles", limits::luminaire_body_triangles));
    Mesh placed = shape;
    apply(part.place, placed);
    append(body, placed);
  }
  return body;
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
    place.offset_m -= gap_m * at->down;  // off the face that shines
    place.below_m = std::max(0.0, reach);
  }
  return place;
}

Result<void> write_body(const Mesh& body, const fs::path& file) {
  std::string text = "# Made by `luxodus import gldf`: metres, z up.\no body\n";
  const auto out = std::back_inserter(text);
  for (const glm::dvec3& p : body.positions)
    fmt::format_to(out, "v {:.7g} {:.7g} {:.7g}\n", p.x, p.y, p.z);
  for (const glm::uvec3& t : body.triangles)
    fmt::format_to(out, "f {} {} {}\n", t.x + 1, t.y + 1, t.z + 1);
  return write_file_atomically(file, std::string_view(text));
}

}  // namespace luxodus
