#include "actors/judge/thresholds/looks.hpp"

#include <algorithm>
#include <cmath>

namespace luxodus {

namespace {

constexpr double level_error = 0.15;
/// How much more error of the logarithm a level may have for each unit that it is from its limit.
constexpr double error_by_excess = 0.2;

bool decided_by_light(const Sight& sight) {
  return sight.verdict == SightVerdict::legible || sight.verdict == SightVerdict::visible ||
         sight.verdict == SightVerdict::invisible || sight.verdict == SightVerdict::undecided;
}

}  // namespace

ViewKey key_of(const SightRow& row) {
  return {row.from.kind, row.from.name, row.eye.x, row.eye.y, row.eye.z, row.sign};
}

const Sign& sign_of(const SceneDescription& scene, const SightRow& row) {
  return *std::find_if(scene.signs.begin(), scene.signs.end(),
                       [&](const Sign& sign) { return sign.name == row.sign; });
}

std::vector<std::string> eyes_of(const SceneDescription& scene) {
  std::vector<std::string> out{""};
  for (const OtherEyes& eyes : scene.assessment.other_eyes) out.push_back(eyes.name);
  return out;
}

std::vector<Sight> sights_of(const SightRow& row) {
  // A view that is not assessed for want of the initial flux has levels all the same.
  const bool traced = row.look.legend.value + row.look.face.value > 0;
  if (!traced || row.sight.verdict == SightVerdict::hidden || !row.sight.reading_level.value)
    return {};
  std::vector<Sight> out{row.sight};
  if (row.other && decided_by_light(row.other->sight)) {
    const auto take_lower = [](Uncertain& level, const Uncertain& other) {
      if (other.value < level.value) level = other;
    };
    take_lower(out.front().reading_level, row.other->sight.reading_level);
    take_lower(out.front().seeing_level, row.other->sight.seeing_level);
  }
  out.insert(out.end(), row.by_other_eyes.begin(), row.by_other_eyes.end());
  return out;
}

LevelPoint point_of(double at, const Sight& sight, bool read) {
  if (!read) return level_point(at, sight.seeing_level, sight.seen_from);
  return sight.stings ? impossible_point(at) : level_point(at, sight.reading_level, level_read);
}

bool known_enough(const SightRow& row) {
  for (const Sight& sight : sights_of(row))
    for (const bool read : {true, false}) {
      const LevelPoint point = point_of(0, sight, read);
      if (point.possible && point.error > level_error + error_by_excess * std::abs(point.excess))
        return false;
    }
  return true;
}

AssessOptions looking_at(const std::set<ViewKey>& views, const AssessOptions& options) {
  AssessOptions out = options;
  out.rounds = threshold_rounds;
  out.wanted = [&views](const SightRow& row) { return views.contains(key_of(row)); };
  out.enough = known_enough;
  return out;
}

ThresholdRecord record_for(Sought sought, const SightRow& row, const std::string& eyes, bool read) {
  ThresholdRecord out;
  out.sought = sought;
  out.from = row.from;
  out.along_m = row.along_m;
  out.eye_height_m = row.height_m;
  out.sign = row.sign;
  out.eyes = eyes;
  out.read = read;
  return out;
}

}  // namespace luxodus
