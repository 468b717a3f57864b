#include "tests/random/check_scene.hpp"

#include <xmmintrin.h>

#include <algorithm>
#include <cmath>
#include <thread>

#include "runtime/core/denormals.hpp"
#include "scenes/light/transport/compile.hpp"
#include "scenes/light/transport/readout.hpp"
#include "scenes/light/transport/trace.hpp"
#include "tests/random/check_scores.hpp"
#include "tests/random/forgetful_source.hpp"

namespace luxodus::test {

namespace {

/// Every so many scenes are traced again in each of the other ways.
constexpr uint64_t every_forgetful = 4, every_threaded = 16;
constexpr int batches_per_group = 2;  // a standard error needs two
constexpr double longest_sentence = 600;

/// If every event keeps at most this share, no history lasts a million events.
constexpr double min_patience = 0.9999;

double max_of(const Spectrum& s) {
  return *std::max_element(s.value.begin(), s.value.end());
}

bool keeps_light(const SmokeOptics& optics) {
  return max_of(optics.albedo) >= min_patience;
}

/// Whether something in the scene may keep light for the maximum length of a history.
bool is_patient(const SceneDescription& d) {
  for (const Material& m : d.materials) {
    if (m.kind == MaterialKind::dielectric) return true;  // total reflection takes nothing
    const double mirror = m.kind == MaterialKind::lambertian ? 0 : max_of(m.specular);
    if (max_of(m.reflectance) + mirror >= min_patience) return true;
  }
  for (const Sign& s : d.signs)
    for (const FaceColour& colour : s.colours)
      if (max_of(colour.reflectance) >= min_patience) return true;
  for (const Medium& m : d.media) {
    if (keeps_light(m.optics)) return true;
    for (const Layer& l : m.layers)
      if (keeps_light(l.optics)) return true;
    for (const float a : m.data.albedo)
      if (static_cast<double>(a) >= min_patience) return true;
  }
  return false;
}

/// Sets denormals to zero, as tracing threads do.
class TracingArithmetic {
 public:
  TracingArithmetic() { flush_denormals(); }
  ~TracingArithmetic() { _mm_setcsr(before_); }
  TracingArithmetic(const TracingArithmetic&) = delete;
  TracingArithmetic& operator=(const TracingArithmetic&) = delete;

 private:
  const unsigned before_ = _mm_getcsr();
};

/// One batch of a scene, cut off at the limit of rays, which depends on its own rays alone.
struct Part {
  int64_t number = 0;
  int group = 0;
  uint64_t first_particle = 0;
};

std::vector<Part> parts_of(const CompiledScene& scene) {
  std::vector<Part> out;
  for (int b = 0; b < batches_per_group; ++b) {
    for (int g = 0; g < static_cast<int>(scene.groups.size()); ++g) {
      const auto first = static_cast<uint64_t>(b * scene.batch_particles);
      out.push_back(
          {static_cast<int64_t>(out.size()), g, (static_cast<uint64_t>(g) << 40) + first});
    }
  }
  return out;
}

void trace_part(BatchTracer& tracer, const CompiledScene& scene, const Part& part,
                BatchScores& scores) {
  scores.reset(scene.layout);
  for (int64_t i = 0; i < scene.batch_particles; ++i) {
    if (scores.balance.rays >= limits::rays_per_batch) break;
    tracer.trace(part.group, part.first_particle + static_cast<uint64_t>(i), 1, scores);
  }
  for (uint32_t unit = 0; unit < tracer.look_units(); ++unit)
    tracer.look(part.number, unit, scores);
}

/// A compiled scene and the findings about it.
class SceneCheck {
 public:
  SceneCheck(const RandomScene& drawn, const CompiledScene& scene, const EmbreeDevice& device,
             uint64_t number)
      : scene_(scene),
        device_(device),
        index_(device, scene),
        access_(GeometryAccess::resident(index_)),
        number_(number),
        seed_(drawn.description.run.seed),
        expected_{drawn.closed, is_patient(drawn.description)} {}

  Findings findings;
  uint64_t rays = 0;

  void check() {
    check_skeleton();
    Totals totals = make_totals();
    const auto tracer = make_batch_tracer(scene_, access_, seed_);
    BatchScores scores;
    for (const Part& part : parts_of(scene_)) {
      trace_part(*tracer, scene_, part, scores);
      if (!findings.empty()) return;
      check_ledger(scene_, scores.balance, expected_, findings);
      check_batch(scene_, scores, findings);
      totals.merge(scores, part.group);
    }
    rays = totals.balance().rays;
    check_readout(scene_, totals, findings);
    check_points();
    check_pictures();
    if (number_ % every_forgetful == 0) check_forgetful(totals);
    if (number_ % every_threaded == 1) check_threaded(totals);
  }

 private:
  Totals make_totals() const {
    return Totals(scene_.layout, static_cast<int>(scene_.groups.size()), photopic_weights(scene_));
  }

  void check_value(double value, const std::string& what) {
    if (std::isfinite(value) && value >= 0) return;
    findings.push_back(what + " is " + std::to_string(value));
  }

  void check_skeleton() {
    for (const Group& g : scene_.groups) {
      check_value(g.luminous_flux_lm, "the flux of group " + g.name);
      for (const double w : g.power_w) check_value(w, "the power of group " + g.name);
      for (const double s : g.band_share) check_value(s, "a band's share of group " + g.name);
    }
    check_value(scene_.total_area_m2, "the area");
  }

  /// Checks direct light at probes.
  void check_points() {
    for (const ProbeMeasure& p : scene_.description->probes) {
      const glm::vec3 at(p.position - scene_.local_origin), normal(p.normal);
      for (const bool media : {true, false}) {
        const DirectLight light = direct_light_at(scene_, access_, at, normal, {media, 1.0 / 4});
        check_value(light.total_lx(), "direct light at a probe");
        check_value(light.total_fluence(), "direct fluence at a probe");
      }
    }
  }

  void check_pictures() {
    if (scene_.description->cameras.empty()) return;
    const Camera& camera = scene_.description->cameras.front();
    const glm::dvec3 way = camera.target - camera.eye;
    if (!(glm::length(way) > 1e-6)) return;
    const auto tracer = make_picture_tracer(scene_, access_, seed_, make_emitter_sight(scene_));
    for (uint32_t path = 0; path < 4; ++path) {
      tracer->start(0, 4, path);
      const int hero = tracer->choose_band(static_cast<double>(tracer->uniform()));
      const Ray ray{glm::vec3(camera.eye - scene_.local_origin), glm::vec3(glm::normalize(way))};
      for (const double radiance : tracer->radiance(ray, hero, nullptr, nullptr))
        check_value(radiance, "radiance in a picture");
    }
  }

  /// Traces with parts that are evicted, and batches in another order.
  void check_forgetful(const Totals& totals) {
    ForgetfulSource source(device_, scene_, number_);
    const ProxyScene proxies(device_, scene_.cell_boxes);
    const auto tracer = make_batch_tracer(scene_, GeometryAccess::through(proxies, source), seed_);
    Totals again = make_totals();
    BatchScores scores;
    std::vector<Part> parts = parts_of(scene_);
    std::reverse(parts.begin(), parts.end());
    for (const Part& part : parts) {
      trace_part(*tracer, scene_, part, scores);
      again.merge(scores, part.group);
    }
    check_same(totals, again, "where parts come and go", findings);
  }

  void check_threaded(const Totals& totals) {
    Totals again = make_totals();
    const std::vector<Part> parts = parts_of(scene_);
    const auto work = [&](size_t first) {
      const TracingArithmetic arithmetic;
      const auto tracer = make_batch_tracer(scene_, access_, seed_);
      BatchScores scores;
      for (size_t i = first; i < parts.size(); i += 2) {
        trace_part(*tracer, scene_, parts[i], scores);
        again.merge(scores, parts[i].group);
      }
    };
    std::thread other(work, 1);
    work(0);
    other.join();
    check_same(totals, again, "with two threads", findings);
  }

  const CompiledScene& scene_;
  const EmbreeDevice& device_;
  const SceneIndex index_;
  const GeometryAccess access_;
  const uint64_t number_;
  const uint64_t seed_;
  const Expected expected_;
};

void check_sentence(const std::string& what, Findings& findings) {
  const bool one = !what.empty() && what.find('\n') == std::string::npos &&
                   static_cast<double>(what.size()) < longest_sentence;
  if (!one) findings.push_back("a refusal that is no sentence: " + what);
}

}  // namespace

std::string kind_of_refusal(const std::string& what) {
  std::string out;
  bool quoted = false;
  for (const char c : what) {
    const bool mark = c == '"' || c == '\'';
    if (mark && (quoted || out.empty() || out.back() == ' ' || out.back() == '(')) quoted = !quoted;
    const bool number = (c >= '0' && c <= '9') || c == '.' || c == '-';
    const char shown = number ? '#' : c;
    if (quoted || (shown == '#' && !out.empty() && out.back() == '#')) continue;
    out += shown;
  }
  return out;
}

Verdict check_scene(const RandomScene& drawn, uint64_t number, const EmbreeDevice& device) {
  Verdict verdict;
  const auto description = std::make_shared<const SceneDescription>(drawn.description);
  const auto compiled = compile_scene(description, drawn.scenario, {drawn.cells});
  if (!compiled.ok()) {
    verdict.refusal = kind_of_refusal(compiled.problem().what);
    check_sentence(compiled.problem().what, verdict.findings);
    return verdict;
  }
  verdict.accepted = true;
  const CompiledScene& scene = *compiled.value();
  if (scene.layout.scores() > limits::scores_checked || scene.triangles > limits::triangles_checked)
    return verdict;
  const TracingArithmetic arithmetic;
  SceneCheck check(drawn, scene, device, number);
  check.check();
  verdict.findings = std::move(check.findings);
  verdict.rays = check.rays;
  return verdict;
}

}  // namespace luxodus::test
