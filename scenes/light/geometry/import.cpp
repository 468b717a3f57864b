// This process checks what it can without reading the file, asks the other process to read it, and
// does not trust the answer: each part is checked against its own counts and the limits before it
// is returned.
#include "scenes/light/geometry/import.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <filesystem>
#include <new>

#include "runtime/core/isolated_job.hpp"
#include "runtime/core/printable.hpp"
#include "runtime/core/reading_share.hpp"
#include "runtime/core/regular_file.hpp"
#include "scenes/light/geometry/assimp_import.hpp"
#include "scenes/light/geometry/mesh_text.hpp"

namespace luxodus {
namespace {

namespace fs = std::filesystem;

/// Limits for reading any file, instances of small files included.
constexpr IsolatedLimits for_all{uint64_t{2} << 30, 30};

// ---- in the other process ----------------------------------------------------------------------

void put(PlainWriter& out, const ImportedPart& part) {
  out.put(part.name);
  out.put(part.material_name);
  out.put(part.mesh.positions);
  out.put(part.mesh.triangles);
  out.put(part.mesh.texture_uv);
  out.put(static_cast<uint8_t>(part.no_colour ? 1 : 0));
  if (part.no_colour) out.put(*part.no_colour);
  out.put(static_cast<uint8_t>(part.base_colour ? 1 : 0));
  out.put(part.base_colour.value_or(glm::dvec3(0)));
  out.put(part.degenerate_triangles);
}

Result<std::vector<ImportedPart>> imported(const std::string& path, double metres_per_unit,
                                           UpAxis up, std::vector<std::string>& files_read) {
  try {
    return import_by_assimp(path, metres_per_unit, up, files_read);
  } catch (const std::bad_alloc&) {
    throw;  // reported together with the limit
  } catch (const std::exception& e) {
    return problem_in(path, "cannot be read: " + excerpt(e.what(), 200));
  } catch (...) {
    return problem_in(path, "cannot be read: the importer failed without a reason");
  }
}

void answer(PlainReader& question, PlainWriter& out) {
  std::string path;
  double metres_per_unit = 0;
  UpAxis up = UpAxis::z;
  if (!question.get(path) || !question.get(metres_per_unit) || !question.get(up))
    throw std::runtime_error("no question");
  std::vector<std::string> files;
  const auto parts = imported(path, metres_per_unit, up, files);
  out.put(static_cast<uint64_t>(files.size()));
  for (const std::string& file : files) out.put(file);
  out.put(static_cast<uint8_t>(parts ? 1 : 0));
  if (!parts) return out.put(parts.problem());
  out.put(static_cast<uint64_t>(parts->size()));
  for (const ImportedPart& part : parts.value()) put(out, part);
}

const IsolatedJob import_job("import", answer);

// ---- in this process ---------------------------------------------------------------------------

bool sound(const Mesh& mesh) {
  const auto in_mesh = [&](const glm::uvec3& t) {
    return std::max({t.x, t.y, t.z}) < mesh.positions.size();
  };
  const auto finite = [](const auto& v) {
    bool all = true;
    for (glm::length_t i = 0; i < v.length(); ++i) all = all && std::isfinite(v[i]);
    return all;
  };
  const auto all_finite = [&](const auto& list) {
    return std::all_of(list.begin(), list.end(), finite);
  };
  return (mesh.texture_uv.empty() || mesh.texture_uv.size() == mesh.positions.size()) &&
         std::all_of(mesh.triangles.begin(), mesh.triangles.end(), in_mesh) &&
         all_finite(mesh.positions) && all_finite(mesh.texture_uv);
}

/// A part of the answer; false where it is none.
bool get(PlainReader& in, ImportedPart& part) {
  uint8_t lacks_colour = 0, has_colour = 0;
  glm::dvec3 colour(0);
  if (!in.get(part.name) || !in.get(part.material_name) || !in.get(part.mesh.positions) ||
      !in.get(part.mesh.triangles) || !in.get(part.mesh.texture_uv) || !in.get(lacks_colour))
    return false;
  if (lacks_colour == 1 && !in.get(part.no_colour.emplace())) return false;
  if (!in.get(has_colour) || !in.get(colour) || !in.get(part.degenerate_triangles)) return false;
  for (glm::length_t i = 0; i < 3; ++i)
    if (!(colour[i] >= 0 && colour[i] <= 1)) return false;
  if (has_colour == 1) part.base_colour = colour;
  return lacks_colour + has_colour <= 1 && part.degenerate_triangles >= 0 && sound(part.mesh);
}

Result<std::vector<ImportedPart>> parts_of(PlainReader& in, const std::string& path,
                                           std::vector<std::string>* files_read) {
  const Problem damaged = problem_in(path, "cannot be read: the importer gave no sound answer");
  uint64_t files = 0, count = 0;
  if (!in.get(files)) return damaged;
  for (; files > 0; --files) {
    std::string file;
    if (!in.get(file)) return damaged;
    if (files_read != nullptr) files_read->push_back(std::move(file));
  }
  uint8_t good = 0;
  if (!in.get(good)) return damaged;
  if (Problem why; good != 1) return in.get(why) ? why : damaged;
  if (!in.get(count) || count == 0 || count > limits::mesh_parts) return damaged;
  std::vector<ImportedPart> parts;
  uint64_t vertices = 0, triangles = 0;
  for (uint64_t i = 0; i < count; ++i) {
    if (!get(in, parts.emplace_back())) return damaged;
    vertices += parts.back().mesh.positions.size();
    triangles += parts.back().mesh.triangles.size();
    if (vertices > limits::mesh_vertices || triangles > limits::mesh_triangles) return damaged;
  }
  return parts;
}

}  // namespace

Result<std::vector<ImportedPart>> import_mesh(const std::string& path, double metres_per_unit,
                                              UpAxis up, std::vector<std::string>* files_read,
                                              ReadingShare* reading) {
  if (!(metres_per_unit > 0) || !std::isfinite(metres_per_unit)) {
    return problem_in(path, fmt::format("a unit of {} m: give a length above 0", metres_per_unit));
  }
  const std::string ending = mesh_ending(path);
  if (ending != ".obj" && ending != ".gltf" && ending != ".glb") {
    return problem_in(path, "unknown kind of mesh: .obj, .gltf and .glb are read");
  }
  const auto size = size_of_regular_file(path);
  if (!size) return size.problem();
  const uint64_t bytes = size.value();
  if (bytes > limits::mesh_file_bytes) {
    return problem_in(path, fmt::format("it has {} bytes, the most are {}: simplify or split it",
                                        bytes, limits::mesh_file_bytes));
  }
  const IsolatedLimits more = import_limits(bytes);
  ReadingPart part(reading, bytes);
  auto in = import_job.run(
      [&](PlainWriter& question) {
        question.put(path);
        question.put(metres_per_unit);
        question.put(up);
      },
      {for_all.memory_bytes + more.memory_bytes, for_all.processor_s + more.processor_s},
      [&](double share) { part.at_share(share); });
  if (!in) return problem_in(path, in.problem());
  return parts_of(in.value(), path, files_read);
}

}  // namespace luxodus
