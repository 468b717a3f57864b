// Reads materials.
#include "scenes/formats/scene_file/read_files.hpp"
#include "scenes/formats/scene_file/read_spectrum.hpp"
#include "scenes/formats/scene_file/scene_readers.hpp"

namespace luxodus {

namespace {

void read_glossy(KeyReader& keys, Material& m) {
  m.specular = property(keys, "specular");
  m.roughness = keys.number("roughness");
  if (!keys.clean()) return;
  for (int i = 0; i < spectrum_samples; ++i) {
    const auto s = static_cast<size_t>(i);
    const double sum = m.reflectance.value[s] + m.specular.value[s];
    if (sum <= 1 + 1e-9) continue;
    char text[160];
    std::snprintf(
        text, sizeof text,
        "'reflectance' + 'specular' is %.4g at %.0f nm; a surface cannot reflect more than 1", sum,
        Spectrum::wavelength_nm(i));
    keys.problem("specular", text);
    return;
  }
}

}  // namespace

void read_material(const toml::Table& table, SceneReading& reading) {
  std::string kind;
  KeyReader keys = kind_reader(table, "material", "kind", reading, kind);
  Material m;
  m.name = read_name(keys, "material");
  m.place = keys.place();
  m.reflectance = Spectrum::constant(0);
  if (!kind.empty()) {
    if (kind == "lambertian" || kind == "glossy") {
      m.kind = kind == "glossy" ? MaterialKind::glossy : MaterialKind::lambertian;
      m.reflectance = property(keys, "reflectance");
      if (kind == "glossy") read_glossy(keys, m);
      if (const auto path = keys.file("image")) {
        m.reflectance_image = read_image(*path, keys.place("image"), reading);
      }
    } else if (kind == "mirror") {
      m.kind = MaterialKind::mirror;
      m.specular = property(keys, "specular");
    } else if (kind == "glass") {
      m.kind = MaterialKind::glass_pane;
      m.ior = keys.number("ior");
      m.internal_transmittance = property(keys, "transmittance");
    } else if (kind == "dielectric") {
      m.kind = MaterialKind::dielectric;
      m.ior = keys.number("ior");
    } else {
      m.kind = MaterialKind::open;
    }
  }
  if (const auto back = keys.maybe_text("back")) {
    reading.set_back(static_cast<int>(reading.scene.materials.size()), *back, keys.place("back"));
  }
  reading.scene.materials.push_back(std::move(m));
}

}  // namespace luxodus
