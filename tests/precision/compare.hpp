// Compares the batches of two builds: whether the effect of rounding is far below the statistical
// error. Pure except for file access; any thread.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace luxodus::precision {

/// The scores that a build has written for a scene.
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

/// Prints a table by kind of bin, and returns whether the difference is far below the statistical
/// error of 1e9 particles. Errors (exception): files of other scenes, batches or bins.
bool compare(const Traced& single, const Traced& twice);

}  // namespace luxodus::precision
