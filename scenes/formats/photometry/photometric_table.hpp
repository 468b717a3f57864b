// Extends the part of the sphere that a photometric file lists to a web over all of it: planes are
// mirrored as the file's symmetry says, omitted angles are dark. Shared by the EULUMDAT and the IES
// reader. Pure functions; any thread.
#pragma once

#include <glm/glm.hpp>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "runtime/core/result.hpp"
#include "scenes/light/optics/photometric_web.hpp"

namespace luxodus {

/// Listed half-planes: `columns[a][p]` [cd] at azimuth a and polar angle p, polar angles ascending.
struct PhotometricTable {
  std::vector<double> azimuth_deg;
  std::vector<double> polar_deg;
  std::vector<std::vector<double>> columns;
};

/// The planes in which a table is mirrored to cover the circle.
enum class WebSymmetry { none, rotational, about_0_180, about_90_270, about_both };

/// C-type tables: pole -Z, azimuth 0 along +X, azimuth 90 along +Y.
glm::dmat3 type_c_axes();
/// B-type tables, polar angle = 90 + H, azimuth = V: pole +Y, azimuth 0 along -Z, azimuth 90 along
/// +X.
glm::dmat3 type_b_axes();

/// Whole circle of planes from 0 to 360 degrees. Where the table leaves a gap wider than `gap_deg`
/// between two neighbouring planes, the gap is dark; 360 and above: planes are always joined.
PhotometricTable around(const PhotometricTable& table, WebSymmetry symmetry, double gap_deg = 360);

/// Extends polar angles to 0 to 180 degrees: dark where the table has no value.
PhotometricTable pole_to_pole(PhotometricTable table);

/// The web of a whole table. `where`: for messages about it.
Result<std::shared_ptr<const PhotometricWeb>> web_of(const PhotometricTable& table,
                                                     const glm::dmat3& axes,
                                                     const SourcePlace& where);

/// Describes planes that disagree at a pole, where all of them state the same direction; none where
/// they agree to 2 %. For a listed table, of which each plane is one of its own.
std::optional<std::string> odd_pole(const PhotometricTable& table);

/// The gap that closes the circle of planes, where it is wider than the widest step between two of
/// them: planes are missing. Requires: azimuths ascend.
std::optional<double> missing_deg(const std::vector<double>& azimuth_deg);

/// Describes a step between two planes that is far wider than the others: planes may be missing
/// there. None where all are alike. Requires: azimuths ascend.
std::optional<std::string> odd_step(const std::vector<double>& azimuth_deg);

/// Share of the web's flux below the horizontal plane of the luminaire, to the accuracy of a
/// 0.5 degree midpoint rule (about 1e-4).
double down_share_of(const PhotometricWeb& web);

}  // namespace luxodus
