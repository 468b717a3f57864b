// A room for tests of live views: two lamps and a sign, each a source group.
#pragma once

#include <catch2/catch.hpp>
#include <string>

#include "actors/view/live_scene.hpp"
#include "scenes/scene_file/scene_file.hpp"
#include "tests/kit/temporary_folder.hpp"

namespace luxodus::test {

inline const std::string live_room = R"(
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

[[sign]]
name = "exit"
position = [5.9, 2, 2.2]
facing = [-1, 0, 0]
width = 0.4
height = 0.2
text = "EXIT"
letter_height = 0.15
mains_white = 500
mains_green = 50
emergency_white = 100
emergency_green = 10
)";

/// Source groups of the room, in their order.
inline constexpr int left = 0, right = 1, sign = 2;

class LiveRoom {
 public:
  /// `more`: what is in it besides.
  explicit LiveRoom(const std::string& more = "") {
    auto read = read_scene(folder_.write("room.toml", live_room + more));
    REQUIRE(read.scene);
    scene_ = std::make_shared<const SceneDescription>(std::move(*read.scene));
  }
  const std::shared_ptr<const SceneDescription>& scene() const { return scene_; }
  std::shared_ptr<const CompiledScene> compiled(const SceneEdits& edits) const {
    auto out = compile_live(*scene_, edits);
    REQUIRE(out.ok());
    return out.value();
  }

 private:
  const TemporaryFolder folder_;
  std::shared_ptr<const SceneDescription> scene_;
};

inline SceneEdits moved_lamp() {
  SceneEdits edits;
  edits.luminaires["left"] = {{1, 1, 1}, std::nullopt};
  return edits;
}

}  // namespace luxodus::test
