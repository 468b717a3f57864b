#include "tests/random/features.hpp"

#include <algorithm>
#include <cmath>

namespace luxodus::test {

namespace {

template <class List, class Is>
bool any(const List& list, Is is) {
  return std::any_of(list.begin(), list.end(), is);
}

template <MaterialKind kind>
bool has_material(const RandomScene& s) {
  return any(s.description.materials, [](const Material& m) { return m.kind == kind; });
}
template <EmitterShape shape>
bool has_emitter(const RandomScene& s) {
  return any(s.description.emitters, [](const Emitter& e) { return e.shape == shape; });
}
template <Distribution distribution>
bool has_distribution(const RandomScene& s) {
  return any(s.description.emitters,
             [](const Emitter& e) { return e.distribution == distribution; });
}
template <MediumKind kind>
bool has_medium(const RandomScene& s) {
  return any(s.description.media, [](const Medium& m) { return m.kind == kind; });
}
template <MediumKind kind>
bool has_flame(const RandomScene& s) {
  return any(s.description.media,
             [](const Medium& m) { return m.kind == kind && m.emission.has_value(); });
}
template <SignLighting lighting>
bool has_sign(const RandomScene& s) {
  return any(s.description.signs, [](const Sign& g) { return g.lighting == lighting; });
}
template <VolumeGroupMeasure::Shape shape>
bool has_volume(const RandomScene& s) {
  return any(s.description.volume_groups,
             [](const VolumeGroupMeasure& g) { return g.shape == shape; });
}
template <GroupRule rule>
bool has_groups(const RandomScene& s) {
  return s.description.run.groups == rule;
}
template <Operation operation>
bool operates(const RandomScene& s) {
  return s.scenario.operation == operation;
}

template <class Is>
bool any_material(const RandomScene& s, Is is) {
  return any(s.description.materials, is);
}
double value_of(const Spectrum& s) {
  return s.is_constant() ? s.value[0] : -1;
}

/// Whether the optics of some smoke satisfy `is`.
template <class Is>
bool any_optics(const RandomScene& s, Is is) {
  return any(s.description.media, [&](const Medium& m) {
    if (m.kind != MediumKind::layered) return is(m.optics);
    return any(m.layers, [&](const Layer& l) { return is(l.optics); });
  });
}
template <PhaseKind kind>
bool has_phase(const RandomScene& s) {
  return any_optics(s, [](const SmokeOptics& o) { return o.phase.kind == kind; });
}
/// A Henyey-Greenstein g within [low, high] of either sign.
bool has_g(const RandomScene& s, double low, double high) {
  return any_optics(s, [&](const SmokeOptics& o) {
    const double g = std::abs(o.phase.g);
    return o.phase.kind == PhaseKind::henyey_greenstein && g >= low && g <= high;
  });
}
bool has_extinction(const RandomScene& s, double low, double high) {
  return any_optics(s, [&](const SmokeOptics& o) {
    return o.extinction.sigma_t >= low && o.extinction.sigma_t <= high;
  });
}
bool has_albedo(const RandomScene& s, double low, double high) {
  return any_optics(s, [&](const SmokeOptics& o) {
    const double albedo = value_of(o.albedo);
    return albedo >= low && albedo <= high;
  });
}
bool has_reflectance(const RandomScene& s, double low, double high) {
  return any_material(s, [&](const Material& m) {
    const double r = std::max(value_of(m.reflectance), value_of(m.specular));
    return m.kind <= MaterialKind::mirror && r >= low && r <= high;
  });
}

double extent_of(const RandomScene& s) {
  Bounds bounds;
  for (const Object& o : s.description.objects)
    for (const glm::dvec3& p : o.mesh.positions) bounds.extend(p);
  return bounds.empty() ? 0 : glm::length(bounds.high - bounds.low);
}
double distance_of(const RandomScene& s) {
  for (const Object& o : s.description.objects)
    if (!o.mesh.positions.empty()) return glm::length(o.mesh.positions[0]);
  return 0;
}
size_t triangles_of(const RandomScene& s) {
  size_t count = 0;
  for (const Object& o : s.description.objects) count += o.mesh.triangles.size();
  return count;
}
/// Ratio of the largest to the smallest emitted power.
double power_ratio(const RandomScene& s) {
  double least = 1e300, most = 0;
  for (const Emitter& e : s.description.emitters) {
    if (e.mains_flux <= 0) continue;
    least = std::min(least, e.mains_flux);
    most = std::max(most, e.mains_flux);
  }
  return most > 0 ? most / least : 0;
}

using R = const RandomScene&;

std::vector<Feature> solid_features() {
  using enum MaterialKind;
  return {
      {"closed room", [](R s) { return s.closed; }},
      {"no object", [](R s) { return s.description.objects.empty(); }},
      {"100 triangles and more", [](R s) { return triangles_of(s) >= 100; }},
      {"less than 5 mm wide", [](R s) { return extent_of(s) > 0 && extent_of(s) < 5e-3; }},
      {"a kilometre wide and more", [](R s) { return extent_of(s) > 1e3; }},
      {"100 km from the origin and more", [](R s) { return distance_of(s) > 1e5; }},
      {"several cells", [](R s) { return s.cells > 1; }},
      {"patches cut",
       [](R s) {
         return any(s.description.objects, [](const Object& o) { return o.patch_edge_m > 0; });
       }},
      {"one patch",
       [](R s) { return any(s.description.objects, [](const Object& o) { return o.one_patch; }); }},
      {"door",
       [](R s) {
         return any(s.description.objects, [](const Object& o) { return o.door.has_value(); });
       }},
      {"another material behind",
       [](R s) {
         return any(s.description.objects,
                    [](const Object& o) { return o.material != o.back_material; });
       }},
      {"Lambertian", has_material<lambertian>},
      {"glossy", has_material<glossy>},
      {"glossy, roughness below 1e-3",
       [](R s) {
         return any_material(
             s, [](const Material& m) { return m.kind == glossy && m.roughness < 1e-3; });
       }},
      {"mirror", has_material<mirror>},
      {"glass", has_material<glass_pane>},
      {"dielectric", has_material<dielectric>},
      {"open", has_material<open>},
      {"textured",
       [](R s) {
         return any_material(s, [](const Material& m) { return m.reflectance_image != nullptr; });
       }},
      {"coloured material",
       [](R s) {
         return any_material(s, [](const Material& m) { return !m.reflectance.is_constant(); });
       }},
      {"reflectance 0", [](R s) { return has_reflectance(s, 0, 0); }},
      {"reflectance 0.999", [](R s) { return has_reflectance(s, 0.999, 0.999); }},
      {"reflectance 1", [](R s) { return has_reflectance(s, 1, 1); }},
  };
}

std::vector<Feature> light_features() {
  using enum EmitterShape;
  using enum Distribution;
  return {
      {"no emitter", [](R s) { return s.description.emitters.empty(); }},
      {"point", has_emitter<point>},
      {"rectangle", has_emitter<rectangle>},
      {"disc", has_emitter<disc>},
      {"sphere", has_emitter<sphere>},
      {"tube", has_emitter<tube>},
      {"emitting mesh", has_emitter<mesh>},
      {"Lambertian emitter", has_distribution<lambertian>},
      {"isotropic", has_distribution<isotropic>},
      {"cosine power", has_distribution<cosine_power>},
      {"cosine power of 1000 and more",
       [](R s) {
         return any(s.description.emitters, [](const Emitter& e) {
           return e.distribution == cosine_power && e.cosine_power >= 1e3;
         });
       }},
      {"spot", has_distribution<spot>},
      {"spot narrower than 0.01 degree",
       [](R s) {
         return any(s.description.emitters, [](const Emitter& e) {
           return e.distribution == spot && e.spot_outer_deg < 1e-2;
         });
       }},
      {"collimated", has_distribution<collimated>},
      {"photometric web", has_distribution<web>},
      {"body of an emitter",
       [](R s) {
         return any(s.description.emitters,
                    [](const Emitter& e) { return !e.body_material.empty(); });
       }},
      {"powers a million apart", [](R s) { return power_ratio(s) >= 1e6 * (1 - 1e-9); }},
      {"internally lit sign", has_sign<SignLighting::internal>},
      {"externally lit sign", has_sign<SignLighting::external>},
      {"photoluminescent sign", has_sign<SignLighting::photoluminescent>},
      {"two-sided sign",
       [](R s) { return any(s.description.signs, [](const Sign& g) { return g.double_sided; }); }},
      {"sign with words",
       [](R s) {
         return any(s.description.signs, [](const Sign& g) { return g.face.width == 64; });
       }},
      {"sign with a luminance map",
       [](R s) {
         return any(s.description.signs,
                    [](const Sign& g) { return !g.face.relative_luminance.empty(); });
       }},
      {"mains", operates<Operation::mains>},
      {"emergency", operates<Operation::emergency>},
      {"dark", operates<Operation::dark>},
      {"one source group", has_groups<GroupRule::one>},
      {"source groups by circuit", has_groups<GroupRule::by_circuit>},
      {"source groups by emitter", has_groups<GroupRule::by_emitter>},
      {"independent draws", [](R s) { return !s.description.run.stratified; }},
      {"analogue game", [](R s) { return s.description.run.analogue; }},
      {"given band edges", [](R s) { return !s.description.run.band_edges_nm.empty(); }},
  };
}

std::vector<Feature> media_features() {
  using enum MediumKind;
  using enum PhaseKind;
  return {
      {"no medium", [](R s) { return s.description.media.empty(); }},
      {"several media", [](R s) { return s.description.media.size() > 1; }},
      {"homogeneous", has_medium<homogeneous>},
      {"layered", has_medium<layered>},
      {"20 layers and more",
       [](R s) {
         return any(s.description.media, [](const Medium& m) { return m.layers.size() >= 20; });
       }},
      {"bounded", has_medium<bounded>},
      {"clipped body",
       [](R s) {
         return any(s.description.media,
                    [](const Medium& m) { return m.quadric.clips.size() > 1; });
       }},
      {"data set", has_medium<data_set>},
      {"data set of several bricks",
       [](R s) {
         return any(s.description.media, [](const Medium& m) { return m.data.nx > 16; });
       }},
      {"footprint",
       [](R s) {
         return any(s.description.media,
                    [](const Medium& m) { return !m.footprint.polygon.empty(); });
       }},
      {"glowing body", has_flame<bounded>},
      {"glowing data set", has_flame<data_set>},
      {"interpolated emission",
       [](R s) {
         return any(s.description.media, [](const Medium& m) {
           return m.emission && m.data.interpolate_emission && !m.data.emission.empty();
         });
       }},
      {"isotropic phase", has_phase<PhaseKind::isotropic>},
      {"Henyey-Greenstein", has_phase<henyey_greenstein>},
      {"Rayleigh", has_phase<rayleigh>},
      {"tabulated phase", has_phase<tabulated>},
      {"g of 1e-7", [](R s) { return has_g(s, 1e-8, 1e-6); }},
      {"g of 0.999 and more", [](R s) { return has_g(s, 0.999, 1); }},
      {"extinction 0", [](R s) { return has_extinction(s, 0, 0); }},
      {"extinction of 1e4 /m and more", [](R s) { return has_extinction(s, 1e4, 1e6); }},
      {"extinction by wavelength",
       [](R s) {
         return any_optics(s, [](const SmokeOptics& o) {
           return o.extinction.table.has_value() || o.extinction.angstrom != 0;
         });
       }},
      {"albedo 0", [](R s) { return has_albedo(s, 0, 0); }},
      {"albedo 1 - 1e-6", [](R s) { return has_albedo(s, 1 - 2e-6, 1 - 5e-7); }},
      {"albedo 1", [](R s) { return has_albedo(s, 1, 1); }},
  };
}

std::vector<Feature> measure_features() {
  using enum VolumeGroupMeasure::Shape;
  return {
      {"plane", [](R s) { return !s.description.planes.empty(); }},
      {"counting plane", [](R s) { return !s.description.counting_planes.empty(); }},
      {"probe", [](R s) { return !s.description.probes.empty(); }},
      {"observer", [](R s) { return !s.description.observers.empty(); }},
      {"camera", [](R s) { return !s.description.cameras.empty(); }},
      {"surface group", [](R s) { return !s.description.surface_groups.empty(); }},
      {"volume group: box", has_volume<box>},
      {"volume group: sphere", has_volume<sphere>},
      {"volume group: shell", has_volume<shell>},
      {"volume group: layer", has_volume<layer>},
      {"voxels", [](R s) { return s.description.run.voxels && !s.description.media.empty(); }},
  };
}

}  // namespace

const std::vector<Feature>& features() {
  static const std::vector<Feature> all = [] {
    std::vector<Feature> out;
    for (const auto& part :
         {solid_features(), light_features(), media_features(), measure_features()})
      out.insert(out.end(), part.begin(), part.end());
    return out;
  }();
  return all;
}

void count_features(const RandomScene& scene, FeatureCounts& counts) {
  counts.resize(features().size());
  for (size_t i = 0; i < counts.size(); ++i) counts[i] += features()[i].in(scene) ? 1 : 0;
}

}  // namespace luxodus::test
