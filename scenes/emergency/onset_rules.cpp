// Illuminance a while after the mains have failed. Fluxes are those of the end of the rated
// duration, as for the rules whose light has to be there: what luminaires give then is least.
#include <algorithm>
#include <limits>
#include <numeric>

#include "scenes/emergency/onset.hpp"
#include "scenes/emergency/rule_table.hpp"
#include "scenes/emergency/rules.hpp"

namespace luxodus {

namespace {

constexpr double half_s = 5, full_s = 60, task_s = 0.5, nfpa_s = 10;
constexpr double nfpa_lx = 0.65;  // N2: what has to be there at the end

/// Of each luminaire; 0 of those that state no onset.
std::vector<double> shares_after(const SceneDescription& scene, double seconds) {
  std::vector<double> out;
  for (const uint32_t number : emergency_luminaires(scene)) {
    const auto& onset = scene.emitters[number].onset;
    out.push_back(onset.empty() ? 0 : onset_share(onset, seconds));
  }
  return out;
}

/// "\"a\" and 2 more"; "" where all state their onset.
std::string silent(const SceneDescription& scene) {
  std::string first;
  int more = -1;
  for (const uint32_t number : emergency_luminaires(scene)) {
    const Emitter& e = scene.emitters[number];
    if (!e.onset.empty()) continue;
    if (++more == 0) first = "\"" + e.name + "\"";
  }
  return more > 0 ? first + " and " + std::to_string(more) + " more" : first;
}

bool none_states(const SceneDescription& scene) {
  const auto all = emergency_luminaires(scene);
  return std::all_of(all.begin(), all.end(),
                     [&](uint32_t number) { return scene.emitters[number].onset.empty(); });
}

std::string seconds_text(double seconds) {
  return seconds < 1 ? "0.5 s" : std::to_string(static_cast<int>(seconds)) + " s";
}

Check in_time(const char* id, const SceneDescription& scene, const std::string& subject,
              const std::vector<LitPoint>& points, double seconds, double limit_lx) {
  const std::vector<double> shares = shares_after(scene, seconds);
  double least = std::numeric_limits<double>::infinity();
  glm::dvec3 darkest(0);
  for (const LitPoint& point : points) {
    const double lux = std::inner_product(point.lux.begin(), point.lux.end(), shares.begin(), 0.0);
    if (lux >= least) continue;
    least = lux;
    darkest = point.place;
  }
  if (points.empty()) return not_assessed(rule_of(id), subject, "there is no place to assess");
  const std::string unsaid = silent(scene);
  if (least < limit_lx && !unsaid.empty())
    return not_assessed(rule_of(id), subject,
                        "how fast they come on ('onset') is not said of " + unsaid);
  Check check = judged(rule_of(id), subject, least, limit_lx, true, "lx", darkest);
  check.condition = seconds_text(seconds) + " after the mains have failed";
  return check;
}

}  // namespace

std::vector<Check> checks_of_onset(const SceneDescription& scene, const std::string& subject,
                                   const std::vector<LitPoint>& points, double demanded_lx,
                                   const CodeChoice& codes) {
  if (none_states(scene)) return {};
  std::vector<Check> out;
  if (codes.en_2013 || codes.en_2024) {
    out.push_back(in_time("E10h", scene, subject, points, half_s, demanded_lx / 2));
    out.push_back(in_time("E10f", scene, subject, points, full_s, demanded_lx));
  }
  if (codes.nfpa) out.push_back(in_time("N5", scene, subject, points, nfpa_s, nfpa_lx));
  return out;
}

std::vector<Check> checks_of_task_onset(const SceneDescription& scene, const std::string& subject,
                                        const std::vector<LitPoint>& plane, double demanded_lx,
                                        const CodeChoice& codes) {
  if (none_states(scene) || (!codes.en_2013 && !codes.en_2024)) return {};
  return {in_time("E10t", scene, subject, plane, task_s, demanded_lx)};
}

std::vector<Check> checks_beyond(const SceneDescription& scene, const CodeChoice& codes) {
  std::vector<Check> out;
  const auto add = [&](const char* id, const char* subject, const char* reason) {
    out.push_back(not_assessed(rule_of(id), subject, reason));
  };
  const char* const all = "all luminaires and signs";
  const bool unsaid = none_states(scene);
  const char* const no_onset = "no luminaire says how fast it comes on ('onset')";
  if (codes.en_2013 || codes.en_2024) {
    add("E9", all, "a scene says how its light is spread over wavelengths only roughly");
    if (unsaid) add("E10", "all luminaires", no_onset);
    add("E10", "all signs", "a sign says nothing of how fast it comes on");
    add("E11", all, "a scene says nothing of how long their batteries last");
    add("S8", all, "the boxes of the standard are not at hand");
  }
  if (codes.nfpa) {
    if (unsaid) add("N5", "all luminaires", no_onset);
    add("N10", all, "a scene says nothing of how long their batteries last");
  }
  return out;
}

}  // namespace luxodus
