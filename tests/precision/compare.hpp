// Two builds' batches held against each other: is what rounding changes far below what chance
// leaves? Pure but for reading the files.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace luxodus::precision {

/// What a build has written of a scene.
struct Traced {
  std::string precision;  // "single" or "double"
  std::string scene;
  double batch_particles = 0;
  std::vector<std::string> kinds, names;  // by column
  std::vector<std::vector<double>> rows;  // by batch
};

void write(const Traced& traced, const std::filesystem::path& file);
/// Errors (exception): a file that cannot be read, or is not what `write` makes.
Traced read(const std::filesystem::path& file);

/// Prints a table by kind of bin, and says whether the difference is far below the statistical
/// error of 1e9 particles. Errors (exception): files of other scenes, batches or bins.
bool compare(const Traced& single, const Traced& twice);

}  // namespace luxodus::precision
