#include "actors/results/pictures/preview.hpp"

#include <exception>

#include "runtime/core/log.hpp"

namespace luxodus {

void render_preview(const std::filesystem::path& folder, const LocalRun& run,
                    const PictureOptions& options) {
  try {
    const auto done = render_views(folder / "preview", run, "", options, {});
    if (!done) log_warning("preview: {}", done.problem().text());
  } catch (const std::exception& e) {
    log_warning("preview: {}", e.what());
  }
}

Preview::Preview(std::filesystem::path folder, LocalRun& run, double every_s,
                 std::atomic<bool>& requested, const PictureOptions& options)
    : folder_(std::move(folder)),
      run_(run),
      copy_(run.empty_copy()),
      every_(every_s),
      requested_(requested),
      options_(options) {
  run_.add_pause(
      this, [this] { return due(); }, [this] { take(); });
}

Preview::~Preview() {
  run_.remove_pause(this);
  if (thread_.joinable()) thread_.join();
}

bool Preview::due() const {
  if (rendering_) return false;
  return requested_ || (every_.count() > 0 && Clock::now() - last_ >= every_);
}

void Preview::take() {
  requested_ = false;
  last_ = Clock::now();
  if (run_.totals().balance().rays == 0) return;
  if (thread_.joinable()) thread_.join();
  int64_t batches = 0;
  for (int g = 0; g < run_.totals().groups(); ++g) {
    copy_->totals().restore(g, run_.totals().state(g));
    batches += run_.totals().batches(g);
  }
  copy_->resume(batches);
  rendering_ = true;
  ++taken_;
  thread_ = std::thread([this] {
    render_preview(folder_, *copy_, options_);
    rendering_ = false;
  });
}

}  // namespace luxodus
