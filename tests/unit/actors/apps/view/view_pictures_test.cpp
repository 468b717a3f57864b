// Traced pictures for viewers: their messages, order, and cancellation.
#include "actors/apps/view/view_pictures.hpp"

#include <catch2/catch.hpp>

#include "tests/unit/actors/apps/view/live_room.hpp"

using namespace luxodus;
using namespace luxodus::test;

namespace {

/// Limits by paths and particles only, however slow the machine is.
ViewPictureLimits few_paths() {
  ViewPictureLimits out;
  out.seconds = out.flux_seconds = 1e9;
  out.flux_particles = 1 << 16;
  out.paths = 64;
  return out;
}

RenderAsk small_picture(int64_t id) {
  RenderAsk ask;
  ask.id = id;
  ask.eye = {0.5, 2, 1.6};
  ask.target = {5, 2, 1.6};
  ask.width = 24;
  ask.height = 16;
  return ask;
}

/// Pictures of a room, and the messages about them.
class ToldPictures {
 public:
  explicit ToldPictures(const LiveRoom& room)
      : pictures_(
            LiveOptions{.threads = 1},
            [scene = room.scene()](std::optional<double>) { return Scene(scene); },
            [this](uint64_t viewer, const Json& message) { hear(viewer, message); }, few_paths()) {}

  ViewPictures& pictures() { return pictures_; }
  /// Waits for a message to a viewer for which `holds` is true.
  template <class Holds>
  Json wait(uint64_t viewer, Holds&& holds) {
    std::unique_lock lock(mutex_);
    Json found;
    came_.wait(lock, [&] {
      for (const auto& [to, message] : told_)
        if (to == viewer && holds(message)) return found = message, true;
      return false;
    });
    return found;
  }
  Json wait_done(uint64_t viewer, int64_t id) {
    return wait(viewer, [&](const Json& m) {
      return m["type"] == "picture" && m["id"] == id && m["done"];
    });
  }
  std::vector<Json> of(uint64_t viewer, int64_t id) {
    const std::lock_guard lock(mutex_);
    std::vector<Json> out;
    for (const auto& [to, message] : told_)
      if (to == viewer && message.contains("id") && message["id"] == id) out.push_back(message);
    return out;
  }
  void clear() {
    const std::lock_guard lock(mutex_);
    told_.clear();
  }

 private:
  using Scene = Result<std::shared_ptr<const SceneDescription>>;
  void hear(uint64_t viewer, const Json& message) {
    const std::lock_guard lock(mutex_);
    told_.emplace_back(viewer, message);
    came_.notify_all();
  }

  std::mutex mutex_;
  std::condition_variable came_;
  std::vector<std::pair<uint64_t, Json>> told_;
  ViewPictures pictures_;  // declared last: it sends messages
};

/// The error of paths falls with the root of their number; that of the flux is common to all, and
/// stays.
double error_of(const Json& message) {
  return message["relative_error"].get<double>();
}

}  // namespace

TEST_CASE("a picture is sent pass by pass, with decreasing error", "[view]") {
  const LiveRoom room;
  ToldPictures told(room);
  told.pictures().order({1, small_picture(7), {}, {}});
  const Json last = told.wait_done(1, 7);
  CHECK(last["paths"] == 64);
  std::vector<int> paths;
  const std::vector<Json> messages = told.of(1, 7);
  for (const Json& message : messages)
    if (!message["png"].is_null()) {
      paths.push_back(message["paths"].get<int>());
      CHECK(message["png"].get<std::string>().starts_with("iVBORw0KGgo"));
    }
  CHECK(paths == std::vector<int>{0, 4, 8, 16, 32, 48, 64});
  CHECK(messages.front()["png"].is_null());  // while the flux was traced
  const auto first = std::find_if(messages.begin(), messages.end(), [](const Json& message) {
    return !message["relative_error"].is_null();
  });
  REQUIRE(first != messages.end());
  CHECK(error_of(last) < 0.8 * error_of(*first));
  // The flux is cached: the next picture of the same building begins with its paths.
  told.pictures().order({1, small_picture(8), {}, {}});
  told.wait_done(1, 8);
  CHECK_FALSE(told.of(1, 8).front()["png"].is_null());
  // A dimmed building has another flux, and a darker picture has another file.
  told.pictures().order({1, small_picture(9), {}, {{"left", 0.0}}});
  told.wait_done(1, 9);
  CHECK(told.of(1, 9).front()["png"].is_null());
  CHECK(told.of(1, 9).back()["png"] != told.of(1, 8).back()["png"]);
}

TEST_CASE("pictures are made in order, and a cancelled viewer gets no more messages", "[view]") {
  const LiveRoom room;
  ToldPictures told(room);
  RenderAsk large = small_picture(1);
  large.width = large.height = 512;
  told.pictures().order({1, large, {}, {}});
  told.pictures().order({2, small_picture(2), {}, {}});
  told.pictures().order({3, small_picture(3), {}, {}});
  told.pictures().order({2, small_picture(4), {}, {}});  // replaces the previous one, and comes
                                                         // last
  told.wait(1, [](const Json& message) { return !message["png"].is_null(); });
  told.pictures().cancel(1);
  told.wait_done(2, 4);
  CHECK_FALSE(told.of(3, 3).empty());
  CHECK(told.of(2, 2).empty());
  CHECK_FALSE(told.of(1, 1).back()["done"].get<bool>());
}

TEST_CASE("an impossible picture is refused with a reason, and others are made", "[view]") {
  const LiveRoom room;
  ToldPictures told(room);
  SceneEdits edits;
  edits.scenario = "there is none";
  told.pictures().order({1, small_picture(1), edits, {}});
  const Json refused = told.wait(1, [](const Json& m) { return m["type"] == "refused"; });
  CHECK(refused["why"].get<std::string>().starts_with("no picture: "));
  CHECK(refused["why"].get<std::string>().find("there is none") != std::string::npos);
  told.pictures().order({1, small_picture(2), {}, {}});
  told.wait_done(1, 2);
}
