#include "actors/results/pictures/shared_exposure.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <mutex>
#include <utility>

#include "actors/results/run/parallel_for.hpp"
#include "scenes/light/vision/tone.hpp"

namespace luxodus {

namespace {

/// pread or pwrite of all bytes. False: errno says why.
template <class Call, class Byte>
bool transfer(const Call& call, int file, Byte* bytes, uint64_t count, uint64_t offset) {
  for (uint64_t done = 0; done < count;) {
    const ssize_t n = call(file, bytes + done, count - done, static_cast<off_t>(offset + done));
    if (n == 0) errno = EIO;
    if (n == 0 || (n < 0 && errno != EINTR)) return false;
    if (n > 0) done += static_cast<uint64_t>(n);
  }
  return true;
}

uint64_t bytes_of(const XyzPicture& light) {
  return light.xyz.size() * sizeof(float);
}

}  // namespace

Problem SharedExposure::failed(const std::string& what) const {
  return system_problem(folder_, what, errno);
}

Result<void> SharedExposure::open() {
  const std::filesystem::path path = folder_ / ".light-of-pictures";
  file_ = FileDescriptor(::open(path.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0600));
  if (!file_.valid()) return failed("cannot keep the light of pictures in this folder");
  ::unlink(path.c_str());
  return {};
}

Result<void> SharedExposure::keep(const std::filesystem::path& png, const LocalRun& run,
                                  const Camera& camera, const ShownView& view) {
  if (!file_.valid())
    if (auto ok = open(); !ok) return ok;
  const XyzPicture& light = view.shown();
  auto kept = std::find_if(kept_.begin(), kept_.end(), [&](const Kept& k) { return k.png == png; });
  if (kept == kept_.end()) {
    kept = kept_.emplace(kept_.end());
    kept->png = png;
    kept->offset = end_;
    end_ += bytes_of(light);
  }
  kept->width = light.width;
  kept->height = light.height;
  kept->sign_cd_m2 = brightest_sign_or_flame(run, camera, view);
  kept->white = white_balance_of(run, view);
  kept->tone = view.tone;
  kept->texts = texts_of(run, camera, view);
  if (!transfer(::pwrite, file_.number(), reinterpret_cast<const char*>(light.xyz.data()),
                bytes_of(light), kept->offset))
    return failed("cannot keep the light of pictures in this folder");
  return {};
}

Result<XyzPicture> SharedExposure::light_of(const Kept& kept) const {
  XyzPicture light{kept.width, kept.height, {}, {}};
  light.xyz.resize(3 * light.pixels());
  if (!transfer(::pread, file_.number(), reinterpret_cast<char*>(light.xyz.data()), bytes_of(light),
                kept.offset))
    return failed("cannot read the light of pictures back");
  return kept.white.balanced(std::move(light));
}

Result<void> SharedExposure::for_each(
    int threads, const std::function<Result<void>(size_t picture)>& work) const {
  std::mutex mutex;
  Result<void> outcome;
  const auto one = [&](int64_t picture) {
    auto done = work(static_cast<size_t>(picture));
    const std::lock_guard lock(mutex);
    if (!done && outcome) outcome = std::move(done);
  };
  parallel_for(static_cast<int64_t>(kept_.size()), threads, [&] { return one; });
  return outcome;
}

Result<Exposure> SharedExposure::write(int threads) {
  std::vector<std::optional<Xyz>> lights;
  for (const Kept& kept : kept_) lights.push_back(kept.white.surfaces);
  const std::optional<Xyz> white = mean_light(lights);
  for (Kept& kept : kept_) kept.white.surfaces = white;
  std::vector<LightMeter> meters(kept_.size());
  auto read = for_each(threads, [&](size_t i) -> Result<void> {
    const auto light = light_of(kept_[i]);
    if (!light) return light.problem();
    meters[i] = metered(light.value(), kept_[i].sign_cd_m2);
    return {};
  });
  if (!read) return read.problem();
  LightMeter all;
  for (const LightMeter& meter : meters) all.add(meter);
  const Exposure exposure = all.exposure();
  auto written = for_each(threads, [&](size_t i) -> Result<void> {
    const Kept& kept = kept_[i];
    auto light = light_of(kept);
    if (!light) return light.problem();
    std::vector<ImageText> texts = kept.texts;
    texts.emplace_back("Exposed together", fmt::format("{} pictures", kept_.size()));
    return write_png(kept.png,
                     plain_png(light.value(), exposure, kept.tone, kept.white, std::move(texts)));
  });
  if (!written) return written.problem();
  return exposure;
}

}  // namespace luxodus
