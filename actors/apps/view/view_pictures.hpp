// Traced pictures of what viewers look at: of one viewer at a time, on a thread of its own, told
// pass by pass while they grow. The building is as it stood when the picture was asked for. Its
// flux is traced first, and kept for the next picture of the same building. Thread rule: any thread
// may order and cancel.
#pragma once

#include <atomic>
#include <condition_variable>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <thread>

#include "actors/apps/view/live_trace.hpp"
#include "actors/apps/view/page_message.hpp"
#include "actors/results/formats/json_out.hpp"

namespace luxodus {

/// What a picture may take.
struct ViewPictureLimits {
  double seconds = 300;      // with the flux that it ends in
  double flux_seconds = 15;  // of these, for the flux
  int64_t flux_particles = 4'000'000;
  int paths = 256;  // of each pixel, where there is time for them
};

class ViewPictures {
 public:
  struct Order {
    uint64_t viewer = 0;
    RenderAsk ask;
    SceneEdits edits;
    std::map<std::string, double> factors;  // of source groups; others 1
  };
  using SceneAt =
      std::function<Result<std::shared_ptr<const SceneDescription>>(std::optional<double> at_s)>;
  /// Messages of type "picture", or "refused" with the reason. Called on the pictures' thread.
  using Tell = std::function<void(uint64_t viewer, const Json& message)>;

  ViewPictures(const LiveOptions& options, SceneAt scene_at, Tell tell,
               const ViewPictureLimits& limits = {});
  ~ViewPictures();
  ViewPictures(const ViewPictures&) = delete;
  ViewPictures& operator=(const ViewPictures&) = delete;

  /// In place of the picture that this viewer has ordered before.
  void order(Order order);
  /// Whatever this viewer has ordered is not told any more, but for what is on its way.
  void cancel(uint64_t viewer);

 private:
  struct Traced;
  class Growing;
  void work();
  Result<void> render(const Order& order);
  Result<void> unfinished() const;
  /// The flux of the building as it is ordered, kept or traced. Null: it was interrupted.
  Result<const Traced*> flux_for(const Order& order, Growing& growing);

  const LiveOptions options_;
  const SceneAt scene_at_;
  const Tell tell_;
  const ViewPictureLimits limits_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<Order> orders_;           // that wait, of each viewer one
  std::optional<uint64_t> rendering_;  // the viewer whose picture grows
  bool ends_ = false;
  std::atomic<bool> interrupt_{false};
  std::unique_ptr<Traced> traced_;  // of the pictures' thread
  std::thread thread_;              // the last: it begins when all else is there
};

}  // namespace luxodus
