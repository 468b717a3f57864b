// GLDF 1.0, release candidates 1 to 3: elements are looked up by path, and refer to each other by
// id. Nothing recurses: only pugixml's tree is nested, and it needs no stack.
#include "scenes/formats/photometry/gldf_product.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <pugixml.hpp>

#include "runtime/core/printable.hpp"
#include "scenes/formats/photometry/photometric_text.hpp"
#include "scenes/formats/photometry/plain_xml.hpp"

namespace luxodus {
namespace {

using pugi::xml_node;

/// Elements of one kind by id; the first one where an id repeats.
using ById = std::map<std::string, xml_node>;

ById by_id(xml_node parent) {
  ById out;
  for (const xml_node child : parent.children())
    if (child.type() == pugi::node_element) out.emplace(child.attribute("id").value(), child);
  return out;
}

xml_node found(const ById& all, const char* id) {
  const auto it = all.find(id);
  return it == all.end() ? xml_node() : it->second;
}

/// A number of the element; nothing where it is absent, not finite or negative.
std::optional<double> amount(xml_node node) {
  const auto value = decimal(bare(node.child_value()), false);
  return node && value && *value >= 0 ? value : std::nullopt;
}

/// A text in English, else in the first language given.
std::string localised(xml_node node) {
  xml_node chosen = node.first_child();
  for (const xml_node locale : node.children("Locale"))
    if (std::string_view(locale.attribute("language").value()).starts_with("en")) {
      chosen = locale;
      break;
    }
  const std::string text(
      bare(chosen.type() == pugi::node_element ? chosen.child_value() : node.child_value()));
  return text;
}

class ProductReader {
 public:
  ProductReader(xml_node root, const std::string& file)
      : general_(root.child("GeneralDefinitions")),
        files_(by_id(general_.child("Files"))),
        photometries_(by_id(general_.child("Photometries"))),
        emitters_(by_id(general_.child("Emitters"))),
        equipments_(by_id(general_.child("Equipments"))),
        lamps_(by_id(general_.child("LightSources"))),
        geometries_(by_id(general_.child("Geometries"))),
        file_(file) {
    product_.file = file;
    product_.manufacturer = bare(root.child("Header").child_value("Manufacturer"));
    const xml_node meta = root.child("ProductDefinitions").child("ProductMetaData");
    product_.name = localised(meta.child("Name"));
    product_.number = localised(meta.child("ProductNumber"));
    common_durations_ = durations_of(meta);
  }

  Result<GldfProduct> read(xml_node variants) {
    for (const xml_node variant : variants.children("Variant")) {
      if (product_.variants.size() >= limits::gldf_variants)
        return problem_in(file_, fmt::format("more than {} variants", limits::gldf_variants));
      read_variant(variant);
      if (product_.lights.size() > limits::gldf_lights)
        return problem_in(file_, fmt::format("more than {} light emitters", limits::gldf_lights));
      if (product_.models.size() > limits::gldf_models)
        return problem_in(file_, fmt::format("more than {} models", limits::gldf_models));
    }
    if (product_.variants.empty()) return problem_in(file_, "the product has no variants");
    return std::move(product_);
  }

 private:
  void read_variant(xml_node node) {
    GldfVariant variant;
    variant.id = node.attribute("id").value();
    variant.name = localised(node.child("Name"));
    variant.durations = durations_of(node);
    if (variant.durations.empty()) variant.durations = common_durations_;
    const xml_node geometry = node.child("Geometry");
    const xml_node several = geometry.child("GeometryReferences");
    for (const xml_node place : {geometry, several}) {
      for (const xml_node e : place.children("EmitterReference"))
        add_lights(e.attribute("emitterId").value(), variant);
      for (const xml_node simple : place.children("SimpleGeometryReference")) {
        add_lights(simple.attribute("emitterId").value(), variant);
        variant.housing = housing_of(found(geometries_, simple.attribute("geometryId").value()));
      }
      for (const xml_node model : place.children("ModelGeometryReference")) {
        for (const xml_node e : model.children("EmitterReference"))
          add_lights(e.attribute("emitterId").value(), variant,
                     std::string(bare(e.child_value("EmitterObjectExternalName"))));
        if (!variant.model) variant.model = model_of(model.attribute("geometryId").value());
      }
    }
    product_.variants.push_back(std::move(variant));
  }

  static std::vector<GldfDuration> durations_of(xml_node of) {
    std::vector<GldfDuration> rows;
    const xml_node table =
        of.child("DescriptiveAttributes").child("Emergency").child("DurationTimeAndFlux");
    for (const xml_node row : table.children("Flux")) {
      const auto hours = decimal(row.attribute("hours").value(), false);
      const auto flux = amount(row);
      if (hours && flux && *hours > 0) rows.push_back({*hours, *flux});
    }
    return rows;
  }

  /// Box and cylinder in millimetres; width along X and length along Y, as EULUMDAT has them.
  static std::optional<GldfHousing> housing_of(xml_node geometry) {
    constexpr double mm = 1e-3, largest_m = 100;
    const auto millimetres = [](xml_node of, const char* what) {
      return amount(of.child(what)).value_or(0) * mm;
    };
    GldfHousing housing;
    if (const xml_node box = geometry.child("Cuboid")) {
      housing.size_m = {millimetres(box, "Width"), millimetres(box, "Length"),
                        millimetres(box, "Height")};
    } else if (const xml_node cylinder = geometry.child("Cylinder")) {
      housing.round = true;
      housing.size_m = glm::dvec3(millimetres(cylinder, "Diameter"));
      housing.size_m.z = millimetres(cylinder, "Height");
    }
    for (const double extent : {housing.size_m.x, housing.size_m.y, housing.size_m.z})
      if (!(extent > 0 && extent < largest_m)) return std::nullopt;
    return housing;
  }

  /// Index of the model of a geometry; nothing where none is named. Of several files of one shape
  /// with different detail the first is used.
  std::optional<size_t> model_of(const std::string& geometry) {
    const xml_node file = found(files_, found(geometries_, geometry.c_str())
                                            .child("GeometryFileReference")
                                            .attribute("fileId")
                                            .value());
    if (!file) return std::nullopt;
    GldfModel model;
    model.file = bare(file.child_value());
    const auto& models = product_.models;
    const auto known = std::find_if(models.begin(), models.end(),
                                    [&](const GldfModel& m) { return m.file == model.file; });
    if (known != models.end()) return static_cast<size_t>(known - models.begin());
    const std::string_view kind = file.attribute("contentType").value();
    if (std::string_view(file.attribute("type").value()) == "url")
      model.fault = "it is at " + excerpt(model.file, 200) + ", and nothing is fetched";
    else if (kind != "geo/l3d")
      model.fault = "it is \"" + excerpt(kind) + "\"; \"geo/l3d\" is read";
    product_.models.push_back(std::move(model));
    return models.size() - 1;
  }

  /// Adds the lights of an emitter to those of the variant; each is kept once. `opening`: the
  /// luminous opening in the variant's model.
  void add_lights(const char* id, GldfVariant& variant, const std::string& opening = {}) {
    const xml_node emitter = found(emitters_, id);
    if (!emitter) return;
    auto [it, fresh] = lights_of_.try_emplace(id);
    if (fresh) {
      int number = 0;
      for (const xml_node light : emitter.children()) {
        const std::string_view kind = light.name();
        if (kind != "FixedLightEmitter" && kind != "ChangeableLightEmitter" &&
            kind != "MultiChannelLightEmitter")
          continue;
        ++number;
        it->second.push_back(product_.lights.size());
        product_.lights.push_back(
            light_of(light, number == 1 ? std::string(id) : fmt::format("{}#{}", id, number)));
      }
    }
    for (const size_t light : it->second) {
      const auto at = std::find(variant.lights.begin(), variant.lights.end(), light);
      const auto place = static_cast<size_t>(at - variant.lights.begin());
      if (at == variant.lights.end()) {
        variant.lights.push_back(light);
        variant.openings.emplace_back();
      }
      if (!opening.empty()) variant.openings[place] = opening;
    }
  }

  GldfLight light_of(xml_node node, std::string name) const {
    GldfLight light;
    light.emitter = std::move(name);
    light.behaviour = node.attribute("emergencyBehaviour").value();
    const xml_node turn = node.child("Rotation");
    const auto degrees = [&](const char* axis) {
      return decimal(bare(turn.child_value(axis)), false).value_or(0);
    };
    light.rotation_deg = {degrees("X"), degrees("Y"), degrees("Z")};
    read_fluxes(node, light);
    find_photometry(node, light);
    return light;
  }

  void read_fluxes(xml_node node, GldfLight& light) const {
    light.rated_lm = amount(node.child("RatedLuminousFlux"));
    xml_node says_emergency = node;
    if (const xml_node reference = node.child("EquipmentReference")) {
      const xml_node equipment = found(equipments_, reference.attribute("equipmentId").value());
      const xml_node lamp = equipment.child("LightSourceReference");
      const double count = lamp.attribute("lightSourceCount").as_double(1);
      const auto flux = amount(found(lamps_, lamp.attribute("changeableLightSourceId").value())
                                   .child("RatedLuminousFlux"));
      if (flux && count > 0 && std::isfinite(count)) light.lamp_lm = *flux * count;
      if (!light.rated_lm) light.rated_lm = amount(equipment.child("RatedLuminousFlux"));
      says_emergency = equipment;
    }
    light.emergency_lm = amount(says_emergency.child("EmergencyRatedLuminousFlux"));
    light.ballast_factor = amount(says_emergency.child("EmergencyBallastLumenFactor"));
  }

  void find_photometry(xml_node node, GldfLight& light) const {
    const xml_node photometry =
        found(photometries_, node.child("PhotometryReference").attribute("photometryId").value());
    const xml_node file =
        found(files_, photometry.child("PhotometryFileReference").attribute("fileId").value());
    light.photometry = bare(file.child_value());
    const std::string_view kind = file.attribute("contentType").value();
    if (!file)
      light.fault = "no photometric file is named for it";
    else if (std::string_view(file.attribute("type").value()) == "url")
      light.fault = "its photometric file is at " + excerpt(light.photometry, 200) +
                    ", and nothing is fetched: fetch it and name it in 'file' instead";
    else if (kind != "ldc/eulumdat" && kind != "ldc/ies")
      light.fault = "its photometric file is \"" + excerpt(kind) +
                    "\"; \"ldc/eulumdat\" and \"ldc/ies\" are read";
  }

  xml_node general_;
  ById files_, photometries_, emitters_, equipments_, lamps_, geometries_;
  std::string file_;
  std::vector<GldfDuration> common_durations_;
  std::map<std::string, std::vector<size_t>> lights_of_;
  GldfProduct product_;
};

/// "1.0" of the version, which is an attribute in rc.2 and rc.3, and text ("1.0.0-rc.1") before.
std::string version_of(xml_node root) {
  const xml_node version = root.child("Header").child("FormatVersion");
  if (const auto major = version.attribute("major"))
    return fmt::format("{}.{}", major.value(), version.attribute("minor").value());
  const std::string_view text = bare(version.child_value());
  return std::string(text.substr(0, text.find('.', text.find('.') + 1)));
}

}  // namespace

Result<GldfProduct> gldf_product_of(const std::string& xml, const std::string& file) {
  pugi::xml_document document;
  if (auto ok = load_plain_xml(document, xml, "product.xml"); !ok)
    return problem_in(file, ok.problem());
  const xml_node root = document.child("Root");
  if (!root) return problem_in(file, "'product.xml' in it has no element 'Root'");
  const std::string version = version_of(root);
  if (version != "1.0")
    return problem_in(file, "version \"" + excerpt(version) + "\" of GLDF is not read; 1.0 is");
  return ProductReader(root, file).read(root.child("ProductDefinitions").child("Variants"));
}

}  // namespace luxodus
