#include "scenes/light/transport/media_bands.hpp"

#include <algorithm>

namespace luxodus {

namespace {

/// Relative tolerance for extinctions that count as proportional.
constexpr double same_ratio = 1e-12;

/// Ratio by band of extinctions to those of the first band, if it is common to all components.
/// Empty if there is no common ratio, or a band has none.
std::vector<double> common_ratios(const MediaTables& tables, int bands) {
  std::vector<double> out;
  const int count = static_cast<int>(tables.components.size());
  int seen = 0;  // first component with extinction
  while (seen < count && !(tables.sigma_of(0, seen) > 0)) ++seen;
  if (seen == count) return out;
  for (int b = 0; b < bands; ++b) {
    const double ratio = tables.sigma_of(b, seen) / tables.sigma_of(0, seen);
    if (!(ratio > 0)) return {};
    for (int c = 0; c < count; ++c) {
      const double wanted = ratio * tables.sigma_of(0, c);
      if (std::abs(tables.sigma_of(b, c) - wanted) > same_ratio * wanted) return {};
    }
    out.push_back(ratio);
  }
  return out;
}

}  // namespace

MediaBands::MediaBands(const CompiledScene& scene)
    : scene_(scene), ratio_(common_ratios(scene.media.tables(), scene.bands.count())) {
  grey_ = !ratio_.empty() && std::all_of(ratio_.begin(), ratio_.end(), [](double ratio) {
    return std::abs(ratio - 1) <= same_ratio;
  });
  const MediaTables& tables = scene.media.tables();
  for (int c = 0; c < static_cast<int>(tables.components.size()); ++c)
    for (int b = 0; b < scene.bands.count(); ++b)
      if (tables.sigma_of(b, c) > 0)
        max_scattered_ = std::max(max_scattered_, tables.albedo_of(b, c));
}

void MediaBands::albedos(const FreeFlight& flight, const PathBands& bands, BandValues& out) const {
  const MediaTables& tables = scene_.media.tables();
  const bool measured =  // by a data set's array, equal in all bands
      std::any_of(tables.grids.begin(), tables.grids.end(), [&](const PlacedGrid& placed) {
        return placed.component == flight.component && placed.grid.has_albedo();
      });
  for (size_t i = 0; i < bands.count(); ++i)
    out[i] = measured ? flight.albedo : tables.albedo_of(bands.band(i), flight.component);
}

}  // namespace luxodus
