// Finds rooms that are not closed by the light that escapes. A batch of particles is traced with
// the walls, furniture and lamps of the scenario; without smoke, which would hide the hole, and
// with panes painted black, since light through windows is intended. These numbers differ from
// those of a run, whose results include smoke and panes.
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "actors/judge/inspect/site.hpp"
#include "scenes/light/transport/compile_light.hpp"
#include "scenes/light/transport/trace.hpp"

namespace luxodus {

namespace {

constexpr uint64_t escape_seed = 17;
/// The standard error of a share of 1 % is then 0.08 %.
constexpr int64_t particles = 1 << 14;
constexpr size_t pieces = 16;
/// Rays of a piece, after which the remaining particles are left out: 500 for each, where rooms of
/// usual reflectances need ten. So this ends in rooms that absorb nothing.
constexpr uint64_t rays_of_piece = 500 * particles / pieces;
/// Rays of a particle, on average, from which on a run takes long: reflectances of 0.998.
constexpr double many_rays_of_particle = 1000;
constexpr double told_share = 0.01;
/// Factor that makes a flame transparent but still glowing.
constexpr double no_smoke = 1e-9;

/// One source group and one band: shares of light then equal shares of particles.
SceneDescription bare(const SceneDescription& scene, const Misplaced& misplaced) {
  SceneDescription out = without_measurements(scene);
  out.run.error_of.clear();
  out.run.max_bands = 1;
  out.run.band_edges_nm.clear();
  out.run.groups = GroupRule::one;
  out.run.batch_particles = particles;
  for (Material& m : out.materials)
    if (m.kind == MaterialKind::glass_pane) {
      m.kind = MaterialKind::lambertian;
      m.reflectance = Spectrum::constant(0);
    }
  std::vector<Sign> signs;
  for (size_t i = 0; i < out.signs.size(); ++i)
    if (misplaced.signs[i] == 0) signs.push_back(std::move(out.signs[i]));
  out.signs = std::move(signs);
  const std::vector<char>& outside = misplaced.emitters;
  const bool all_outside = std::count(outside.begin(), outside.end(), 0) == 0;
  if (all_outside) return out;
  std::vector<Emitter> inside;
  for (size_t i = 0; i < out.emitters.size(); ++i)
    if (outside[i] == 0) inside.push_back(std::move(out.emitters[i]));
  out.emitters = std::move(inside);
  return out;
}

Scenario in_clear_air(const SceneDescription& scene, const Scenario& scenario,
                      const std::vector<char>& misplaced) {
  Scenario out = scenario;
  out.smoke_factor = 0;
  out.media.clear();
  for (size_t i = 0; i < scene.media.size(); ++i) {
    const Medium& m = scene.media[i];
    const auto named = std::find_if(scenario.media.begin(), scenario.media.end(),
                                    [&](const auto& factor) { return factor.name == m.name; });
    const bool burns = m.emission && (named == scenario.media.end() || named->factor > 0) &&
                       (i >= misplaced.size() || misplaced[i] == 0);
    out.media.push_back({m.name, burns ? no_smoke : 0});
  }
  return out;
}

std::string percent(double share) {
  return share >= 0.1 ? fmt::format("{:.0f} %", 100 * share) : fmt::format("{:.2g} %", 100 * share);
}

}  // namespace

std::optional<EscapeShares> escape_shares(const SceneDescription& scene, const Scenario& scenario,
                                          const Misplaced& misplaced, int threads) {
  const auto building = Building::make(bare(scene, misplaced),
                                       in_clear_air(scene, scenario, misplaced.media), threads);
  if (!building) return std::nullopt;
  const CompiledScene& compiled = building.value()->scene();
  std::array<std::array<double, 6>, pieces> escaped{};
  std::array<double, pieces> ended{}, rays{};
  building.value()->each(pieces, [&](const GeometryAccess& access, size_t piece) {
    constexpr auto each = particles / static_cast<int64_t>(pieces);
    BatchScores scores;
    scores.reset(compiled.layout);
    // As if the batch had traced all others: particles that it has no rays for count as lost.
    constexpr uint64_t traced = limits::rays_per_batch - rays_of_piece;
    scores.balance.rays = traced;
    make_batch_tracer(compiled, access, escape_seed)
        ->trace(0, static_cast<uint64_t>(piece) * each, each, scores);
    for (uint32_t side = 0; side < 6; ++side) {
      const int64_t at = compiled.layout.score_index(compiled.blocks.escape, side, 0, 0);
      escaped[piece][side] = std::ldexp(static_cast<double>(scores.scores.data()[at]), -32);
    }
    const EnergyBalance& balance = scores.balance;
    ended[piece] = std::ldexp(to_double(balance.emitted - balance.lost()), -32);
    rays[piece] = static_cast<double>(balance.rays - traced);
  });
  EscapeShares out;
  const double all_ended = std::accumulate(ended.begin(), ended.end(), 0.0);
  const double all_rays = std::accumulate(rays.begin(), rays.end(), 0.0);
  out.rays_per_particle =
      all_ended > 0 ? all_rays / all_ended : std::numeric_limits<double>::infinity();
  if (!(all_ended > 0)) return out;
  for (const auto& piece : escaped)
    for (size_t side = 0; side < 6; ++side) out.by_side[side] += piece[side] / all_ended;
  const double all = std::accumulate(out.by_side.begin(), out.by_side.end(), 0.0);
  out.standard_error = std::sqrt(all * std::max(1 - all, 0.0) / all_ended);
  return out;
}

std::optional<Finding> white_rooms(const SceneDescription& scene, const Scenario& scenario,
                                   const EscapeShares& shares) {
  if (shares.rays_per_particle < many_rays_of_particle) return std::nullopt;
  const bool never = std::isinf(shares.rays_per_particle);
  const bool smoke = std::any_of(scene.media.begin(), scene.media.end(), [&](const Medium& m) {
    return extinction_factor(scenario, m.name) > 0;
  });
  return Finding{
      never && !smoke ? Severity::error : Severity::warning,
      "material",
      {{scene.file, 0},
       fmt::format("light is {} absorbed, and hardly any escapes: {}; give the surfaces of closed "
                   "rooms reflectances below 1 (fresh white paint has 0.85)",
                   never ? "never" : "hardly",
                   never && !smoke ? "illuminances have no limit, and a run no end"
                   : never         ? "nothing but smoke ends a particle"
                                   : fmt::format("a particle meets {:.3g} surfaces on average, and "
                                                         "a run takes so much longer",
                                                 shares.rays_per_particle))}};
}

std::optional<Finding> open_rooms(const SceneDescription& scene, const EscapeShares& shares) {
  double undeclared = 0;
  std::string sides, words;
  for (size_t side = 0; side < shares.by_side.size(); ++side) {
    const auto& open = scene.open_sides;
    if (std::find(open.begin(), open.end(), static_cast<Side>(side)) != open.end()) continue;
    undeclared += shares.by_side[side];
    if (shares.by_side[side] < told_share / 10) continue;
    sides += fmt::format("{}{} {}", sides.empty() ? "" : ", ", side_words[side],
                         percent(shares.by_side[side]));
    words += fmt::format("{}\"{}\"", words.empty() ? "" : ", ", side_words[side]);
  }
  if (undeclared <= told_share + 2 * shares.standard_error) return std::nullopt;
  for (const Side side : scene.open_sides)
    words = fmt::format("\"{}\", ", side_words[static_cast<size_t>(side)]) + words;
  return Finding{
      Severity::warning,
      "open",
      {{scene.file, 0},
       fmt::format("the rooms are not closed: in clear air {} of the light leaves the scene "
                   "({}): draw what is missing, or declare open_sides = [{}]",
                   percent(undeclared), sides, words)}};
}

}  // namespace luxodus
