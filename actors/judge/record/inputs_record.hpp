// Inputs of an assessment as its record holds them, so that a report needs no scene: project,
// scenario, luminaires, signs, places, materials and media. Plain values; any thread.
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <vector>

#include "actors/results/formats/json_fields.hpp"
#include "scenes/light/world/description.hpp"

namespace luxodus {

namespace limits {
/// Characters of a picture: 4 MiB of pixels as PNG in base64.
inline constexpr size_t record_picture = size_t{24} << 20;
}  // namespace limits

/// A number whose unit differs from one value to the next.
struct QuantityRecord {
  double value = 0;
  std::string unit;
  static constexpr void fields(auto&& field, auto& m) { field("value", m.value)("unit", m.unit); }
  bool operator==(const QuantityRecord&) const = default;
};

struct ProjectRecord {
  std::string name, client, address, document, revision, date, author, checker;
  double north_deg = 0;
  std::string logo_png;  // base64; "" if there is none
  static constexpr void fields(auto&& field, auto& m) {
    field("name", m.name)("client", m.client)("address", m.address)("document", m.document);
    field("revision", m.revision)("date", m.date)("author", m.author)("checker", m.checker);
    field("north_deg", m.north_deg);
    field("logo_png", m.logo_png, {.or_left_out = true, .max_text = limits::record_picture});
  }
};

struct FactorRecord {
  std::string name;
  double factor = 1;
  static constexpr void fields(auto&& field, auto& m) { field("name", m.name)("factor", m.factor); }
};

struct ScenarioRecord {
  std::string name;
  Operation operation = Operation::mains;
  std::optional<double> seconds_after_failure;
  std::vector<FactorRecord> media;
  std::vector<std::string> doors_open, doors_closed;
  std::vector<FactorRecord> circuits;
  std::optional<double> smoke_factor;  // none: the scene has no scenario of this name
  static constexpr void fields(auto&& field, auto& m) {
    field("name", m.name)("operation", m.operation);
    field("seconds_after_failure", m.seconds_after_failure, {.or_null = true});
    field("media", m.media)("doors_open", m.doors_open)("doors_closed", m.doors_closed);
    field("circuits", m.circuits)("smoke_factor", m.smoke_factor);
  }
};

struct LuminaireRecord {
  std::string name, file, product, shape, distribution;
  glm::dvec3 position{0};
  std::optional<double> floor_m;  // of its storey; none if it is not known
  std::string circuit;
  std::string operation;  // "mains", "maintained", "non-maintained"
  QuantityRecord mains_flux, emergency_flux;
  double maintenance_factor = 1, end_of_duration_factor = 1, emergency_ageing = 1;
  std::string ifc_guid;
  std::optional<glm::dvec3> opening_m;
  std::vector<glm::dvec2> onset;  // seconds and share of the flux
  size_t sheet = 0;               // its place among the sheets
  static constexpr void fields(auto&& field, auto& m) {
    field("name", m.name)("file", m.file)("product", m.product)("shape", m.shape);
    field("distribution", m.distribution)("position", m.position);
    field("floor", m.floor_m, {.unit = "m"})("circuit", m.circuit);
    field("operation", m.operation)("mains_flux", m.mains_flux);
    field("emergency_flux", m.emergency_flux)("maintenance_factor", m.maintenance_factor);
    field("end_of_duration_factor", m.end_of_duration_factor);
    field("emergency_ageing", m.emergency_ageing);
    field("ifc_guid", m.ifc_guid, {.or_left_out = true});
    field("opening_m", m.opening_m)("onset", m.onset)("sheet", m.sheet);
  }
  bool operator==(const LuminaireRecord&) const = default;
};

/// A colour of a face; without luminances if the face is lit from outside.
struct FaceColourRecord {
  std::string name;
  std::optional<double> mains_cd_m2, emergency_cd_m2;
  static constexpr void fields(auto&& field, auto& m) {
    field("name", m.name);
    field("mains", m.mains_cd_m2, {.unit = "cd/m2"});
    field("emergency", m.emergency_cd_m2, {.unit = "cd/m2"});
  }
  bool operator==(const FaceColourRecord&) const = default;
};

struct SignRecord {
  std::string name;
  glm::dvec3 position{0};
  std::optional<double> floor_m;  // of its storey; none if it is not known
  glm::dvec3 facing{0};
  std::string file, text;
  double width_m = 0, height_m = 0, smallest_detail_m = 0;
  bool double_sided = false;
  std::string lighting, circuit, ifc_guid;
  std::string legend, ground;  // names of colours; ground: "" if the face has one colour
  std::vector<FaceColourRecord> colours;
  static constexpr void fields(auto&& field, auto& m) {
    field("name", m.name)("position", m.position);
    field("floor", m.floor_m, {.unit = "m"})("facing", m.facing)("file", m.file);
    field("text", m.text);
    field("width", m.width_m, {.unit = "m"});
    field("height", m.height_m, {.unit = "m"});
    field("smallest_detail", m.smallest_detail_m, {.unit = "m"});
    field("double_sided", m.double_sided)("lighting", m.lighting)("circuit", m.circuit);
    field("ifc_guid", m.ifc_guid, {.or_left_out = true});
    field("legend", m.legend)("ground", m.ground)("colours", m.colours);
  }
  bool operator==(const SignRecord&) const = default;
};

struct RouteRecord {
  std::string name;
  std::vector<glm::dvec3> path;
  double width_m = 0;
  static constexpr void fields(auto&& field, auto& m) {
    field("name", m.name)("path", m.path)("width", m.width_m);
  }
};

struct AreaRecord {
  std::string name;
  bool is_task = false;  // else an open area
  std::vector<glm::dvec2> outline;
  double z_m = 0;
  std::string ifc_guid;
  std::optional<double> mains_lx;  // of a task area
  static constexpr void fields(auto&& field, auto& m) {
    field("name", m.name)("kind", either(m.is_task, "task", "open"))("outline", m.outline);
    field("z", m.z_m);
    field("ifc_guid", m.ifc_guid, {.or_left_out = true});
    field("mains_lx", m.mains_lx);
  }
};

/// A room, or an area where the scene names no rooms, with what is in it.
struct RoomRecord {
  std::string name;
  std::vector<glm::dvec2> outline;
  double z_m = 0, area_m2 = 0;
  size_t emergency = 0, mains = 0, signs = 0;  // numbers of luminaires and signs
  std::string ifc_guid;
  static constexpr void fields(auto&& field, auto& m) {
    field("name", m.name)("outline", m.outline)("z", m.z_m)("area_m2", m.area_m2);
    field("emergency_luminaires", m.emergency)("mains_luminaires", m.mains)("signs", m.signs);
    field("ifc_guid", m.ifc_guid, {.or_left_out = true});
  }
};

struct EmphasisRecord {
  std::string name, kind;
  glm::dvec3 position{0};
  std::string ifc_guid;
  static constexpr void fields(auto&& field, auto& m) {
    field("name", m.name)("kind", m.kind)("position", m.position);
    field("ifc_guid", m.ifc_guid, {.or_left_out = true});
  }
};

struct PlacesRecord {
  std::vector<RouteRecord> routes;
  std::vector<AreaRecord> areas;
  std::vector<EmphasisRecord> emphasis;
  static constexpr void fields(auto&& field, auto& m) {
    field("routes", m.routes)("areas", m.areas)("emphasis", m.emphasis);
  }
};

/// Means over the spectrum, weighted by V(lambda); a material has what its kind has.
struct MaterialRecord {
  std::string name, kind;
  size_t objects = 0;
  std::optional<double> reflectance, specular, transmittance, ior;
  bool picture = false;
  static constexpr void fields(auto&& field, auto& m) {
    field("name", m.name)("kind", m.kind)("objects", m.objects)("reflectance", m.reflectance);
    field("specular", m.specular)("transmittance", m.transmittance)("ior", m.ior);
    field("picture", m.picture);
  }
};

/// A layer or a body of smoke, as the scene states it.
struct LayerRecord {
  double extinction_per_m = 0, wavelength_nm = 0, angstrom = 0, albedo = 0, asymmetry = 0;
  std::optional<double> z_low_m, z_high_m;  // of a layer
  static constexpr void fields(auto&& field, auto& m) {
    field("extinction", m.extinction_per_m, {.unit = "1/m", .or_null = true});
    field("wavelength", m.wavelength_nm, {.unit = "nm", .or_null = true});
    field("angstrom", m.angstrom, {.or_null = true});
    field("albedo", m.albedo, {.or_null = true});
    field("asymmetry", m.asymmetry, {.or_null = true});
    field("z_low", m.z_low_m)("z_high", m.z_high_m);
  }
};

struct MediumRecord {
  std::string name, kind;
  std::vector<LayerRecord> layers;
  std::optional<double> flame_power_w;
  static constexpr void fields(auto&& field, auto& m) {
    field("name", m.name)("kind", m.kind)("layers", m.layers);
    field("flame_power", m.flame_power_w, {.unit = "W"});
  }
};

}  // namespace luxodus
