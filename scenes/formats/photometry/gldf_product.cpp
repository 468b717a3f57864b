// GLDF 1.0, release candidates 1 to 3: elements are looked up by path, and refer to each other by
// id. Nothing recurses: only pugixml's tree is nested, and it needs no stack.
#include "scenes/formats/photometry/gldf_product.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <pugixml.hpp>

#include "runtime/core/printable.hpp"
#include "scenes/formats/photometry/photometric_text.hpp"
#include "scenes/formats/photometry/plain_xml.hpp"

namespace luxodus {
namespace {

using pugi::xml_node;

constexpr double most_lm = 1e8;  // the largest floodlights give 3e5

/// Elements of one kind by id; the first one where an id repeats.
using ById = std::map<std::string, xml_node>;

/// The text of an element without blanks and line ends around it, which XML Schema collapses. All
/// its pieces: a comment, or a CDATA section, divides a text.
std::string text_of(xml_node node) {
  std::string out;
  for (const xml_node piece : node.children())
    if (piece.type() == pugi::node_pcdata || piece.type() == pugi::node_cdata) out += piece.value();
  return std::string(bare(out));
}

std::string attribute_of(xml_node node, const char* name) {
  return std::string(bare(node.attribute(name).value()));
}

ById by_id(xml_node parent) {
  ById out;
  for (const xml_node child : parent.children())
    if (child.type() == pugi::node_element) out.emplace(attribute_of(child, "id"), child);
  return out;
}

xml_node found(const ById& all, const std::string& id) {
  const auto it = all.find(id);
  return it == all.end() ? xml_node() : it->second;
}

/// A text in English, else in the first language given.
std::string localised(xml_node node) {
  xml_node chosen = node.first_child();
  for (const xml_node locale : node.children("Locale"))
    if (std::string_view(locale.attribute("language").value()).starts_with("en")) {
      chosen = locale;
      break;
    }
  return text_of(chosen.type() == pugi::node_element ? chosen : node);
}

class ProductReader {
 public:
  ProductReader(xml_node root, const std::string& xml, const std::string& file)
      : root_(root),
        xml_(xml),
        general_(root.child("GeneralDefinitions")),
        files_(by_id(general_.child("Files"))),
        photometries_(by_id(general_.child("Photometries"))),
        emitters_(by_id(general_.child("Emitters"))),
        equipments_(by_id(general_.child("Equipments"))),
        lamps_(by_id(general_.child("LightSources"))),
        geometries_(by_id(general_.child("Geometries"))),
        file_(file) {}

  Result<GldfProduct> read(xml_node variants) {
    product_.file = file_;
    product_.manufacturer = text_of(root_.child("Header").child("Manufacturer"));
    const xml_node meta = root_.child("ProductDefinitions").child("ProductMetaData");
    product_.name = localised(meta.child("Name"));
    product_.number = localised(meta.child("ProductNumber"));
    const std::vector<GldfDuration> common = durations_of(meta);
    for (const xml_node variant : variants.children("Variant")) {
      if (product_.variants.size() >= limits::gldf_variants)
        return problem_in(file_, fmt::format("more than {} variants", limits::gldf_variants));
      read_variant(variant, common);
      if (problem_) return *problem_;
      if (product_.lights.size() > limits::gldf_lights)
        return problem_in(file_, fmt::format("more than {} light emitters", limits::gldf_lights));
      if (product_.models.size() > limits::gldf_models)
        return problem_in(file_, fmt::format("more than {} models", limits::gldf_models));
    }
    if (problem_) return *problem_;
    if (product_.variants.empty()) return problem_in(file_, "the product has no variants");
    return std::move(product_);
  }

 private:
  // ---- values ----------------------------------------------------------------------------------

  /// Keeps the first fault.
  void fail(xml_node at, std::string what) {
    if (problem_) return;
    const auto end = static_cast<size_t>(std::max<ptrdiff_t>(0, at.offset_debug()));
    const auto from = xml_.begin();
    const auto line =
        1 + std::count(from, from + static_cast<ptrdiff_t>(std::min(end, xml_.size())), '\n');
    problem_ = problem_in(file_, fmt::format("line {} of 'product.xml': {}", line, what));
  }

  /// A number that stands in the container, in its limits; what cannot be read is a fault.
  double checked(xml_node at, const std::string& name, const std::string& text, double low,
                 double high) {
    const auto value = decimal(text, false);
    if (value && *value >= low && *value <= high) return *value;
    fail(at, fmt::format("{} must be a number from {:g} to {:g}, not \"{}\"", name, low, high,
                         excerpt(text)));
    return low;
  }

  /// The number of a child; nothing where there is none.
  std::optional<double> number(xml_node of, const char* name, double low, double high) {
    const xml_node node = of.child(name);
    if (!node) return std::nullopt;
    return checked(node, name, text_of(node), low, high);
  }

  std::optional<double> flux(xml_node of, const char* name) { return number(of, name, 0, most_lm); }

  // ---- variants --------------------------------------------------------------------------------

  void read_variant(xml_node node, const std::vector<GldfDuration>& common_durations) {
    GldfVariant variant;
    variant.id = attribute_of(node, "id");
    variant.name = localised(node.child("Name"));
    variant.durations = durations_of(node);
    if (variant.durations.empty()) variant.durations = common_durations;
    const xml_node geometry = node.child("Geometry");
    const xml_node several = geometry.child("GeometryReferences");
    Counts counts;
    for (const xml_node place : {geometry, several}) {
      for (const xml_node e : place.children("EmitterReference"))
        refer(attribute_of(e, "emitterId"), "", {}, counts, variant);
      for (const xml_node simple : place.children("SimpleGeometryReference")) {
        refer(attribute_of(simple, "emitterId"), "simple", {}, counts, variant);
        variant.housing = housing_of(found(geometries_, attribute_of(simple, "geometryId")));
      }
      for (const xml_node model : place.children("ModelGeometryReference")) {
        for (const xml_node e : model.children("EmitterReference")) {
          // One reference for each kind of model, where they name the opening differently.
          const std::string kind = attribute_of(e, "targetModelType");
          const bool ours = kind.empty() || kind == "l3d";
          refer(attribute_of(e, "emitterId"), "model " + (ours ? "l3d" : kind),
                ours ? text_of(e.child("EmitterObjectExternalName")) : "", counts, variant);
        }
        if (!variant.model) variant.model = model_of(attribute_of(model, "geometryId"));
      }
    }
    if (variant.lights.size() > limits::gldf_references)
      fail(node, fmt::format("the variant \"{}\" refers to more than {} lights",
                             excerpt(variant.id), limits::gldf_references));
    product_.variants.push_back(std::move(variant));
  }

  std::vector<GldfDuration> durations_of(xml_node of) {
    constexpr double most_hours = 1000;
    std::vector<GldfDuration> rows;
    const xml_node table =
        of.child("DescriptiveAttributes").child("Emergency").child("DurationTimeAndFlux");
    for (const xml_node row : table.children("Flux")) {
      const double hours =
          checked(row, "hours of DurationTimeAndFlux", attribute_of(row, "hours"), 0, most_hours);
      const double lumens = checked(row, "Flux of DurationTimeAndFlux", text_of(row), 0, most_lm);
      if (hours > 0) rows.push_back({hours, lumens});
    }
    return rows;
  }

  /// Box and cylinder in millimetres; width along X and length along Y, as EULUMDAT has them.
  std::optional<GldfHousing> housing_of(xml_node geometry) {
    constexpr double mm = 1e-3, largest_mm = 1e5;
    const auto metres = [&](xml_node of, const char* what) {
      return number(of, what, 0, largest_mm).value_or(0) * mm;
    };
    GldfHousing housing;
    if (const xml_node box = geometry.child("Cuboid")) {
      housing.size_m = {metres(box, "Width"), metres(box, "Length"), metres(box, "Height")};
    } else if (const xml_node cylinder = geometry.child("Cylinder")) {
      housing.round = true;
      housing.size_m = glm::dvec3(metres(cylinder, "Diameter"));
      housing.size_m.z = metres(cylinder, "Height");
    }
    for (const double extent : {housing.size_m.x, housing.size_m.y, housing.size_m.z})
      if (!(extent > 0)) return std::nullopt;
    return housing;
  }

  /// Index of the model of a geometry; nothing where none is named. Of several files of one shape
  /// with different detail the first is used.
  std::optional<size_t> model_of(const std::string& geometry) {
    const xml_node file =
        found(files_,
              attribute_of(found(geometries_, geometry).child("GeometryFileReference"), "fileId"));
    if (!file) return std::nullopt;
    GldfModel model;
    model.file = text_of(file);
    const auto& models = product_.models;
    const auto known = std::find_if(models.begin(), models.end(),
                                    [&](const GldfModel& m) { return m.file == model.file; });
    if (known != models.end()) return static_cast<size_t>(known - models.begin());
    const std::string kind = attribute_of(file, "contentType");
    if (attribute_of(file, "type") == "url")
      model.fault = "it is at " + excerpt(model.file, 200) + ", and nothing is fetched";
    else if (kind != "geo/l3d")
      model.fault = "it is \"" + excerpt(kind) + "\"; \"geo/l3d\" is read";
    product_.models.push_back(std::move(model));
    return models.size() - 1;
  }

  // ---- lights ----------------------------------------------------------------------------------

  /// How often a variant's geometry of one kind has referred to an emitter. Geometries of different
  /// kinds (none, a box, a model) describe the same lights.
  using Counts = std::map<std::pair<std::string, std::string>, size_t>;

  /// Adds one more reference to an emitter, unless a geometry of another kind has added it.
  /// `opening`: the luminous opening in the variant's model; "" for none.
  void refer(const std::string& id, const std::string& kind, const std::string& opening,
             Counts& counts, GldfVariant& variant) {
    const size_t number = ++counts[{kind, id}];
    auto& known = numbers_.try_emplace({variant_number(), id}).first->second;
    if (known.size() < number) {
      known.push_back(references_++);
      for (const size_t light : lights_of(id)) {
        const std::string& name = product_.lights[light].emitter;
        variant.lights.push_back({number == 1 ? name : fmt::format("{}@{}", name, number), light,
                                  known.back(), opening});
      }
      return;
    }
    if (opening.empty()) return;
    for (GldfReference& reference : variant.lights)
      if (reference.number == known[number - 1]) reference.opening = opening;
  }
  size_t variant_number() const { return product_.variants.size(); }

  /// Indices of an emitter's lights, which are read at their first use.
  const std::vector<size_t>& lights_of(const std::string& id) {
    auto [it, fresh] = lights_of_.try_emplace(id);
    if (!fresh) return it->second;
    const auto add = [&](GldfLight light) {
      it->second.push_back(product_.lights.size());
      product_.lights.push_back(std::move(light));
    };
    const xml_node emitter = found(emitters_, id);
    if (!emitter) {
      GldfLight missing;
      missing.emitter = id;
      missing.fault = "the container does not define this emitter";
      add(std::move(missing));
      return it->second;
    }
    int alternative = 0;
    for (const xml_node node : emitter.children()) {
      const std::string_view kind = node.name();
      const bool channels = kind == "MultiChannelLightEmitter";
      if (kind != "FixedLightEmitter" && kind != "ChangeableLightEmitter" && !channels) continue;
      ++alternative;
      GldfLight light = light_of(node);
      light.alternative = alternative;
      light.emitter = alternative == 1 ? id : fmt::format("{}#{}", id, alternative);
      if (channels)
        add_channels(node, light, add);
      else
        add(with_fluxes(node, std::move(light)));
    }
    return it->second;
  }

  /// What all lights state in the same way.
  GldfLight light_of(xml_node node) {
    GldfLight light;
    light.behaviour = attribute_of(node, "emergencyBehaviour");
    if (!light.behaviour.empty() && light.behaviour != "None" && light.behaviour != "Combined" &&
        light.behaviour != "EmergencyOnly")
      fail(node, "emergencyBehaviour must be None, Combined or EmergencyOnly, not \"" +
                     excerpt(light.behaviour) + "\"");
    const xml_node turn = node.child("Rotation");
    const auto degrees = [&](const char* axis) {
      return number(turn, axis, -360, 360).value_or(0);
    };
    light.rotation_deg = {degrees("X"), degrees("Y"), degrees("Z")};
    light.g0_deg = degrees("G0");
    return light;
  }

  GldfLight with_fluxes(xml_node node, GldfLight light) {
    light.rated_lm = flux(node, "RatedLuminousFlux");
    light.emergency_lm = flux(node, "EmergencyRatedLuminousFlux");
    light.ballast_factor = number(node, "EmergencyBallastLumenFactor", 0, 1);
    if (const xml_node reference = node.child("EquipmentReference")) {
      // The equipment states what its lamps give, before the optics of the luminaire.
      const xml_node equipment = found(equipments_, attribute_of(reference, "equipmentId"));
      const xml_node lamp = equipment.child("LightSourceReference");
      double count = 1;
      if (lamp.attribute("lightSourceCount"))
        count = checked(lamp, "lightSourceCount", attribute_of(lamp, "lightSourceCount"), 1, 1e4);
      const auto of_one =
          flux(found(lamps_, attribute_of(lamp, "changeableLightSourceId")), "RatedLuminousFlux");
      if (of_one) light.lamp_lm = *of_one * count;
      if (!light.rated_lm) light.rated_lm = flux(equipment, "RatedLuminousFlux");
      light.emergency_lamp_lm = flux(equipment, "EmergencyRatedLuminousFlux");
      light.ballast_factor = number(equipment, "EmergencyBallastLumenFactor", 0, 1);
    }
    find_photometry(node, light);
    return light;
  }

  /// Each channel of a light source is a light of its own: they are dimmed by themselves.
  template <class Add>
  void add_channels(xml_node node, const GldfLight& common, const Add& add) {
    const std::string id =
        attribute_of(node.child("LightSourceReference"), "multiChannelLightSourceId");
    const xml_node source = found(lamps_, id);
    const auto factor = number(source, "EmergencyBallastLumenFactor", 0, 1);
    int count = 0;
    for (const xml_node channel : source.child("Channels").children("Channel")) {
      GldfLight light = common;
      light.emitter += fmt::format(":{}", ++count);
      light.rated_lm = flux(channel, "RatedLuminousFlux");
      light.ballast_factor = factor;
      find_photometry(channel, light);
      add(std::move(light));
    }
    if (count > 0) return;
    GldfLight light = common;
    light.fault = "its light source \"" + excerpt(id) + "\" has no channels in the container";
    add(std::move(light));
  }

  /// `node` refers to the photometry.
  void find_photometry(xml_node node, GldfLight& light) const {
    const xml_node photometry =
        found(photometries_, attribute_of(node.child("PhotometryReference"), "photometryId"));
    const xml_node file =
        found(files_, attribute_of(photometry.child("PhotometryFileReference"), "fileId"));
    light.photometry = text_of(file);
    const std::string kind = attribute_of(file, "contentType");
    if (!file)
      light.fault = "no photometric file is named for it";
    else if (attribute_of(file, "type") == "url")
      light.fault = "its photometric file is at " + excerpt(light.photometry, 200) +
                    ", and nothing is fetched: fetch it and name it in 'file' instead";
    else if (kind != "ldc/eulumdat" && kind != "ldc/ies")
      light.fault = "its photometric file is \"" + excerpt(kind) +
                    "\"; \"ldc/eulumdat\" and \"ldc/ies\" are read";
  }

  xml_node root_;
  const std::string& xml_;
  xml_node general_;
  ById files_, photometries_, emitters_, equipments_, lamps_, geometries_;
  std::string file_;
  std::map<std::string, std::vector<size_t>> lights_of_;
  std::map<std::pair<size_t, std::string>, std::vector<size_t>> numbers_;
  size_t references_ = 0;
  std::optional<Problem> problem_;
  GldfProduct product_;
};

/// "1.0" of the version, which is an attribute in rc.2 and rc.3, and text ("1.0.0-rc.1") before.
std::string version_of(xml_node root) {
  const xml_node version = root.child("Header").child("FormatVersion");
  if (const auto major = version.attribute("major"))
    return fmt::format("{}.{}", bare(major.value()), attribute_of(version, "minor"));
  const std::string text = text_of(version);
  return text.substr(0, text.find('.', text.find('.') + 1));
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
  return ProductReader(root, xml, file).read(root.child("ProductDefinitions").child("Variants"));
}

}  // namespace luxodus
