// One exposure for several pictures: clear air, smoke and the dark, or the frames of a film. The
// light of each is kept in a file until all are known; then all are exposed alike and written. With
// PictureWhite::adapted they share one white, too. One thread at a time.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "actors/results/pictures/view_files.hpp"
#include "actors/results/pictures/white_balance.hpp"
#include "runtime/core/file_descriptor.hpp"

namespace luxodus {

class SharedExposure {
 public:
  /// `folder`: where the light is kept, 12 bytes a pixel, in a file without a name: it goes when
  /// this object or the process ends.
  explicit SharedExposure(std::filesystem::path folder) : folder_(std::move(folder)) {}
  SharedExposure(const SharedExposure&) = delete;
  SharedExposure& operator=(const SharedExposure&) = delete;

  /// Keeps what `view` shows for a PNG file, in place of what was kept for it before.
  /// Errors: the light cannot be written.
  Result<void> keep(const std::filesystem::path& png, const LocalRun& run, const Camera& camera,
                    const ShownView& view);
  size_t pictures() const { return kept_.size(); }
  /// Writes the files of all pictures kept, in the exposure that it returns: middle grey is that of
  /// all their pixels, white and sign are the brightest of any. Errors: as write_png; light that
  /// cannot be read back. Requires: pictures() > 0.
  Result<Exposure> write(int threads);

 private:
  struct Kept {
    std::filesystem::path png;
    int width = 0, height = 0;
    uint64_t offset = 0;  // of its light in the file [bytes]
    double sign_cd_m2 = 0;
    WhiteBalance white;
    ToneStyle tone = ToneStyle::neutral;
    std::vector<ImageText> texts;
  };

  Result<void> open();
  /// As it looks in its white.
  Result<XyzPicture> light_of(const Kept& kept) const;
  /// Errors: the first of any picture.
  Result<void> for_each(int threads, const std::function<Result<void>(size_t picture)>& work) const;
  Problem failed(const std::string& what) const;

  std::filesystem::path folder_;
  FileDescriptor file_;
  uint64_t end_ = 0;
  std::vector<Kept> kept_;
};

}  // namespace luxodus
