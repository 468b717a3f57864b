// What the tests of both kinds of photometric file share.
#pragma once

#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>
#include <glm/glm.hpp>
#include <numbers>
#include <string>

#include "scenes/formats/photometry/photometric_file.hpp"

namespace luxodus::test {

inline constexpr double pi = std::numbers::pi;
inline const std::filesystem::path shared_data = LUX_SHARED_DATA;
inline const std::filesystem::path luminaires =
    std::filesystem::path(LUX_SOURCE_DIR) / "scenes/library/luminaires";

inline glm::dvec3 toward(double c_deg, double gamma_deg) {
  const double c = c_deg * pi / 180;
  const double g = gamma_deg * pi / 180;
  return {std::sin(g) * std::cos(c), std::sin(g) * std::sin(c), -std::cos(g)};
}

inline bool warns(const PhotometricFile& file, const std::string& words) {
  for (const Problem& warning : file.warnings)
    if (warning.what.find(words) != std::string::npos) return true;
  return false;
}

inline bool data_is_there(const char* folder) {
  if (std::filesystem::is_directory(shared_data / folder)) return true;
  WARN("skipped: the measured files are not there (" << (shared_data / folder).string() << ")");
  return false;
}

}  // namespace luxodus::test
