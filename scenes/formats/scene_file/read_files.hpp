// Reads the files that a scene names: once each, hashed, with their problems. Returns nothing where
// a file could not be read; the problem is then in the SceneReading. Single-threaded like it.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <vector>

#include "scenes/formats/photometry/gldf.hpp"
#include "scenes/formats/photometry/photometric_file.hpp"
#include "scenes/formats/scene_file/scene_reading.hpp"
#include "scenes/light/geometry/import.hpp"

namespace luxodus {

/// Reads a PNG picture as linear values. `place`: where the scene names it.
std::shared_ptr<const Image> read_image(const std::filesystem::path& path, const SourcePlace& place,
                                        SceneReading& reading);
/// Reads an LDT or IES file. Its warnings become the scene's. `lamp_set`: as of
/// read_photometric_file.
std::shared_ptr<const PhotometricFile> read_photometry(const std::filesystem::path& path,
                                                       std::optional<int> lamp_set,
                                                       const SourcePlace& place,
                                                       SceneReading& reading);
/// Reads a GLDF container.
std::shared_ptr<const GldfProduct> read_container(const std::filesystem::path& path,
                                                  const SourcePlace& place, SceneReading& reading);
/// The parts of an OBJ or glTF file, and its lamps.
struct ReadMesh {
  std::vector<ImportedPart> parts;
  MeshExtras extras;
};
/// Reads an OBJ or glTF file. A small one is read once, however often the scene places it. What it
/// says and is not read becomes warnings.
std::optional<ReadMesh> read_mesh(const std::filesystem::path& path, double metres_per_unit,
                                  UpAxis up, const SourcePlace& place, SceneReading& reading);
/// Hashes a file before it is read; false and a problem where it cannot be read.
bool take_hash(const std::filesystem::path& path, const SourcePlace& place, SceneReading& reading,
               FileLife life = FileLife::settled);
/// Adds a problem of another reader, with the place that names its file.
void take_problem(const Problem& problem, const SourcePlace& place, SceneReading& reading);

}  // namespace luxodus
