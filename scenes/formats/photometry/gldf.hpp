// Reads GLDF containers (.gldf, Global Lighting Data Format 1.0): a ZIP with `product.xml` and the
// photometric files of a product's variants; the one open format that states a luminaire's flux on
// emergency supply. libzip and pugixml read it in a process of its own with limits on memory and
// time. Nothing is downloaded: a file that the container names by an address is reported as
// missing. Pictures are not read, and models (L3D) only on request. Plain values; any thread.
#pragma once

#include <filesystem>
#include <functional>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/core/result.hpp"
#include "scenes/formats/photometry/l3d.hpp"
#include "scenes/formats/photometry/photometric_file.hpp"

namespace luxodus {

class ReadingShare;

namespace limits {
/// Size of a container [bytes]: pictures and documents of a product take a few MiB.
inline constexpr uint64_t gldf_bytes = uint64_t{64} << 20;
/// Size of its `product.xml`, unpacked [bytes]; the largest public one has 0.4 MB.
inline constexpr uint64_t gldf_xml_bytes = uint64_t{8} << 20;
/// Unpacked size of one photometric file in it, the same limit as for a file beside a scene; and of
/// all files together [bytes].
inline constexpr uint64_t gldf_file_bytes = uint64_t{16} << 20;
inline constexpr uint64_t gldf_all_bytes = uint64_t{64} << 20;
/// Numbers of files in a container, of variants, of light emitters, of models.
inline constexpr int64_t gldf_entries = 4096;
inline constexpr size_t gldf_variants = 4096;
inline constexpr size_t gldf_lights = 4096;
/// References to lights in one variant.
inline constexpr size_t gldf_references = 1024;
inline constexpr size_t gldf_models = 1024;
}  // namespace limits

/// What a light emitter gives. Values that the container does not state are absent.
struct GldfLight {
  std::string emitter;     // its id; "ID#2" for the second of an emitter's alternatives; "ID:1" for
                           // the first channel of a light source of several
  int alternative = 1;     // of several lights of an emitter one is built in; channels share theirs
  std::string behaviour;   // "None", "Combined", "EmergencyOnly", as written; "" where not stated
  std::string photometry;  // name of its file in the container, or its address
  std::string fault;       // why its photometric file is not available; "" where it is
  std::optional<double> rated_lm;           // of the luminaire, on mains
  std::optional<double> lamp_lm;            // of all its changeable lamps, before the optics
  std::optional<double> emergency_lm;       // on emergency supply, of the luminaire
  std::optional<double> emergency_lamp_lm;  // on emergency supply, of its lamps
  std::optional<double> ballast_factor;
  glm::dvec3 rotation_deg{0};  // within the luminaire, about x, y, z
  double g0_deg = 0;           // about its own gamma 0, before these

  bool is_turned() const { return rotation_deg != glm::dvec3(0) || g0_deg != 0; }
};

/// A row of the table of emergency flux by duration.
struct GldfDuration {
  double hours = 0;
  double flux_lm = 0;
};

/// A housing that is a box or an upright cylinder: extents along the luminaire's X, Y, Z [m].
struct GldfHousing {
  bool round = false;
  glm::dvec3 size_m{0};
};

/// A housing described by a model.
struct GldfModel {
  std::string file;   // its name in the container, or its address
  std::string fault;  // why it is not available; "" where it is, or was not requested
  L3dModel shape;
};

/// A light of a variant. An emitter that a variant refers to several times is several lights.
struct GldfReference {
  std::string name;     // of its emitter; "ID@2" for the second reference to it
  uint64_t light = 0;   // index of the product's
  uint64_t number = 0;  // of the reference: alternatives and channels of one emitter share it
  std::string opening;  // luminous opening in the variant's model; "" where none is stated
};

struct GldfVariant {
  std::string id;
  std::string name;
  std::vector<GldfReference> lights;
  std::vector<GldfDuration> durations;
  std::optional<GldfHousing> housing;
  std::optional<size_t> model;  // index of the product's
};

struct GldfFile {
  std::string name;
  std::string bytes;
};

struct GldfProduct {
  std::string file;  // the container's path, as given
  std::string manufacturer, name, number;
  std::vector<GldfLight> lights;
  std::vector<GldfVariant> variants;
  std::vector<GldfFile> photometry;  // for the lights, each once
  std::vector<GldfModel> models;
};

/// Whether models are read: scenes need none.
enum class GldfModels { left, read };

/// Reads a container, in a process of its own. `reading`, where given, receives the progress.
/// Errors: it cannot be read, is not a ZIP, has no `product.xml`, another version than 1.0, a
/// document type (entities), a number that cannot be read, names that lead out of it, or more than
/// the limits. A model that cannot be read is a fault of that model only.
Result<GldfProduct> read_gldf(const std::filesystem::path& path,
                              GldfModels models = GldfModels::left,
                              ReadingShare* reading = nullptr);

/// Reads a container from its bytes, in this process. `file` names it in messages; `told`, where
/// given, is called after each unpacked file with the share of the container's bytes done.
Result<GldfProduct> gldf_of(std::string_view bytes, const std::string& file,
                            GldfModels models = GldfModels::left,
                            const std::function<void(double)>& told = {});

/// One light of one variant, as a scene uses it.
struct GldfLuminaire {
  PhotometricFile photometry;  // its web gives the rated flux
  double rated_lm = 0;
  bool emergency_only = false;
  bool normal_only = false;           // the container says that it is not for emergency lighting
  Result<double> emergency_lm = 0.0;  // or why it is unknown
  glm::dmat3 turn{1};                 // within the luminaire: from the emitter's frame to its own
};

/// What a scene chooses of a product. `variant`, `emitter`: "" where there is only one.
struct GldfChoice {
  std::string variant, emitter;
  std::optional<double> duration_h;
  std::optional<int> lamp_set;  // of an EULUMDAT file with several
};

/// `duration_h` selects the flux of that row of the variant's table, where it has one: the table is
/// the product's, and its emitters that are lit in an emergency share it by their rated fluxes.
/// Otherwise the emergency flux is the emitter's rated emergency flux (that of its lamps times the
/// light output ratio); else its rated flux times the ballast factor; else, for an emitter for
/// emergency only, its rated flux; else unknown, and never guessed.
/// Errors: no such variant, emitter or duration, with a list of those that exist; a photometric
/// file that is missing or cannot be read.
Result<GldfLuminaire> luminaire_of(const GldfProduct& product, const GldfChoice& choice);

}  // namespace luxodus
