// The library loses the face of a cut whose plane runs along an edge of the body, without a
// diagnostic. So each solid is tested for being closed, and for its volume where that is known
// here. What is open, lost or of another volume gets a second chance: the library gets it as a brep
// that is cut here, and cuts openings into that.
#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <map>
#include <set>

#include "actors/import/answer_folder.hpp"
#include "actors/import/ifc_shapes.hpp"
#include "runtime/core/atomic_file.hpp"
#include "scenes/formats/ifc/shape_input.hpp"
#include "scenes/light/geometry/closed_mesh.hpp"
#include "scenes/light/geometry/mesh_tools.hpp"

namespace luxodus {

namespace {

namespace fs = std::filesystem;

/// Products that are named for openings that were not cut, or for their volume.
constexpr size_t max_named = 100;
/// Relative difference of a shape's volume from that of its solids: the library draws circles with
/// as few as 24 corners, which takes 1.1 % of them.
constexpr double volume_tolerance = 0.03;

std::string guid_of(const ImportedPart& part) {
  return part.name.substr(0, part.name.find('#'));
}

/// The shape of each product, of all its parts.
std::map<std::string, Mesh> whole_shapes(const std::vector<ImportedPart>& parts) {
  std::map<std::string, Mesh> out;
  for (const ImportedPart& part : parts) append(out[guid_of(part)], part.mesh);
  return out;
}

Result<IfcShapes> computed(const StepFile& file, const fs::path& script, double seconds,
                           ReadingShare* reading, const std::vector<uint64_t>& only,
                           const std::string& name) {
  const AnswerFolder folder;
  std::error_code failed;
  if (folder.path().empty())
    return system_problem(fs::temp_directory_path(failed).string(), "no folder can be made", errno);
  const fs::path model = folder.path() / "model.ifc";
  if (auto ok = write_file_atomically(model, std::string_view(file.text())); !ok)
    return ok.problem();
  auto shapes = ifc_shapes(model, script, seconds, reading, only);
  if (shapes) return shapes;
  Problem problem = shapes.problem();
  if (problem.where.file == model.string()) problem.where.file = name;
  return problem;
}

/// Openings are no bodies: an open one cuts nothing, which the library tells.
bool is_tested(const IfcProduct& product) {
  return product.is_solid && product.kind != "OPENINGELEMENT" && product.kind != "SPACE" &&
         product.kind != "VIRTUALELEMENT" && product.kind != "SPATIALZONE";
}

/// What is known of a model's solids before the library computes them.
struct Expected {
  IfcSolidVolumes volumes;
  std::map<std::string, uint64_t> solids;  // GlobalIds and numbers of the products to be tested

  /// Whether a shape has the volume that its solids have, where that is known.
  bool fits(uint64_t product, double volume_m3) const {
    const auto known = volumes.known.find(product);
    return known == volumes.known.end() || known->second.has_openings ||
           std::abs(volume_m3 - known->second.m3) <= volume_tolerance * known->second.m3;
  }
  /// Whether its own half spaces cut a product away entirely.
  bool is_nothing(uint64_t product) const {
    constexpr double nothing_m3 = 1e-9;
    const auto known = volumes.known.find(product);
    return known != volumes.known.end() && known->second.m3 < nothing_m3;
  }
};

/// Takes out what the library left of products that nothing is left of.
void leave_out_nothing(IfcShapes& shapes, const Expected& expected) {
  for (const auto& [guid, product] : expected.solids)
    if (expected.is_nothing(product)) shapes.nothing.insert(guid);
  std::erase_if(shapes.parts,
                [&](const ImportedPart& part) { return shapes.nothing.contains(guid_of(part)); });
  for (const std::string& guid : shapes.nothing) shapes.uncut.erase(expected.solids.at(guid));
}

/// The volume of each product; parts that are turned inside out count as well.
std::map<std::string, double> volumes_of(const std::vector<ImportedPart>& parts) {
  std::map<std::string, double> out;
  for (const ImportedPart& part : parts)
    out[guid_of(part)] += std::abs(signed_volume_of(part.mesh));
  return out;
}

/// Takes the second shape of a product where it is closed and has its volume.
void replace_shapes(IfcShapes& shapes, IfcShapes second, const Expected& expected,
                    const std::set<uint64_t>& wanted) {
  const auto volumes = volumes_of(second.parts);
  std::set<std::string> good;
  for (const auto& [guid, mesh] : whole_shapes(second.parts)) {
    const auto product = expected.solids.find(guid);
    if (product == expected.solids.end() || !wanted.contains(product->second) ||
        !open_edges(mesh).closed() || !expected.fits(product->second, volumes.at(guid)))
      continue;
    good.insert(guid);
    shapes.open.erase(guid);
    shapes.uncut.erase(product->second);
    if (const auto uncut = second.uncut.find(product->second); uncut != second.uncut.end())
      shapes.uncut.insert(*uncut);
  }
  std::erase_if(shapes.parts,
                [&](const ImportedPart& part) { return good.contains(guid_of(part)); });
  for (ImportedPart& part : second.parts)
    if (good.contains(guid_of(part))) shapes.parts.push_back(std::move(part));
}

/// Products whose shapes are lost, open, or of another volume than their solids; open ones are
/// noted in `shapes`.
std::set<uint64_t> doubtful(IfcShapes& shapes, const Expected& expected) {
  const auto whole = whole_shapes(shapes.parts);
  const auto volumes = volumes_of(shapes.parts);
  std::set<uint64_t> out;
  for (const auto& [guid, product] : expected.solids) {
    const auto shape = whole.find(guid);
    if (expected.is_nothing(product)) continue;
    if (shape == whole.end()) {
      out.insert(product);
      continue;
    }
    const OpenEdges open = open_edges(shape->second);
    if (!open.closed()) shapes.open[guid] = open.area_m2;
    if (!open.closed() || !expected.fits(product, volumes.at(guid))) out.insert(product);
  }
  return out;
}

void add_notes(IfcShapes& shapes, const Expected& expected) {
  if (expected.volumes.beyond_budget > 0)
    shapes.notes.push_back(
        fmt::format("the solids of {} products take too much work to be computed a second time: "
                    "the volumes of their shapes are not tested",
                    expected.volumes.beyond_budget));
  size_t told = 0;
  for (const auto& [product, count] : shapes.uncut)
    if (++told <= max_named)
      shapes.notes.push_back(fmt::format("#{} has {} opening{} that {} not cut", product, count,
                                         count == 1 ? "" : "s", count == 1 ? "was" : "were"));
  const auto volumes = volumes_of(shapes.parts);
  for (const auto& [guid, product] : expected.solids) {
    const auto volume = volumes.find(guid);
    if (volume == volumes.end() || expected.fits(product, volume->second)) continue;
    if (++told <= max_named)
      shapes.notes.push_back(
          fmt::format("#{} ({}) has a shape of {:.4g} m3, and solids of {:.4g} m3", product, guid,
                      volume->second, expected.volumes.known.at(product).m3));
  }
  if (told > max_named)
    shapes.notes.push_back(
        fmt::format("{} more products have openings that were not cut, or a shape "
                    "of another volume than their solids",
                    told - max_named));
}

}  // namespace

Result<IfcShapes> shapes_of_model(const StepFile& step, const IfcModel& model,
                                  const fs::path& script, double seconds, ReadingShare* reading) {
  const auto input = ifc_shape_input(step, model);
  if (!input) return input.problem();
  auto shapes = computed(input->file, script, seconds, reading, {}, model.file);
  if (!shapes) return shapes.problem();
  IfcShapes out = std::move(shapes).value();
  const bool none = out.parts.empty();
  Expected expected{ifc_solid_volumes(input->file, model), {}};
  for (const IfcProduct& product : model.products)
    if (is_tested(product)) expected.solids.emplace(product.guid, product.id);
  leave_out_nothing(out, expected);
  const std::set<uint64_t> again = doubtful(out, expected);
  if (const auto mended = ifc_mended_input(input->file, model, again)) {
    const std::vector<uint64_t> only(mended->products.begin(), mended->products.end());
    auto second = computed(mended->file, script, seconds, nullptr, only, model.file);
    if (second) replace_shapes(out, std::move(second).value(), expected, mended->products);
  }
  if (none && out.parts.empty())
    return problem_in(model.file, "the model has no shapes: export it with geometry" +
                                      (out.notes.empty() ? "" : " (" + out.notes.front() + ")"));
  out.notes.insert(out.notes.begin(), input->notes.begin(), input->notes.end());
  add_notes(out, expected);
  return out;
}

}  // namespace luxodus
