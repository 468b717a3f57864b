// Reads whose ways `luxodus walk` follows. The files of trajectories are read by that command: they
// change no light, and are no part of the scene's hash, unless people stand as bodies
// (people_bodies.cpp).
#include "scenes/formats/scene_file/scene_readers.hpp"

namespace luxodus {

namespace {

PeopleStorey read_storey(const toml::Table& table, SceneReading& reading) {
  KeyReader keys(table, {"people.storey"}, reading);
  PeopleStorey out;
  const glm::dvec2 a = keys.pair("low"), b = keys.pair("high");
  out.low = glm::min(a, b);
  out.high = glm::max(a, b);
  out.floor_m = keys.number("floor_m");
  out.shift = keys.pair("shift");
  return out;
}

}  // namespace

void read_people(const toml::Table& table, SceneReading& reading) {
  KeyReader keys(table, {"people"}, reading);
  PeopleSettings out;
  out.place = keys.place();
  const auto path = keys.file("file");
  out.name = read_name(keys, "group of people");
  out.turn_deg = keys.number("turn_deg");
  out.shift = keys.point("shift");
  out.time_shift_s = keys.number("time_shift_s");
  const double floor_m = keys.number("floor_m");
  if (keys.has("floor_m")) out.floor_m = floor_m;
  out.eye_height_m = keys.maybe_number("eye_height_m");
  out.luminance_before_cd_m2 = keys.maybe_number("luminance_before");
  for (const toml::Table* storey : keys.tables("storey"))
    out.storeys.push_back(read_storey(*storey, reading));
  if (out.floor_m && !out.storeys.empty())
    return keys.problem("floor_m",
                        "'floor_m' and [[people.storey]] exclude each other: each storey has its "
                        "own floor_m");
  if (!path || !keys.clean()) return;
  out.file = path->string();
  reading.people.push_back(std::move(out));
}

}  // namespace luxodus
