// This process checks what it can without reading the file, asks the other process to read it, and
// does not trust the answer: each part is checked against its own counts and the limits before it
// is returned.
#include "scenes/light/geometry/import.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <stdexcept>

#include "runtime/core/isolated_job.hpp"
#include "runtime/core/reading_share.hpp"
#include "runtime/core/regular_file.hpp"
#include "scenes/light/geometry/gltf_import.hpp"
#include "scenes/light/geometry/obj_import.hpp"

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

void put(PlainWriter& out, const ImportedLamp& lamp) {
  out.put(lamp.name);
  out.put(lamp.at);
  out.put(lamp.direction);
  out.put(static_cast<uint8_t>(lamp.is_spot ? 1 : 0));
  out.put(lamp.candela);
  out.put(lamp.inner_deg);
  out.put(lamp.outer_deg);
  out.put(lamp.colour);
}

void put(PlainWriter& out, const MeshExtras& extras) {
  for (const std::vector<std::string>* texts : {&extras.files, &extras.notes}) {
    out.put(static_cast<uint64_t>(texts->size()));
    for (const std::string& text : *texts) out.put(text);
  }
  out.put(static_cast<uint64_t>(extras.lamps.size()));
  for (const ImportedLamp& lamp : extras.lamps) put(out, lamp);
}

void answer(PlainReader& question, PlainWriter& out) {
  std::string path;
  double metres_per_unit = 0;
  UpAxis up = UpAxis::z;
  if (!question.get(path) || !question.get(metres_per_unit) || !question.get(up))
    throw std::runtime_error("no question");
  MeshExtras extras;
  const auto read = mesh_ending(path) == ".obj" ? import_obj : import_gltf;
  const auto parts = read(path, metres_per_unit, up, extras);
  put(out, extras);
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

bool get(PlainReader& in, ImportedLamp& lamp) {
  uint8_t is_spot = 0;
  if (!in.get(lamp.name) || !in.get(lamp.at) || !in.get(lamp.direction) || !in.get(is_spot) ||
      !in.get(lamp.candela) || !in.get(lamp.inner_deg) || !in.get(lamp.outer_deg) ||
      !in.get(lamp.colour))
    return false;
  lamp.is_spot = is_spot == 1;
  return is_finite(lamp.at) && is_finite(lamp.direction) && is_finite(lamp.colour) &&
         std::isfinite(lamp.candela) && lamp.inner_deg >= 0 && lamp.inner_deg < lamp.outer_deg &&
         lamp.outer_deg <= 90;
}

bool get(PlainReader& in, MeshExtras& extras) {
  uint64_t count = 0;
  for (std::vector<std::string>* texts : {&extras.files, &extras.notes}) {
    if (!in.get(count) || count > in.left()) return false;
    for (; count > 0; --count)
      if (!in.get(texts->emplace_back())) return false;
  }
  if (!in.get(count) || count > limits::mesh_parts) return false;
  for (; count > 0; --count)
    if (!get(in, extras.lamps.emplace_back())) return false;
  return true;
}

Result<std::vector<ImportedPart>> parts_of(PlainReader& in, const std::string& path,
                                           MeshExtras& extras) {
  const Problem damaged = problem_in(path, "cannot be read: the importer gave no sound answer");
  uint64_t count = 0;
  if (!get(in, extras)) return damaged;
  uint8_t good = 0;
  if (!in.get(good)) return damaged;
  if (Problem why; good != 1) return in.get(why) ? why : damaged;
  if (!in.get(count) || count > limits::mesh_parts) return damaged;
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

std::string mesh_ending(const std::string& path) {
  std::string ending = fs::path(path).extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return ending;
}

Result<std::vector<ImportedPart>> import_mesh(const std::string& path, double metres_per_unit,
                                              UpAxis up, MeshExtras* extras,
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
  MeshExtras unwanted;
  auto parts = parts_of(in.value(), path, extras != nullptr ? *extras : unwanted);
  if (parts && parts->empty() && extras == nullptr)
    return problem_in(path, "the file holds lamps and no triangles");
  return parts;
}

}  // namespace luxodus
