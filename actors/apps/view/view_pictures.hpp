// Traces pictures of viewers' views: for one viewer at a time, on a thread of its own, sent pass by
// pass. The building is in its state at the time of the order. Its flux is traced first, and cached
// for the next picture of the same building. Thread rule: any thread may order and cancel.
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

/// Limits on a picture.
struct ViewPictureLimits {
  double seconds = 300;      // including its flux
  double flux_seconds = 15;  // part of it for the flux
  int64_t flux_particles = 4'000'000;
  int paths = 256;  // for each pixel, if time allows
};

class ViewPictures {
 public:
  struct Order {
    uint64_t viewer = 0;
    RenderAsk ask;
    SceneEdits edits;
    std::map<std::string, double> factors;  // of source groups; others are 1
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

  /// Replaces this viewer's previous order.
  void order(Order order);
  /// Stops reports on this viewer's order, except those already on their way.
  void cancel(uint64_t viewer);

 private:
  struct Traced;
  class PictureReporter;
  void work();
  Result<void> render(const Order& order);
  Result<void> unfinished() const;
  /// The flux of the ordered building, cached or traced. Null: it was interrupted.
  Result<const Traced*> flux_for(const Order& order, PictureReporter& reporter);

  const LiveOptions options_;
  const SceneAt scene_at_;
  const Tell tell_;
  const ViewPictureLimits limits_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<Order> orders_;           // pending, one for each viewer
  std::optional<uint64_t> rendering_;  // the viewer whose picture is being traced
  bool ends_ = false;
  std::atomic<bool> interrupt_{false};
  std::unique_ptr<Traced> traced_;  // used by the pictures' thread
  std::thread thread_;              // declared last: it starts when all other members exist
};

}  // namespace luxodus
