#include "scenes/formats/scene_file/read_files.hpp"

#include <fmt/format.h>

#include "runtime/core/reading_share.hpp"
#include "scenes/formats/images/image_file.hpp"

namespace luxodus {

namespace {

/// Meshes up to this size are cached: furniture that stands in every room is smaller, and a
/// building is placed once.
constexpr size_t kept_vertices = 100'000;

bool is_small(const std::vector<ImportedPart>& parts) {
  size_t vertices = 0;
  for (const ImportedPart& part : parts) vertices += part.mesh.positions.size();
  return vertices <= kept_vertices;
}

}  // namespace

void take_problem(const Problem& problem, const SourcePlace& place, SceneReading& reading) {
  if (problem.where.file.empty()) {
    reading.problem(problem_in(place, problem));
  } else {
    reading.problem(problem_in(
        problem.where,
        problem.what + " (named at " + place.file + ":" + std::to_string(place.line) + ")",
        problem.kind));
  }
}

bool take_hash(const std::filesystem::path& path, const SourcePlace& place, SceneReading& reading,
               FileLife life) {
  const auto hashed = reading.hash_file(path, life);
  if (!hashed) take_problem(hashed.problem(), place, reading);
  return hashed.ok();
}

std::shared_ptr<const Image> read_image(const std::filesystem::path& path, const SourcePlace& place,
                                        SceneReading& reading) {
  const auto [it, fresh] = reading.cache.try_emplace("image " + path.string());
  auto& kept = it->second;  // null after an earlier failure, which is reported once
  if (fresh) {
    if (!take_hash(path, place, reading)) return nullptr;
    auto image = read_png(path.string());
    if (!image) {
      take_problem(image.problem(), place, reading);
      return nullptr;
    }
    kept = std::make_shared<const Image>(std::move(image).value());
  }
  return std::static_pointer_cast<const Image>(kept);
}

std::shared_ptr<const PhotometricFile> read_photometry(const std::filesystem::path& path,
                                                       std::optional<int> lamp_set,
                                                       const SourcePlace& place,
                                                       SceneReading& reading) {
  const auto [it, fresh] = reading.cache.try_emplace(
      fmt::format("photometry {} {}", lamp_set.value_or(0), path.string()));
  auto& kept = it->second;  // null after an earlier failure, which is reported once
  if (fresh) {
    if (!take_hash(path, place, reading)) return nullptr;
    auto file = read_photometric_file(path, lamp_set);
    if (!file) {
      take_problem(file.problem(), place, reading);
      return nullptr;
    }
    for (const auto& other : file->files_read) take_hash(other, place, reading);
    for (const auto& w : file->warnings) reading.warning(w.where, w.what);
    kept = std::make_shared<const PhotometricFile>(std::move(file).value());
  }
  return std::static_pointer_cast<const PhotometricFile>(kept);
}

std::shared_ptr<const GldfProduct> read_container(const std::filesystem::path& path,
                                                  const SourcePlace& place, SceneReading& reading) {
  const auto [it, fresh] = reading.cache.try_emplace("container " + path.string());
  auto& kept = it->second;  // null after an earlier failure, which is reported once
  if (fresh) {
    if (!take_hash(path, place, reading)) return nullptr;
    auto product = read_gldf(path);
    if (!product) {
      take_problem(product.problem(), place, reading);
      return nullptr;
    }
    kept = std::make_shared<const GldfProduct>(std::move(product).value());
  }
  return std::static_pointer_cast<const GldfProduct>(kept);
}

std::optional<ReadMesh> read_mesh(const std::filesystem::path& path, double metres_per_unit,
                                  UpAxis up, const SourcePlace& place, SceneReading& reading) {
  if (!take_hash(path, place, reading)) return std::nullopt;
  const std::string name =
      fmt::format("mesh {} {} {}", metres_per_unit, static_cast<int>(up), path.string());
  if (const auto it = reading.cache.find(name); it != reading.cache.end()) {
    const auto kept = std::static_pointer_cast<const ReadMesh>(it->second);
    std::error_code gone;
    const uint64_t bytes = std::filesystem::file_size(path, gone);
    const ReadingPart foreseen(reading.share, gone ? 0 : bytes);
    for (const auto& file : kept->extras.files) take_hash(file, place, reading);
    return *kept;
  }
  ReadMesh mesh;
  auto parts = import_mesh(path.string(), metres_per_unit, up, &mesh.extras, reading.share);
  for (const auto& file : mesh.extras.files) take_hash(file, place, reading);
  if (!parts) {
    take_problem(parts.problem(), place, reading);
    return std::nullopt;
  }
  for (const std::string& note : mesh.extras.notes)
    reading.warning(place, path.filename().string() + ": " + note);
  mesh.parts = std::move(parts).value();
  if (is_small(mesh.parts)) reading.cache[name] = std::make_shared<const ReadMesh>(mesh);
  return mesh;
}

}  // namespace luxodus
