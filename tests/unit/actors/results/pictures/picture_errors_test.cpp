// Whether a picture's errors are honest: pictures of independent runs spread as stated.
#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>

#include "actors/results/pictures/pictures.hpp"
#include "actors/results/pictures/pixel_sums.hpp"
#include "runtime/core/random.hpp"
#include "runtime/core/sobol.hpp"
#include "tests/unit/actors/results/files/display_fixture.hpp"

using namespace luxodus;
using namespace luxodus::test;

namespace {

/// A closed room in smoke under one lamp.
struct SmokeRoom {
  std::string extinction, reflectance;

  std::shared_ptr<const CompiledScene> compiled() const {
    return scene_of(R"(
patch_edge_m = 0.4
[run]
voxel_edge_m = 0.4
batch_particles = 32
[[material]]
name = "grey"
reflectance = )" + reflectance +
                    R"(
[[object]]
name = "room"
shape = "room"
low = [0, 0, 0]
high = [4, 4, 2.5]
material = "grey"
[[medium]]
name = "smoke"
kind = "homogeneous"
phase = "hg"
g = 0.5
albedo = 0.9
extinction = )" + extinction +
                    R"(
[[emitter]]
name = "lamp"
shape = "rectangle"
size = [0.6, 0.3]
position = [2, 2, 2.4]
flux_lm = 1000
[[camera]]
name = "view"
eye = [0.5, 2.2, 1.2]
target = [4, 2, 1.1]
width = 8
height = 6
)");
  }
};

/// Pictures that end in the flux of independent runs. `path_seed`: shared by the paths of all;
/// none: each has its own.
std::vector<TracedPicture> pictures_of(const SmokeRoom& smoky, int count, int64_t particles,
                                       int paths, std::optional<uint64_t> path_seed) {
  const auto scene = smoky.compiled();
  std::vector<TracedPicture> all;
  for (int k = 0; k < count; ++k) {
    LocalRun run(scene, 100 + static_cast<uint64_t>(k), 2);
    StopRule stop;
    stop.particles = particles;
    run.run(stop, std::atomic<bool>{false}, [](const Progress&) {});
    const auto flux = flux_radiance(run);
    const LocalRun eye(scene, path_seed.value_or(run.seed()), 2);
    PictureOptions options;
    options.paths_per_pixel = paths;
    all.push_back(trace_picture(eye, 0, options, flux.get()));
  }
  return all;
}

double luminance(const TracedPicture& picture, size_t pixel) {
  return static_cast<double>(picture.light.xyz[3 * pixel + 1]);
}

/// Shares of pixels within a number of standard errors of the mean of the other pictures.
struct Coverage {
  double one = 0, two = 0;
};

template <class ErrorOf>
Coverage coverage(const std::vector<TracedPicture>& all, ErrorOf&& error_of) {
  Coverage out;
  const auto n = static_cast<double>(all.size());
  const size_t pixels = all[0].light.pixels();
  const double share = 1 / (n * static_cast<double>(pixels));
  for (size_t i = 0; i < pixels; ++i) {
    double sum = 0;
    for (const TracedPicture& picture : all) sum += luminance(picture, i);
    for (const TracedPicture& picture : all) {
      const double others = (sum - luminance(picture, i)) / (n - 1);
      // The mean of the others has an error, too.
      const double error = error_of(picture, i) * std::sqrt(n / (n - 1));
      const double off = std::abs(luminance(picture, i) - others);
      if (off < error) out.one += share;
      if (off < 2 * error) out.two += share;
    }
  }
  return out;
}

}  // namespace

TEST_CASE(
    "the truth lies within one and two errors of a pixel as often as for a normal distribution",
    "[display]") {
  // Many paths that end in the flux of few particles: the largest error is common to all paths.
  const auto all = pictures_of({"0.1", "0.85"}, 24, 1 << 9, 2048, std::nullopt);
  const Coverage whole = coverage(all, [](const TracedPicture& picture, size_t i) {
    return static_cast<double>(picture.standard_error_y[i]);
  });
  const Coverage of_paths = coverage(all, [](const TracedPicture& picture, size_t i) {
    const auto error = static_cast<double>(picture.standard_error_y[i]);
    const auto of_flux = static_cast<double>(picture.flux_error_y[i]);
    return std::sqrt(std::max(0.0, error * error - of_flux * of_flux));
  });
  INFO("within one and two errors: " << whole.one << ", " << whole.two << "; of the paths' alone "
                                     << of_paths.one << ", " << of_paths.two);
  // 0.683 and 0.954. Errors of a picture's pixels are correlated: 24 runs determine a share to
  // about 0.04.
  CHECK(std::abs(whole.one - 0.683) < 0.10);
  CHECK(std::abs(whole.two - 0.954) < 0.05);
  CHECK(of_paths.one < 0.50);
  CHECK(of_paths.two < 0.80);
}

TEST_CASE("the error of a flux appears in pictures of the same paths as stated", "[display]") {
  const SmokeRoom room = GENERATE(SmokeRoom{"0.1", "0.85"}, SmokeRoom{"0.8", "0.5"});
  const int paths = 4096;
  const auto all = pictures_of(room, 24, 1 << 11, paths, 7);
  double seen = 0, said = 0;
  for (size_t i = 0; i < all[0].light.pixels(); ++i) {
    double mean = 0;
    for (const TracedPicture& picture : all) mean += luminance(picture, i) / 24;
    for (const TracedPicture& picture : all) {
      seen += std::pow(luminance(picture, i) - mean, 2) / 23;
      said += std::pow(static_cast<double>(picture.flux_error_y[i]), 2) / 24;
    }
  }
  INFO("error seen " << std::sqrt(seen) << ", said " << std::sqrt(said));
  // The part of each path alone is in the spread of the paths, and is still included here.
  CHECK(std::sqrt(seen / said) > 0.7);
  CHECK(std::sqrt(seen / said) < 1.4);
}

TEST_CASE("a picture that ends in the flux of one batch counts that as uncertain", "[display]") {
  const auto one = pictures_of({"0.1", "0.85"}, 1, 32, 256, 7);
  const auto many = pictures_of({"0.1", "0.85"}, 1, 1 << 14, 256, 7);
  double of_one = 0, of_many = 0;
  for (size_t i = 0; i < one[0].light.pixels(); ++i) {
    REQUIRE(std::isfinite(one[0].standard_error_y[i]));
    of_one += static_cast<double>(one[0].flux_error_y[i]);
    of_many += static_cast<double>(many[0].flux_error_y[i]);
  }
  CHECK(of_many > 0);
  CHECK(of_one > 4 * of_many);
}

TEST_CASE("the common end of two parts of a path belongs to that path alone", "[display]") {
  const ChannelLight light{1, 1, 1, 1};
  const auto variance_of = [&](uint64_t first_bin, uint64_t second_bin) {
    PixelSums sums;
    const std::array<CachedEnd, 2> ends{CachedEnd{{first_bin, 0.5}, 3},
                                        CachedEnd{{second_bin, 0.1}, 5}};
    sums.add(0, light, light, ends, {});
    CHECK(sums.known() == Approx(8));
    return sums.known_variance();
  };
  // In one bin both have the same error, together 2.
  CHECK(variance_of(7, 7) == Approx(0).margin(1e-6));
  // In two bins they have not: twice their product, with the signs of few draws.
  double mean = 0;
  constexpr int pairs = 2000;
  for (uint64_t i = 0; i < pairs; ++i) mean += variance_of(2 * i, 2 * i + 1) / pairs;
  const double of_one = 2 * 1.5 * 0.5 / std::sqrt(static_cast<double>(sign_draws));
  CHECK(std::abs(mean) < 4 * of_one / std::sqrt(static_cast<double>(pairs)));
}

TEST_CASE("both halves of a pixel's paths cover all of the pixel", "[display]") {
  SobolSet set(1, RandomStream::picture);
  for (const uint32_t paths : {16u, 32u, 64u}) {
    for (uint64_t pixel = 0; pixel < 20; ++pixel) {
      set.choose(pixel, paths);
      std::array<std::array<int, 4>, 2> in_quarter{};  // by half
      for (uint32_t path = 0; path < paths; ++path) {
        SobolSet::Point point;
        set.point(path, point);
        const uint32_t quarter = 2 * (point[0] >> 31) + (point[1] >> 31);
        ++in_quarter[half_of(static_cast<int>(path))][quarter];
      }
      for (const auto& counts : in_quarter)
        for (const int count : counts) CHECK(count == static_cast<int>(paths) / 8);
    }
  }
}

TEST_CASE("each half has two of every four paths of a pixel", "[display]") {
  for (int first = 0; first < 128; first += 4) {
    int second_half = 0;
    for (int path = first; path < first + 4; ++path) second_half += static_cast<int>(half_of(path));
    CHECK(second_half == 2);
  }
}
