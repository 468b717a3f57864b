#include "scenes/formats/fields/fds_between.hpp"

#include <algorithm>
#include <cmath>
#include <new>
#include <numeric>

#include "scenes/formats/fields/fds_frames.hpp"
#include "scenes/formats/fields/fds_heat.hpp"
#include "scenes/formats/fields/fds_sources.hpp"

namespace luxodus {

namespace fds {
namespace {

/// A time nearer to a frame than this share of the interval is that of the frame, since FDS writes
/// at the first of its steps after a tick.
constexpr double same_frame_share = 0.01;

/// Heat of a cubic metre for each unit of emission [kW/m3]; 0 where nothing burns.
double heat_per_unit(const FireGrid& grid) {
  const auto& data = grid.data;
  const double all = std::accumulate(data.emission.begin(), data.emission.end(), 0.0);
  const double cell_m3 =
      data.extent.x * data.extent.y * data.extent.z / static_cast<double>(data.extinction.size());
  return all > 0 ? grid.heat_kw / (all * cell_m3) : 0;
}

void blend(FireGrid& early, const FireGrid& late, double share) {
  const auto mix = [share](double a, double b) { return (1 - share) * a + share * b; };
  for (size_t i = 0; i < early.data.extinction.size(); ++i)
    early.data.extinction[i] =
        static_cast<float>(mix(static_cast<double>(early.data.extinction[i]),
                               static_cast<double>(late.data.extinction[i])));
  const double before = heat_per_unit(early), after = heat_per_unit(late);
  const auto at = [](const FireGrid& grid, size_t i) {
    return i < grid.data.emission.size() ? static_cast<double>(grid.data.emission[i]) : 0;
  };
  std::vector<float> heat;
  if (before > 0 || after > 0)
    for (size_t i = 0; i < early.data.extinction.size(); ++i)
      heat.push_back(static_cast<float>(mix(before * at(early, i), after * at(late, i))));
  early.data.emission = std::move(heat);
  early.heat_kw = mix(early.heat_kw, late.heat_kw);
}

/// The frame on the other side of the time; none where the time is that of a frame.
std::optional<double> other_frame(const LoadedFire& nearest, double at_s) {
  const auto other = at_s > nearest.time_s ? nearest.next_s : nearest.previous_s;
  if (!other || is_of_frame(at_s, nearest.time_s, *other)) return std::nullopt;
  return other;
}

}  // namespace

bool is_of_frame(double at_s, double frame_s, double other_s) {
  const double gap = std::abs(other_s - frame_s);
  return gap <= same_tick_s || std::abs(at_s - frame_s) <= same_frame_share * gap;
}

LoadedFire blended(LoadedFire early, const LoadedFire& late, double share) {
  const auto mix = [share](double a, double b) { return (1 - share) * a + share * b; };
  for (size_t g = 0; g < early.grids.size(); ++g) blend(early.grids[g], late.grids[g], share);
  early.previous_s = early.time_s;
  early.next_s = late.time_s;
  early.time_s = mix(early.time_s, late.time_s);
  early.between_frames = true;
  early.overlapping |= late.overlapping;
  early.has_heat_release |= late.has_heat_release;
  early.heat_release_kw = mix(early.heat_release_kw, late.heat_release_kw);
  early.flame_extinction_share = mix(early.flame_extinction_share, late.flame_extinction_share);
  return early;
}

}  // namespace fds

namespace {

/// Heat is known at more times than there are frames.
Result<void> take_heat_at(const fds::Case& fire, double at_s, LoadedFire& out) {
  const auto power = fds::heat_release(fire, at_s);
  if (!power) return power.problem();
  const double now_kw = std::max(0.0, power->kw);
  for (FireGrid& grid : out.grids)
    if (out.heat_release_kw > 0) grid.heat_kw *= now_kw / out.heat_release_kw;
  out.heat_release_kw = now_kw;
  return {};
}

Result<LoadedFire> read_between(const fds::Case& fire, const FireOptions& options,
                                LoadedFire nearest) {
  const auto other_s = fds::other_frame(nearest, options.at_s);
  if (!other_s) return nearest;
  FireOptions there = options;
  there.at_s = *other_s;
  there.sources.clear();
  for (const FireSmoke& smoke : nearest.smokes) there.sources.push_back(smoke.source);
  auto other = fds::read_frame(fire, there);
  if (!other) return other.problem();
  LoadedFire& late = nearest.time_s < *other_s ? other.value() : nearest;
  LoadedFire& early = nearest.time_s < *other_s ? nearest : other.value();
  const double share = (options.at_s - early.time_s) / (late.time_s - early.time_s);
  LoadedFire out = fds::blended(std::move(early), late, share);
  if (options.flames)
    if (auto ok = take_heat_at(fire, options.at_s, out); !ok) return ok.problem();
  return out;
}

}  // namespace

Result<LoadedFire> read_fire(const std::filesystem::path& index, const FireOptions& options) {
  try {
    auto fire = fds::read_case(index);
    if (!fire) return fire.problem();
    auto nearest = fds::read_frame(fire.value(), options);
    if (!nearest || !options.between_frames) return nearest;
    return read_between(fire.value(), options, std::move(nearest).value());
  } catch (const std::bad_alloc&) {
    return problem_in(index.string(), "its cells take more memory than this process gets",
                      ProblemKind::no_room);
  }
}

std::optional<double> fire_time_near(const std::filesystem::path& index, double at_s) {
  const auto fire = fds::read_case(index);
  if (!fire) return std::nullopt;
  const auto time = fds::smoke_time_near(fire.value(), at_s);
  return time ? time.value() : std::nullopt;
}

}  // namespace luxodus
