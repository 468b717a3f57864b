// A scene with all kinds of scene parts, made as files in a folder: a room with a picture on its
// wall, smoke from one data set and a fire from another, partly clear.
#pragma once

#include <catch2/catch.hpp>
#include <cmath>
#include <functional>
#include <memory>
#include <string>

#include "runtime/core/atomic_file.hpp"
#include "scenes/formats/images/write_image.hpp"
#include "scenes/formats/scene_file/scene_file.hpp"
#include "scenes/light/transport/compile.hpp"

namespace luxodus {

namespace gallery {

constexpr const char* scene_text = R"(
[run]
batch_particles = 2048
voxel_edge_m = 0.5
[[material]]
name = "painted"
kind = "lambertian"
reflectance = 0.9
image = "wall.png"
[[object]]
name = "room"
shape = "room"
low = [0, 0, 0]
high = [6, 4, 3]
material = "grey50"
patch_edge_m = 1
[[object]]
name = "picture"
shape = "quad"
corner = [0.5, 3.99, 0.5]
edge_u = [5, 0, 0]
edge_v = [0, 0, 2]
material = "painted"
[[object]]
name = "plinth"
shape = "box"
low = [2.5, 1.5, 0.01]
high = [3.5, 2.5, 1]
material = "grey50"
[[emitter]]
name = "lamp"
shape = "point"
position = [3, 2, 2.9]
flux_lm = 4000
[[medium]]
name = "smoke"
kind = "data_set"
file = "smoke.vti"
quantity = "extinction"
[[medium]]
name = "fire"
kind = "data_set"
file = "fire.vti"
quantity = "extinction"
albedo = 0.2
interpolate_emission = true
emission = { power_w = 20000, temperature_k = 1500 }
[[plane]]
name = "floor"
corner = [0.5, 0.5, 0.85]
edge_u = [5, 0, 0]
edge_v = [0, 3, 0]
cell_m = 0.5
[[probe]]
name = "visitor"
position = [1, 1, 1.6]
[[camera]]
name = "door"
eye = [3, 0.3, 1.6]
target = [3, 4, 1.5]
width = 24
height = 16
[[scenario]]
name = "smoky"
[[scenario]]
name = "aired"
smoke_factor = 0
)";

/// Value of each cell, by its indices.
using Field = std::function<double(int x, int y, int z)>;

inline std::string data_array(const std::string& name, int nx, int ny, int nz, const Field& value) {
  std::string text = "<DataArray type=\"Float32\" Name=\"" + name + "\" format=\"ascii\">\n";
  for (int z = 0; z < nz; ++z)
    for (int y = 0; y < ny; ++y)
      for (int x = 0; x < nx; ++x) text += std::to_string(value(x, y, z)) + " ";
  return text + "\n</DataArray>\n";
}

inline std::string vti(int nx, int ny, int nz, const std::string& spacing,
                       const std::string& arrays) {
  const std::string extent =
      "0 " + std::to_string(nx) + " 0 " + std::to_string(ny) + " 0 " + std::to_string(nz);
  return "<?xml version=\"1.0\"?>\n<VTKFile type=\"ImageData\" version=\"1.0\" "
         "byte_order=\"LittleEndian\">\n<ImageData WholeExtent=\"" +
         extent + "\" Origin=\"0.05 0.05 0.05\" Spacing=\"" + spacing + "\">\n<Piece Extent=\"" +
         extent + "\">\n<CellData>\n" + arrays +
         "</CellData>\n</Piece>\n</ImageData>\n</VTKFile>\n";
}

}  // namespace gallery

/// The picture has 3 x 2 tiles; the smoke 3 x 2 x 2 bricks, of which three are clear; the fire 2 x
/// 1 x 2 bricks.
inline std::filesystem::path write_gallery(const std::filesystem::path& folder) {
  using namespace gallery;
  const auto smoke = [](int x, int y, int z) {
    return x < 16 && (y < 16 || z < 16) ? 0.0 : 0.2 + 0.1 * std::sin(0.7 * x) * std::cos(0.3 * z);
  };
  const auto albedo = [](int x, int y, int) { return 0.5 + 0.3 * std::sin(0.2 * (x + y)); };
  const auto burning = [](int x, int y, int z) { return (x + 2 * y + z) % 5 == 0 ? 1.5 : 0.1; };
  PngImage picture;
  picture.width = 150;
  picture.height = 90;
  for (int i = 0; i < 150 * 90 * 3; ++i) picture.rgb.push_back(static_cast<uint8_t>(i * 37 % 251));
  REQUIRE(write_png(folder / "wall.png", picture).ok());
  REQUIRE(
      write_file_atomically(folder / "smoke.vti", vti(40, 24, 20, "0.147 0.16 0.145",
                                                      data_array("extinction", 40, 24, 20, smoke) +
                                                          data_array("albedo", 40, 24, 20, albedo)))
          .ok());
  REQUIRE(write_file_atomically(folder / "fire.vti",
                                vti(20, 10, 18, "0.05 0.05 0.06",
                                    data_array("extinction", 20, 10, 18, burning) +
                                        data_array("emission", 20, 10, 18, burning)))
              .ok());
  const auto file = folder / "gallery.toml";
  REQUIRE(write_file_atomically(file, std::string(scene_text)).ok());
  return file;
}

inline std::shared_ptr<const SceneDescription> gallery_in(const std::filesystem::path& folder) {
  auto read = read_scene(write_gallery(folder).string());
  for (const Problem& p : read.problems.list()) UNSCOPED_INFO(p.text());
  REQUIRE(read.scene);
  return std::make_shared<const SceneDescription>(std::move(*read.scene));
}

}  // namespace luxodus
