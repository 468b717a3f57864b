// Suggestions of a live view: for the building with moves and additions; and refusals.
#include "actors/apps/view/suggestions.hpp"

#include <catch2/catch.hpp>

#include "tests/kit/temporary_folder.hpp"
#include "tests/unit/actors/apps/view/live_room.hpp"

namespace luxodus {
namespace {

using test::TemporaryFolder;

const std::atomic<bool> goes_on{false};

SceneEdits with_copy(const glm::dvec3& position) {
  SceneEdits edits;
  edits.scenario = "failed";
  edits.added.push_back({false, "lamp", "lamp copy"});
  edits.luminaires["lamp copy"] = {position, std::nullopt};
  return edits;
}

Json suggested(const SceneDescription& scene, const SceneEdits& edits,
               const std::vector<std::string>& free = {}) {
  LiveOptions options;
  options.threads = 2;
  return suggestion(scene, edits, free, options, goes_on);
}

}  // namespace

TEST_CASE("suggestions depend on additions, and use only the scene's types", "[view][suggest]") {
  const TemporaryFolder folder;
  const auto scene = test::emergency_room(folder);
  SceneEdits none;
  none.scenario = "failed";
  const Json alone = suggested(*scene, none);
  INFO(alone.dump());
  REQUIRE(alone["type"] == "suggested");
  REQUIRE(alone["luminaires"].size() >= 1);
  CHECK(alone["luminaires"][0]["of"] == "lamp");
  CHECK(alone["words"].get<std::string>().find("more would do") != std::string::npos);
  // An addition far off saves one suggestion, or none.
  const Json helped = suggested(*scene, with_copy({10, 1.5, 2.97}));
  REQUIRE(helped["type"] == "suggested");
  CHECK(helped["missing"].get<double>() < alone["missing"].get<double>());
  CHECK(helped["luminaires"].size() <= alone["luminaires"].size());
  // If it may be removed, the result is as if it did not exist.
  const Json freed = suggested(*scene, with_copy({10, 1.5, 2.97}), {"lamp copy"});
  CHECK(freed["luminaires"] == alone["luminaires"]);
  CHECK(freed["instead_of"] == Json(std::vector<std::string>{"lamp copy"}));
}

TEST_CASE("only additions of the view may be removed", "[view][suggest]") {
  const TemporaryFolder folder;
  const auto scene = test::emergency_room(folder);
  const Json answer = suggested(*scene, with_copy({10, 1.5, 2.97}), {"lamp"});
  CHECK(answer["type"] == "refused");
  CHECK(answer["why"].get<std::string>().find("\"lamp\"") != std::string::npos);
}

TEST_CASE("a scene without requirements on luminaires gets no suggestion", "[view][suggest]") {
  const TemporaryFolder folder;
  const auto scene = test::described(folder.write("scene.toml", R"(
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
)"));
  const Json answer = suggested(*scene, {});
  CHECK(answer["type"] == "refused");
  CHECK(answer["why"].get<std::string>().find("nothing to light") != std::string::npos);
}

}  // namespace luxodus
