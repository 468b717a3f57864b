#include "actors/apps/view/view_pictures.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <string_view>

#include "actors/apps/view/edits_text.hpp"
#include "actors/apps/view/give_way.hpp"
#include "actors/results/pictures/view_files.hpp"
#include "runtime/core/base64.hpp"
#include "runtime/core/output_text.hpp"

namespace luxodus {

namespace {

/// Factor on the time of a pass that leaves room for its filter, its file, and a machine that slows
/// down.
constexpr double pass_slack = 1.3;

/// Two orders of the same building have the same text.
std::string state_text(const SceneEdits& edits, const std::map<std::string, double>& factors) {
  std::string out = edits_text(edits);
  for (const auto& [group, factor] : factors)
    out += "\n" + std::to_string(group.size()) + ":" + group + "=" + shortest_number(factor);
  return out;
}

Camera camera_of(const RenderAsk& ask) {
  Camera camera;
  camera.name = "live view";
  camera.eye = ask.eye;
  camera.target = ask.target;
  camera.up = ask.up;
  camera.vertical_fov_deg = ask.vertical_fov_deg;
  camera.width = ask.width;
  camera.height = ask.height;
  return camera;
}

}  // namespace

/// A run of the building in a state, the radiance cache in which paths of its pictures end
/// (decision 34), and the data by which they choose emitters.
struct ViewPictures::Traced {
  std::string state;
  std::unique_ptr<LocalRun> run;
  std::unique_ptr<RadianceCache> flux;
  std::shared_ptr<const EmitterSight> sight;
};

/// Reports a picture to one viewer, from its order on.
class ViewPictures::PictureReporter {
 public:
  PictureReporter(const Order& order, const Tell& tell) : order_(order), tell_(tell) {}

  double seconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - began_).count();
  }

  /// The flux has this many particles so far.
  void tell_flux(int64_t particles) { say(particles, 0, unknown, false, {}); }
  /// Sends the next pass. Errors: as encode_png.
  Result<void> tell_picture(const PngImage& image, int64_t particles, int paths, double error,
                            bool done) {
    auto png = encode_png(image, {});
    if (!png) return png.problem();
    say(particles, paths, error, done,
        base64({reinterpret_cast<const char*>(png->data()), png->size()}));
    return {};
  }

  static constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

 private:
  void say(int64_t particles, int paths, double error, bool done, const std::string& png) {
    tell_(order_.viewer, {{"type", "picture"},
                          {"id", order_.ask.id},
                          {"particles", particles},
                          {"paths", paths},
                          {"relative_error", number_json(error)},
                          {"seconds", seconds()},
                          {"done", done},
                          {"png", png.empty() ? Json() : Json(png)}});
  }

  const Order& order_;
  const Tell& tell_;
  const std::chrono::steady_clock::time_point began_ = std::chrono::steady_clock::now();
};

ViewPictures::ViewPictures(const LiveOptions& options, SceneAt scene_at, Tell tell,
                           const ViewPictureLimits& limits)
    : options_(options),
      scene_at_(std::move(scene_at)),
      tell_(std::move(tell)),
      limits_(limits),
      thread_([this] { work(); }) {}

ViewPictures::~ViewPictures() {
  {
    const std::lock_guard lock(mutex_);
    ends_ = true;
    interrupt_ = true;
  }
  changed_.notify_all();
  thread_.join();
}

void ViewPictures::order(Order order) {
  cancel(order.viewer);
  {
    const std::lock_guard lock(mutex_);
    orders_.push_back(std::move(order));
  }
  changed_.notify_all();
}

void ViewPictures::cancel(uint64_t viewer) {
  const std::lock_guard lock(mutex_);
  std::erase_if(orders_, [&](const Order& order) { return order.viewer == viewer; });
  if (rendering_ == viewer) interrupt_ = true;
}

void ViewPictures::work() {
  give_way_to_answers();
  for (;;) {
    Order order;
    {
      std::unique_lock lock(mutex_);
      rendering_.reset();
      changed_.wait(lock, [&] { return ends_ || !orders_.empty(); });
      if (ends_) return;
      order = std::move(orders_.front());
      orders_.pop_front();
      rendering_ = order.viewer;
      interrupt_ = false;
    }
    const auto refuse = [&](const std::string& why) {
      tell_(order.viewer,
            {{"type", "refused"}, {"why", "no picture: " + why}, {"picture", order.ask.id}});
    };
    try {
      const auto rendered = render(order);
      if (!rendered) refuse(rendered.problem().text());
    } catch (const std::exception& e) {
      refuse(e.what());
    }
  }
}

Result<const ViewPictures::Traced*> ViewPictures::flux_for(const Order& order,
                                                           PictureReporter& reporter) {
  std::string state = state_text(order.edits, order.factors);
  if (traced_ && traced_->state == state) return traced_.get();
  traced_.reset();
  const auto scene = scene_at_(order.edits.at_s);
  if (!scene) return scene.problem();
  auto compiled = compile_dimmed(*scene.value(), order.edits, order.factors);
  if (!compiled) return compiled.problem();
  auto traced = std::make_unique<Traced>();
  traced->state = std::move(state);
  traced->run = std::make_unique<LocalRun>(compiled.value(), options_.seed, options_.threads);
  const StopRule stop{limits_.flux_particles, {}, limits_.flux_seconds};
  traced->run->run(stop, interrupt_,
                   [&](const Progress& progress) { reporter.tell_flux(progress.particles); });
  if (interrupt_) return nullptr;
  if (traced->run->batches() > 0) traced->flux = flux_radiance(*traced->run);
  traced->sight = make_emitter_sight(traced->run->scene());
  traced_ = std::move(traced);
  return traced_.get();
}

/// The end without a picture. Errors: it was not interrupted, but took too long.
Result<void> ViewPictures::unfinished() const {
  if (interrupt_) return {};
  return problem("it would take longer than " + std::to_string(std::lround(limits_.seconds)) +
                 " s: ask for fewer pixels");
}

Result<void> ViewPictures::render(const Order& order) {
  PictureReporter reporter(order, tell_);
  const auto traced = flux_for(order, reporter);
  if (!traced) return traced.problem();
  if (traced.value() == nullptr) return {};
  const LocalRun& run = *traced.value()->run;
  const bool human = order.ask.human;
  const Camera camera = camera_of(order.ask);
  PictureOptions options;
  options.interrupt = &interrupt_;
  options.white = PictureWhite::adapted;  // as the page
  options.gives_up = [&] { return reporter.seconds() > limits_.seconds; };
  ViewPasses passes(run, camera, 0, traced.value()->flux.get(), traced.value()->sight);
  if (!passes.add_first(min_pass, options)) return unfinished();
  const ShownView half(passes.first_picture(), min_pass, options, run.threads(), first_filter);
  if (auto ok = reporter.tell_picture(first_image(human, run, camera, half), run.particles(), 0,
                                      PictureReporter::unknown, false);
      !ok)
    return ok;
  for (bool done = false; !done;) {
    const double before_s = reporter.seconds();
    const int before = passes.paths();
    const bool whole = passes.add(next_pass(before) - before, options);
    if (!whole && (interrupt_ || passes.paths() == 0)) return unfinished();
    const ShownView shown(passes.picture(), passes.paths(), options, run.threads());
    const double pass_s = reporter.seconds() - before_s;
    const double next = next_pass(passes.paths()) - passes.paths();
    done = !whole || passes.paths() >= limits_.paths ||
           pass_slack * pass_s * next / (passes.paths() - before) >
               limits_.seconds - reporter.seconds();
    if (interrupt_) return {};
    if (auto ok = reporter.tell_picture(shown_image(human, run, camera, shown), run.particles(),
                                        passes.paths(), shown.error(), done);
        !ok)
      return ok;
  }
  return {};
}

}  // namespace luxodus
