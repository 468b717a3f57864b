// A luminaire as a photometric file (EULUMDAT .ldt, IES LM-63 .ies) describes it, in SI units and
// in one frame for both formats. Suspicious but readable values are warnings with their line; an
// unreadable file is one Problem. Plain values; any thread.
//
// Luminaire frame: -Z is gamma 0 (down as it hangs), C0 along +X, C90 along +Y; the origin is the
// photometric centre, which in both formats is the centre of the luminous opening.
//   EULUMDAT: the length runs along C90-C270, so length lies along Y and width along X
//             (EN 13032-1: the C0-C180 plane stands across the lamps).
//   IES:      the length runs along the 0-180 degree plane, so length lies along X and width
//             along Y (LM-63: the 0 degree plane is parallel to the length).
// Therefore the same linear luminaire differs by 90 degrees between the two formats, as in the
// standards.
#pragma once

#include <filesystem>
#include <glm/glm.hpp>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/core/result.hpp"
#include "scenes/light/optics/photometric_web.hpp"

namespace luxodus {

/// The luminous opening, centred on the origin. `size_m`: full extents along the luminaire's X, Y,
/// Z.
struct LuminousOpening {
  enum class Shape {
    point,
    rectangle,     // flat: at least one extent is 0 (the z one for a luminaire that shines down)
    disc,          // flat, elliptic where the extents differ; one extent is 0
    box,           // rectangle with luminous sides
    cylinder,      // upright, elliptic where x and y differ
    tube_along_x,  // horizontal cylinder
    tube_along_y,
    sphere,  // ellipsoid where the extents differ
  };
  Shape shape = Shape::point;
  glm::dvec3 size_m{0};
};

/// One lamp set of an EULUMDAT file, of which one burns; or the lamps of an IES file.
struct LampSet {
  double lamps = 1;    // count
  double flux_lm = 0;  // of the whole set
  double watts = 0;    // with ballast
  std::string type;
  std::string colour;     // as written: "4000 K", "nw", "840"
  std::string rendering;  // as written: "80-89", "1B", "Ra > 80"
};

/// Lamp output against the tilt of the luminaire (LM-63 TILT block). The web holds it level.
struct LampTilt {
  int geometry = 1;  // 1: lamp base vertical; 2, 3: lamp along the 0 or the 90 degree plane
  std::vector<double> angle_deg;
  std::vector<double> factor;
};

struct PhotometricFile {
  std::string file;    // path as given
  std::string format;  // "EULUMDAT", "IES LM-63-2002", ...
  std::string luminaire;
  std::string manufacturer;
  std::string article;  // number of the luminaire in the catalogue; "" where the file states none

  std::shared_ptr<const PhotometricWeb> web;  // [cd], at the flux the file states
  double flux_lm = 0;                         // integral of the web
  std::optional<double> header_flux_lm;       // EULUMDAT: lamp flux x LORL; an IES file states none
  double lamp_flux_lm = 0;                    // of the lamp set; 0 for an absolute IES file
  bool absolute = false;          // luminaire measured as a whole, not relative to its lamps
  double light_output_ratio = 1;  // EULUMDAT LORL as a share; IES: flux / lamp flux
  std::optional<double> header_down_share;  // EULUMDAT DFF as a share
  double down_share = 0;                    // flux below the horizontal / flux, from the web
  double input_watts = 0;
  std::vector<LampSet> lamp_sets;
  std::optional<double> cct_k;  // parsed from the lamp's colour text
  std::optional<double> cri;    // lower end, parsed from the rendering text
  double measured_tilt_deg = 0;
  std::optional<LampTilt> lamp_tilt;

  LuminousOpening opening;
  glm::dvec3 housing_m{0};  // extents along X, Y, Z; 0 where the file states none
  bool housing_round = false;  // an upright cylinder

  std::vector<std::filesystem::path> files_read;  // this file and a TILT file
  std::vector<Problem> warnings;
};

/// Describes an implausible efficacy; none where it is plausible, or no power is stated.
std::optional<std::string> odd_efficacy(const PhotometricFile& file);

/// Reads a photometric file. A TILT= line in its contents tells IES from EULUMDAT, else its name
/// does. `lamp_set`: which lamp set of an EULUMDAT file burns, from 1; needed where it has several.
/// Errors: the file cannot be read, is neither, or breaks its format; one Problem with the line.
Result<PhotometricFile> read_photometric_file(const std::filesystem::path& path,
                                              std::optional<int> lamp_set = {});

/// Reads a photometric file from its bytes; only the contents decide the format. `file` names it in
/// messages; `folder` is where an IES file's TILT=<file> is looked for.
Result<PhotometricFile> photometric_file_of(std::string_view bytes, const std::string& file,
                                            const std::filesystem::path& folder,
                                            std::optional<int> lamp_set = {});

}  // namespace luxodus
