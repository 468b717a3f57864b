#include "scenes/scene_file/read_files.hpp"

#include "scenes/images/image_file.hpp"

namespace luxodus {

void take_problem(const Problem& problem, const SourcePlace& place, SceneReading& reading) {
  if (problem.where.file.empty()) {
    reading.problem(place, problem.what);
  } else {
    reading.problem(problem.where, problem.what + " (named at " + place.file + ":" +
                                       std::to_string(place.line) + ")");
  }
}

bool take_hash(const std::filesystem::path& path, const SourcePlace& place, SceneReading& reading,
               FileLife life) {
  const auto failed = reading.hash_file(path, life);
  if (failed) take_problem(*failed, place, reading);
  return !failed;
}

std::shared_ptr<const Image> read_image(const std::filesystem::path& path, const SourcePlace& place,
                                        SceneReading& reading) {
  const auto [it, fresh] = reading.cache.try_emplace("image " + path.string());
  auto& kept = it->second;  // null where it failed before: said once is enough
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
                                                       const SourcePlace& place,
                                                       SceneReading& reading) {
  const auto [it, fresh] = reading.cache.try_emplace("photometry " + path.string());
  auto& kept = it->second;  // null where it failed before: said once is enough
  if (fresh) {
    if (!take_hash(path, place, reading)) return nullptr;
    auto file = read_photometric_file(path);
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
  auto& kept = it->second;  // null where it failed before: said once is enough
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

}  // namespace luxodus
