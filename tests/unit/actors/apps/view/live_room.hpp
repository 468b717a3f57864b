// A room for tests of live views: two lamps and a sign, each a source group.
#pragma once

#include <catch2/catch.hpp>
#include <string>

#include "actors/apps/view/live_scene.hpp"
#include "tests/kit/described.hpp"
#include "tests/kit/room_texts.hpp"

namespace luxodus::test {

inline const std::string two_lamps = R"(
[[object]]
name = "room"
shape = "room"
low = [0, 0, 0]
high = [6, 4, 3]
material = "grey50"

[[emitter]]
name = "left"
shape = "point"
distribution = "isotropic"
position = [2, 2, 2]
flux_lm = 1000

[[emitter]]
name = "right"
shape = "point"
distribution = "isotropic"
position = [4, 2, 2]
flux_lm = 1000
)";
inline const std::string live_sign = exit_sign_at("[5.9, 2, 2.2]");
inline const std::string live_room = two_lamps + live_sign;

/// A lamp near one end of a route, too dark for EN 1838 at the other, after the mains have failed.
inline std::shared_ptr<const SceneDescription> emergency_room(const TemporaryFolder& folder) {
  return described(folder.write("scene.toml", R"(
[[object]]
name = "room"
shape = "room"
low = [0, 0, 0]
high = [14, 3, 3]
material = "white50"
[assessment]
rules = ["en1838-2013"]
[[scenario]]
name = "failed"
operation = "emergency"
[[emitter]]
name = "lamp"
shape = "disc"
diameter = 0.1
position = [3, 1.5, 2.97]
flux_lm = 200
emergency = "maintained"
emergency_flux = 200
maintenance_factor = 0.8
end_of_duration_factor = 0.7
[[route]]
name = "way"
path = [[1, 1.5, 0], [13, 1.5, 0]]
width = 1
)"));
}

/// Source groups of the room, in their order.
inline constexpr int left = 0, right = 1, sign = 2;

class LiveRoom {
 public:
  /// `more`: additional tables.
  explicit LiveRoom(const std::string& more = "")
      : scene_(described(folder_.write("scene.toml", live_room + more))) {}
  const std::shared_ptr<const SceneDescription>& scene() const { return scene_; }
  std::shared_ptr<const CompiledScene> compiled(const SceneEdits& edits) const {
    auto out = compile_live(*scene_, edits);
    REQUIRE(out.ok());
    return out.value();
  }

 private:
  TemporaryFolder folder_;  // variants of the scene refer to its file
  std::shared_ptr<const SceneDescription> scene_;
};

inline SceneEdits moved_lamp() {
  SceneEdits edits;
  edits.luminaires["left"] = {{1, 1, 1}, std::nullopt};
  return edits;
}

}  // namespace luxodus::test
