// Band shares follow vision: particles are allotted to a band in proportion to its power times its
// weight in XYZ, so that few are spent on invisible light. Every band with power has a positive
// share, and results are divided by it, so the estimate is unbiased.
#include "scenes/light/transport/compile_light.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>

#include "scenes/light/signs/onset.hpp"
#include "scenes/light/signs/sign_light.hpp"

namespace luxodus {

namespace {

double emitter_flux(const Emitter& e, const Scenario& scenario) {
  switch (scenario.operation) {
    case Operation::mains:
      return e.mains_flux;
    case Operation::emergency:
      return e.emergency_flux *
             (scenario.says_seconds ? emergency_share(e, scenario.seconds_after_failure) : 1);
    case Operation::dark:
      return 0;
  }
  return 0;
}

void add_emitters(const SceneDescription& scene, const Scenario& scenario,
                  std::vector<ActiveSource>& out) {
  for (uint32_t i = 0; i < scene.emitters.size(); ++i) {
    const Emitter& e = scene.emitters[i];
    const double flux = emitter_flux(e, scenario) * factor_of(scenario.circuits, e.circuit, 1);
    if (flux <= 0) continue;
    ActiveSource s;
    s.emitter = &e;
    s.description_index = i;
    s.shape = e.spectrum;
    const double efficacy = efficacy_lm_per_w(e.spectrum);
    s.watts = e.radiometric ? flux : flux / efficacy;
    s.lumens = e.radiometric ? flux * efficacy : flux;
    s.name = e.name;
    s.group = !e.group.empty() ? e.group : e.circuit;
    s.place = e.place;
    out.push_back(std::move(s));
  }
}

void add_signs(const SceneDescription& scene, const Scenario& scenario,
               std::vector<ActiveSource>& out) {
  for (uint32_t i = 0; i < scene.signs.size(); ++i) {
    const Sign& sign = scene.signs[i];
    for (int back = 0; back < (sign.double_sided ? 2 : 1); ++back) {
      for (size_t c = 0; c < sign.colours.size(); ++c) {
        const auto colour = static_cast<ColourIndex>(c);
        const double luminance = scenario_luminance(sign, colour, scenario);
        const double area = sign_colour_area_m2(sign, colour);
        if (luminance <= 0 || area <= 0) continue;
        ActiveSource s;
        s.sign = &sign;
        s.description_index = i;
        s.sign_back = back == 1;
        s.colour = colour;
        s.shape = sign.colours[c].shape;
        // L cos^n over the hemisphere, projected: L A 2 pi / (n + 2).
        s.lumens = luminance * area * 2 * std::numbers::pi / (sign.angular_exponent + 2);
        s.watts = s.lumens / efficacy_lm_per_w(s.shape);
        s.name = sign.name + (back ? " back " : " ") + sign.colours[c].name;
        s.group = !sign.group.empty() ? sign.group : sign.circuit;
        s.place = sign.place;
        out.push_back(std::move(s));
      }
    }
  }
}

void add_flames(const SceneDescription& scene, const Scenario& scenario,
                std::vector<ActiveSource>& out) {
  for (uint32_t i = 0; i < scene.media.size(); ++i) {
    const Medium& m = scene.media[i];
    if (!m.emission) continue;
    const double watts =
        m.emission->power_w * m.emission->visible_fraction * flame_share(scenario, m);
    if (watts <= 0) continue;
    ActiveSource s;
    s.medium = &m;
    s.description_index = i;
    s.shape = m.emission->spectrum;
    s.watts = watts;
    s.lumens = watts * efficacy_lm_per_w(s.shape);
    s.name = m.name;
    s.group = !m.emission->group.empty() ? m.emission->group : "flames";
    s.place = m.place;
    out.push_back(std::move(s));
  }
}

}  // namespace

double flame_share(const Scenario& scenario, const Medium& medium) {
  if (!medium.emission || factor_of(scenario.media, medium.name, 1) <= 0) return 0;
  return scenario.emission_factor * factor_of(scenario.circuits, medium.emission->circuit, 1);
}

double factor_of(const std::vector<Scenario::Factor>& factors, const std::string& name,
                 double other) {
  for (const Scenario::Factor& f : factors) {
    if (f.name == name) return f.factor;
  }
  return other;
}

double extinction_factor(const Scenario& scenario, const std::string& medium) {
  return factor_of(scenario.media, medium, scenario.smoke_factor);
}

double factor_of_medium(const Scenario& scenario, const Medium& medium) {
  const double named = factor_of(scenario.media, medium.name, -1);
  if (named >= 0) return named;
  // A flame is not smoke: the general factor does not apply. A data set of a fire has both.
  const bool flame = medium.emission && medium.kind != MediumKind::data_set;
  return flame ? 1.0 : scenario.smoke_factor;
}

double scenario_luminance(const Sign& sign, ColourIndex colour, const Scenario& scenario) {
  // A photoluminescent face emits stored light, whatever the circuits do.
  const double circuit = sign.lighting == SignLighting::photoluminescent
                             ? 1
                             : factor_of(scenario.circuits, sign.circuit, 1);
  return circuit *
         sign_luminance(sign, colour, scenario.operation, scenario.seconds_after_failure, 1.0);
}

double sign_colour_area_m2(const Sign& sign, ColourIndex colour) {
  const auto count = std::count(sign.face.colour.begin(), sign.face.colour.end(), colour);
  if (sign.face.colour.empty()) return 0;
  return sign.width_m * sign.height_m * static_cast<double>(count) /
         static_cast<double>(sign.face.colour.size());
}

std::vector<ActiveSource> active_sources(const SceneDescription& scene, const Scenario& scenario) {
  std::vector<ActiveSource> out;
  add_emitters(scene, scenario, out);
  add_signs(scene, scenario, out);
  add_flames(scene, scenario, out);
  return out;
}

// ---- one emitter --------------------------------------------------------------------------------

namespace {

void place_frame(CompiledEmitter& out, const Frame& frame, const CompiledScene& scene) {
  out.origin = Vec3(frame.origin - scene.local_origin);
  out.axes = Mat3(frame.axes);
}

void normalise_cdf(std::vector<double>& cdf) {
  std::partial_sum(cdf.begin(), cdf.end(), cdf.begin());
  const double total = cdf.back();
  for (double& c : cdf) c /= total;
}

/// Least squared length of a triangle's normal before normalisation [m4]: below it (edges of 30 nm,
/// or corners that coincide in single precision) a triangle has no normal and emits nothing.
constexpr Real min_normal_squared = 1e-30_r;

void compile_mesh(CompiledEmitter& out, const Emitter& e, const CompiledScene& scene) {
  for (const glm::uvec3& t : e.mesh.triangles) {
    for (int k = 0; k < 3; ++k) {
      out.corners.push_back(Vec3(e.mesh.positions[t[k]] - scene.local_origin));
    }
    const Vec3* c = &out.corners[out.corners.size() - 3];
    const Vec3 normal = glm::cross(c[1] - c[0], c[2] - c[0]);
    const bool emits = glm::dot(normal, normal) >= min_normal_squared;
    out.texel_cdf.push_back(emits ? 0.5 * static_cast<double>(glm::length(normal)) : 0.0);
    out.area_m2 += out.texel_cdf.back();
  }
  if (out.area_m2 > 0) normalise_cdf(out.texel_cdf);
}

void compile_shape(CompiledEmitter& out, const Emitter& e, const CompiledScene& scene) {
  out.size = Vec3(e.size);
  switch (e.shape) {
    case EmitterShape::point:
      out.kind = EmitterKind::point;
      break;
    case EmitterShape::rectangle:
      out.kind = EmitterKind::rectangle;
      out.area_m2 = e.size.x * e.size.y;
      break;
    case EmitterShape::disc:
      out.kind = EmitterKind::disc;
      out.area_m2 = std::numbers::pi * e.size.x * e.size.x / 4;
      break;
    case EmitterShape::sphere:
      out.kind = EmitterKind::sphere;
      out.area_m2 = std::numbers::pi * e.size.x * e.size.x;
      break;
    case EmitterShape::tube:
      out.kind = EmitterKind::tube;
      out.area_m2 = std::numbers::pi * e.size.x * e.size.y;
      break;
    case EmitterShape::mesh:
      out.kind = EmitterKind::mesh;
      compile_mesh(out, e, scene);
      break;
  }
}

void compile_sign_face(CompiledEmitter& out, const ActiveSource& s, const CompiledScene& scene) {
  const Sign& sign = *s.sign;
  out.kind = EmitterKind::sign_face;
  out.distribution = Distribution::cosine_power;
  out.exponent = static_cast<Real>(sign.angular_exponent + 1);
  for (uint32_t i = 0; i < scene.signs.size(); ++i) {
    if (scene.signs[i].sign == s.description_index && scene.signs[i].back == s.sign_back)
      out.sign = i;
  }
  const CompiledSign& face = scene.signs[out.sign];
  out.origin = face.origin;
  out.axes = face.axes;
  out.size = Vec3(sign.width_m, sign.height_m, 0);
  out.area_m2 = sign_colour_area_m2(sign, s.colour);
  out.texel_columns = sign.face.width;
  for (size_t i = 0; i < sign.face.colour.size(); ++i) {
    const bool on = sign.face.colour[i] == s.colour;
    const double relative = sign.face.relative_luminance.empty()
                                ? 1.0
                                : static_cast<double>(sign.face.relative_luminance[i]);
    out.texel_cdf.push_back(on ? relative : 0.0);
  }
  normalise_cdf(out.texel_cdf);
}

}  // namespace

CompiledEmitter compile_emitter(const ActiveSource& s, const CompiledScene& scene) {
  CompiledEmitter out;
  out.name = s.name;
  out.luminous_flux_lm = s.lumens;
  if (s.emitter != nullptr) {
    const Emitter& e = *s.emitter;
    place_frame(out, e.frame, scene);
    compile_shape(out, e, scene);
    out.body = e.body;
    out.distribution = e.distribution;
    out.exponent = static_cast<Real>(e.cosine_power);
    if (e.distribution == Distribution::spot)
      out.spot = SpotLobe::from_half_angles(glm::radians(e.spot_inner_deg),
                                            glm::radians(e.spot_outer_deg));
    for (uint32_t i = 0; i < scene.webs.size(); ++i) {
      if (scene.webs[i] == e.web) out.web = i;
    }
  } else if (s.medium != nullptr) {
    out.kind = EmitterKind::volume;
    out.distribution = Distribution::isotropic;
    out.medium = s.description_index;
  } else {
    compile_sign_face(out, s, scene);
  }
  // Band coefficients hold for the scene's light as a whole; for an emitter with another spectrum,
  // lumens and colour are made exact.
  if (s.lumens > 0) {
    out.power_w = scene.bands.powers(s.shape, s.lumens);
  } else {
    for (int b = 0; b < scene.bands.count(); ++b)
      out.power_w.push_back(s.watts * scene.bands.power(s.shape, b));
  }
  return out;
}

// ---- groups -------------------------------------------------------------------------------------

namespace {

std::vector<uint64_t> integer_cdf(const std::vector<double>& share) {
  std::vector<uint64_t> cdf;
  double sum = 0;
  const double total = std::accumulate(share.begin(), share.end(), 0.0);
  for (const double s : share) {
    sum += s;
    const double scaled = std::ldexp(sum / total, 64);
    cdf.push_back(scaled >= 0x1.fffffffffffffp63 ? ~uint64_t{0} : static_cast<uint64_t>(scaled));
  }
  // upper_bound finds the first entry above r, so the last positive entry must be above every r.
  for (size_t i = share.size(); i-- > 0;) {
    cdf[i] = ~uint64_t{0};
    if (share[i] > 0) break;
  }
  return cdf;
}

void finish_group(Group& group, const CompiledScene& scene) {
  const auto bands = static_cast<size_t>(scene.bands.count());
  std::vector<double> weight(bands);
  for (size_t b = 0; b < bands; ++b) {
    const Band& band = scene.bands[static_cast<int>(b)];
    weight[b] = group.power_w[b] * (band.lm_per_w + 0.2 * (band.x_per_w + band.z_per_w) + 0.5);
  }
  const double total = std::accumulate(weight.begin(), weight.end(), 0.0);
  for (double& w : weight) w /= total;
  group.band_share = weight;
  group.band_cdf = integer_cdf(weight);
  for (size_t b = 0; b < bands; ++b) {
    std::vector<double> share;
    for (const uint32_t i : group.emitters[b]) share.push_back(scene.emitters[i].power_w[b]);
    group.emitter_cdf.push_back(share.empty() ? std::vector<uint64_t>{} : integer_cdf(share));
  }
}

}  // namespace

void compile_groups(CompiledScene& scene, const std::vector<std::string>& group_names) {
  const auto bands = static_cast<size_t>(scene.bands.count());
  std::map<std::string, int> index;
  for (uint32_t i = 0; i < scene.emitters.size(); ++i) {
    const auto [at, fresh] =
        index.try_emplace(group_names[i], static_cast<int>(scene.groups.size()));
    if (fresh) {
      Group group;
      group.name = group_names[i];
      group.power_w.assign(bands, 0);
      group.emitters.resize(bands);
      scene.groups.push_back(std::move(group));
    }
    CompiledEmitter& emitter = scene.emitters[i];
    emitter.group = at->second;
    Group& group = scene.groups[static_cast<size_t>(at->second)];
    group.luminous_flux_lm += emitter.luminous_flux_lm;
    for (size_t b = 0; b < bands; ++b) {
      group.power_w[b] += emitter.power_w[b];
      if (emitter.power_w[b] > 0) group.emitters[b].push_back(i);
    }
  }
  for (Group& group : scene.groups) finish_group(group, scene);
}

}  // namespace luxodus
