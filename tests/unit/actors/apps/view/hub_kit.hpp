// Viewers that record messages, and a hub on the test's thread.
#pragma once

#include <catch2/catch.hpp>
#include <condition_variable>
#include <cstring>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "actors/apps/view/view_hub.hpp"
#include "tests/kit/temporary_folder.hpp"
#include "tests/unit/actors/apps/view/live_room.hpp"

namespace luxodus::test {

inline std::shared_ptr<const SceneDescription> scene_in(const TemporaryFolder& folder) {
  return described(folder.write("room.toml", two_lamps));
}

struct Remembers final : Viewer {
  std::vector<Json> texts;
  std::vector<LiveFrame> frames;
  void send_text(const LiveFrame& text) override { texts.push_back(Json::parse(*text)); }
  void send_binary(const LiveFrame& frame, bool) override { frames.push_back(frame); }
  std::vector<LiveFrame> take_light() override { return std::exchange(waiting, {}); }
  std::vector<LiveFrame> waiting;  // light that a slow connection has not sent yet

  const Json* last(const std::string& type) const {
    for (auto at = texts.rbegin(); at != texts.rend(); ++at)
      if ((*at)["type"] == type) return &*at;
    return nullptr;
  }
  size_t frames_of(uint32_t kind, uint32_t generation) const {
    size_t count = 0;
    for (const LiveFrame& frame : frames) {
      uint32_t head[2];
      std::memcpy(head, frame->data(), sizeof head);
      if (head[0] == kind && head[1] == generation) ++count;
    }
    return count;
  }
};

/// The server's thread, run by hand: posted functions run on request.
class Posts {
 public:
  ViewHub::Post post() {
    return [this](std::function<void()> function) {
      const std::lock_guard lock(mutex_);
      waiting_.push_back(std::move(function));
      came_.notify_all();
    };
  }
  /// Runs posts until `holds`. The hub reports at every doubling, so that happens.
  template <class Holds>
  void until(Holds&& holds) {
    while (!holds()) {
      std::unique_lock lock(mutex_);
      came_.wait(lock, [&] { return !waiting_.empty(); });
      const auto next = std::move(waiting_.front());
      waiting_.pop_front();
      lock.unlock();
      next();
    }
  }

 private:
  std::mutex mutex_;
  std::condition_variable came_;
  std::deque<std::function<void()>> waiting_;
};

inline HubOptions small_runs(const TemporaryFolder& folder) {
  HubOptions options;
  options.live.particles = 1 << 16;
  options.save_folder = folder / "";
  return options;
}

/// A hub with one editing viewer, after its first messages.
class Edited {
 public:
  explicit Edited(std::shared_ptr<const SceneDescription> scene = nullptr,
                  std::shared_ptr<FrameScenes> judged = nullptr)
      : hub(scene ? scene : scene_in(folder), runs(judged), posts.post()) {
    hub.joins(viewer);
    until_done();
  }
  ~Edited() { hub.leaves(viewer); }
  void says(const std::string& text) {
    viewer.texts.clear();
    hub.says(viewer, text);
  }
  /// Until the building with the present edits is traced.
  void until_done() {
    posts.until([&] {
      const Json* progress = viewer.last("progress");
      return progress != nullptr && (*progress)["done"] == true;
    });
  }
  const Json& scene() const { return *viewer.last("scene"); }
  /// A group by its name.
  const Json& group(const std::string& name) const { return named(scene()["groups"], name); }
  static const Json& named(const Json& list, const std::string& name) {
    const auto at = std::find_if(list.begin(), list.end(),
                                 [&](const Json& one) { return one["name"] == name; });
    REQUIRE(at != list.end());
    return *at;
  }
  /// All messages of the hub since the last request.
  std::string answers() const {
    std::string out;
    for (const Json& text : viewer.texts) out += text.dump() + "\n";
    return out;
  }
  std::string why() const { return (*viewer.last("refused"))["why"].get<std::string>(); }
  /// The answer to a click on a sign.
  Json verdicts_on(const std::string& name) {
    says(Json({{"type", "judge"}, {"sign", name}}).dump());
    const auto sure = [&]() -> const Json* {
      const Json* const last = viewer.last("sign");
      return last != nullptr && (*last)["name"] == name && !(*last)["provisional"] ? last : nullptr;
    };
    posts.until([&] { return sure() != nullptr || viewer.last("refused") != nullptr; });
    INFO(answers());
    REQUIRE(sure() != nullptr);
    return *sure();
  }

  HubOptions runs(const std::shared_ptr<FrameScenes>& judged) const {
    HubOptions options = small_runs(folder);
    options.live.judged = judged;
    return options;
  }
  const TemporaryFolder folder;
  Posts posts;
  Remembers viewer;
  ViewHub hub;
};

}  // namespace luxodus::test
