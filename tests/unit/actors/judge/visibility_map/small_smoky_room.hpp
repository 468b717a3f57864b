// A room of 12 m by 4 m with a lamp, a sign at its end and a screen in its middle, for tests of
// maps. Constant data and pure functions; any thread.
#pragma once

#include <string>

#include "actors/judge/assess/over_time.hpp"
#include "actors/results/run/open_scene.hpp"
#include "scenes/emergency/guidance.hpp"
#include "tests/kit/described.hpp"
#include "tests/kit/room_texts.hpp"

namespace luxodus::test {

/// `extinction`: in the scene file's syntax.
inline std::string smoky_room(const std::string& extinction) {
  return R"(
[run]
seed = 1

[[object]]
name = "room"
shape = "room"
low = [0, -2, 0]
high = [12, 2, 3]
material = "white80"

[[object]]
name = "screen"
shape = "box"
low = [5, -2, 0]
high = [5.1, 0, 3]
material = "grey50"

[[medium]]
name = "smoke"
kind = "homogeneous"
extinction = )" +
         extinction + R"(
albedo = 0.6
)" + middle_lamp +
         exit_sign_at("[11.95, 0, 2.2]") + "lighting = \"internal\"\n" +
         judged_way("[[1, 1, 0], [11, 1, 0]]", "1", "seconds_after_failure = 60\n");
}

/// Smoke that thickens, at 0, 30 and 60 s.
inline std::string thickening_room() {
  return smoky_room("[[0, 0.1], [60, 2.5]]") + "\n[time]\nfrom = 0\nto = 60\nstep = 30\n";
}

/// The states of a scene file.
inline StatesToAssess states_of(const std::filesystem::path& file) {
  StatesToAssess out{described(file), {}, {}};
  if (out.last->time) {
    out.times_s = times_of(*out.last->time);
    out.reader = reader_at_times(*out.last, file, FireFrames::nearest);
  }
  return out;
}

inline const std::atomic<bool> nobody_interrupts{false};
inline void say_nothing(const std::string&, double) {}

}  // namespace luxodus::test
