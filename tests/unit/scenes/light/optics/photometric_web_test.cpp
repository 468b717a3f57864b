// The web compared with closed forms: flux, interpolation, and the sampler with its stated density.
#include "scenes/light/optics/photometric_web.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <functional>
#include <numbers>
#include <random>

using namespace luxodus;

namespace {

using std::numbers::pi;
const glm::dmat3 upright(1.0);
const glm::dmat3 hanging(glm::dvec3(1, 0, 0), glm::dvec3(0, 1, 0), glm::dvec3(0, 0, -1));

std::vector<double> steps(double first, double last, double step) {
  std::vector<double> out;
  for (int i = 0; i <= int(std::lround((last - first) / step)); ++i)
    out.push_back(first + i * step);
  return out;
}

using Intensity = std::function<double(double azimuth_deg, double polar_deg)>;

PhotometricWeb web_of(std::vector<double> azimuth, std::vector<double> polar, const Intensity& f,
                      const glm::dmat3& axes = upright) {
  std::vector<double> candela;
  for (double a : azimuth) {
    for (double p : polar) candela.push_back(f(std::fmod(a, 360), p));
  }
  auto web = PhotometricWeb::make(azimuth, polar, candela, axes);
  REQUIRE(web.ok());
  return std::move(web).value();
}

/// Irregular in both angles, with a dark sector and a dark cap.
PhotometricWeb lopsided(const glm::dmat3& axes = upright) {
  return web_of(
      {0, 10, 35, 90, 180, 200, 300, 360}, {0, 5, 30, 60, 61, 90, 130, 180},
      [](double a, double p) {
        if (p >= 90 || (a >= 90 && a <= 180)) return 0.0;
        return 10 + a / 20 + 100 * std::exp(-std::pow((p - 50) / 15, 2));
      },
      axes);
}

std::string refusal(std::vector<double> azimuth, std::vector<double> polar,
                    std::vector<double> candela, const glm::dmat3& axes = upright) {
  auto web = PhotometricWeb::make(azimuth, polar, candela, axes);
  return web.ok() ? "" : web.problem().what;
}

}  // namespace

TEST_CASE("the flux of a constant web is 4 pi times its intensity for any angles of the table",
          "[optics][web]") {
  const auto even = [](double, double) { return 7.0; };
  CHECK(web_of({0, 360}, {0, 180}, even).flux_lm() == Approx(4 * pi * 7).epsilon(1e-14));
  CHECK(web_of({0, 1, 50, 360}, {0, 0.001, 3, 90, 180}, even).flux_lm() ==
        Approx(4 * pi * 7).epsilon(1e-14));
}

TEST_CASE("the flux of a cosine web tends to pi times its peak as the steps shrink",
          "[optics][web]") {
  const auto cosine = [](double, double p) { return std::max(0.0, std::cos(p * pi / 180)); };
  // Linear interpolation is below the concave cosine by a share of h^2 / 12, to leading order.
  const double h = 2.5 * pi / 180;
  const double flux = web_of({0, 360}, steps(0, 180, 2.5), cosine).flux_lm();
  CHECK(flux == Approx(pi).epsilon(1e-3));
  CHECK(flux == Approx(pi * (1 - h * h / 12)).epsilon(1e-5));
}

TEST_CASE("the flux of a single ramp over the sphere is its closed form", "[optics][web]") {
  // I = theta / pi: integral 2 pi / pi * (sin - theta cos) from 0 to pi = 2 pi.
  CHECK(web_of({0, 360}, {0, 180}, [](double, double p) { return p / 180; }).flux_lm() ==
        Approx(2 * pi).epsilon(1e-14));
}

TEST_CASE("intensity equals the table at its angles and is bilinear between them",
          "[optics][web]") {
  const PhotometricWeb web = lopsided();
  const auto toward = [](double azimuth, double polar) {
    const double a = azimuth * pi / 180;
    const double p = polar * pi / 180;
    return glm::dvec3(std::sin(p) * std::cos(a), std::sin(p) * std::sin(a), std::cos(p));
  };
  const auto at = [&](size_t a, size_t p) { return web.candela()[a * web.polar_deg().size() + p]; };
  CHECK(web.intensity(toward(35, 30)) == Approx(at(2, 2)));
  CHECK(web.intensity(toward(300, 60)) == Approx(at(6, 3)));
  CHECK(web.intensity(toward(62.5, 45)) ==
        Approx(0.25 * (at(2, 2) + at(3, 2) + at(2, 3) + at(3, 3))));
  CHECK(web.intensity(toward(-30, 60)) == Approx(0.5 * (at(6, 3) + at(7, 3))));
  CHECK(web.intensity({0, 0, -1}) == 0);
  CHECK(web.peak_cd() == *std::max_element(web.candela().begin(), web.candela().end()));
}

TEST_CASE("the table's frame maps it into the luminaire's", "[optics][web]") {
  const PhotometricWeb web = web_of(
      steps(0, 360, 90), {0, 90, 180},
      [](double a, double p) { return p == 90 ? (a == 90 ? 5.0 : 1.0) : (p == 0 ? 3.0 : 0.0); },
      hanging);
  CHECK(web.intensity({0, 0, -1}) == Approx(3));
  CHECK(web.intensity({0, 1, 0}) == Approx(5));
  CHECK(web.intensity({0, -1, 0}) == Approx(1));
  CHECK(web.intensity({0, 0, 1}) == Approx(0).margin(1e-12));
}

TEST_CASE("a sample's density is the intensity over the flux, and its direction is unit",
          "[optics][web]") {
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> uniform(0, 1);
  for (const glm::dmat3& axes : {upright, hanging}) {
    const PhotometricWeb web = lopsided(axes);
    double worst = 0;
    double longest = 0;
    for (int i = 0; i < 20000; ++i) {
      const auto sample = web.sample(uniform(random), uniform(random));
      REQUIRE(sample.pdf > 0);
      // The 60-61 degree cell is 1 degree wide: a rounding error of 1e-14 degrees changes the
      // density by 1e-12.
      worst = std::max(worst, std::abs(web.pdf(sample.direction) / sample.pdf - 1));
      longest = std::max(longest, std::abs(glm::length(sample.direction) - 1));
    }
    CHECK(worst < 1e-9);
    CHECK(longest < 1e-14);
  }
}

TEST_CASE("the corners of the unit square give finite directions in lit cells", "[optics][web]") {
  const PhotometricWeb web = lopsided();
  for (double u : {0.0, 1e-300, 0.5, 1 - 0x1p-53}) {
    for (double v : {0.0, 1e-300, 0.5, 1 - 0x1p-53}) {
      const auto sample = web.sample(u, v);
      CHECK(std::isfinite(sample.pdf));
      CHECK(sample.pdf > 0);
      CHECK(glm::length(sample.direction) == Approx(1).epsilon(1e-14));
    }
  }
}

TEST_CASE("samples fill the table's cells, and halves of them, in proportion to flux",
          "[optics][web]") {
  const PhotometricWeb web = lopsided();
  const auto& azimuth = web.azimuth_deg();
  const auto& polar = web.polar_deg();
  // Every cell is split in four; expected counts by a fine midpoint rule over each quarter.
  const size_t columns = 2 * (azimuth.size() - 1);
  const size_t rows = 2 * (polar.size() - 1);
  const auto edge = [](const std::vector<double>& list, size_t half) {
    return half % 2 == 0 ? list[half / 2] : 0.5 * (list[half / 2] + list[half / 2 + 1]);
  };
  constexpr int fine = 60;
  std::vector<double> share(columns * rows, 0.0);
  for (size_t c = 0; c < columns; ++c) {
    for (size_t r = 0; r < rows; ++r) {
      const double da = (edge(azimuth, c + 1) - edge(azimuth, c)) / fine * pi / 180;
      const double dp = (edge(polar, r + 1) - edge(polar, r)) / fine * pi / 180;
      for (int i = 0; i < fine * fine; ++i) {
        const double a = edge(azimuth, c) * pi / 180 + (i % fine + 0.5) * da;
        const double p = edge(polar, r) * pi / 180 + (i / fine + 0.5) * dp;
        share[c * rows + r] +=
            da * dp * std::sin(p) *
            web.pdf({std::sin(p) * std::cos(a), std::sin(p) * std::sin(a), std::cos(p)});
      }
    }
  }
  constexpr int samples = 400000;
  std::vector<int> count(columns * rows, 0);
  std::mt19937_64 random(12);
  std::uniform_real_distribution<double> uniform(0, 1);
  const auto half_of = [&](const std::vector<double>& list, double angle) {
    size_t half = 0;
    while (edge(list, half + 1) < angle) ++half;
    return half;
  };
  for (int i = 0; i < samples; ++i) {
    const glm::dvec3 d = web.sample(uniform(random), uniform(random)).direction;
    double a = std::atan2(d.y, d.x) * 180 / pi;
    if (a < 0) a += 360;
    const double p = std::acos(std::clamp(d.z, -1.0, 1.0)) * 180 / pi;
    ++count[half_of(azimuth, a) * rows + half_of(polar, p)];
  }
  double chi_square = 0;
  double freedom = -1;
  for (size_t i = 0; i < share.size(); ++i) {
    const double expected = share[i] * samples;
    if (share[i] == 0) CHECK(count[i] == 0);
    if (expected < 5) continue;
    chi_square += (count[i] - expected) * (count[i] - expected) / expected;
    freedom += 1;
  }
  INFO("chi-square " << chi_square << " of " << freedom);
  REQUIRE(freedom > 60);
  // Mean `freedom`, variance twice that; four standard errors.
  CHECK(std::abs(chi_square - freedom) < 4 * std::sqrt(2 * freedom));
}

TEST_CASE("the mean direction of samples is the flux-weighted mean direction", "[optics][web]") {
  // Cosine lobe about the pole: the mean of cos is 2/3, its variance 1/2 - 4/9.
  const PhotometricWeb web = web_of(
      {0, 360}, steps(0, 180, 1),
      [](double, double p) { return std::max(0.0, std::cos(p * pi / 180)); }, hanging);
  constexpr int samples = 200000;
  std::mt19937_64 random(13);
  std::uniform_real_distribution<double> uniform(0, 1);
  glm::dvec3 mean(0);
  for (int i = 0; i < samples; ++i) mean += web.sample(uniform(random), uniform(random)).direction;
  mean /= double(samples);
  const double sigma = std::sqrt((0.5 - 4.0 / 9) / samples);
  // The 1 degree steps move the mean by less than 1e-4, a fifth of a standard error.
  CHECK(std::abs(mean.z + 2.0 / 3) < 4 * sigma);
  const double sideways = std::sqrt(0.25 / samples);  // mean of x^2 is 1/4
  CHECK(std::abs(mean.x) < 4 * sideways);
  CHECK(std::abs(mean.y) < 4 * sideways);
}

TEST_CASE("the sampler inverts the polar density of a single ramp exactly", "[optics][web]") {
  // One cell from pole to pole with I = theta / pi: F = (sin t - t cos t) / pi, the hardest
  // inverse.
  const PhotometricWeb web = web_of({0, 360}, {0, 180}, [](double, double p) { return p / 180; });
  for (double v : {1e-9, 1e-6, 0.01, 0.3, 0.5, 0.9, 0.999, 1 - 1e-9}) {
    const glm::dvec3 d = web.sample(0.25, v).direction;
    const double t = std::atan2(std::hypot(d.x, d.y), d.z);
    CHECK((std::sin(t) - t * std::cos(t)) / pi == Approx(v).epsilon(1e-9));
  }
}

TEST_CASE("invalid tables are refused with the reason", "[optics][web]") {
  CHECK(refusal({0, 360}, {0, 180}, {1, 1, 1, 1}).empty());
  CHECK(refusal({0, 350}, {0, 180}, {1, 1, 1, 1}).find("0 to 360") != std::string::npos);
  CHECK(refusal({0, 360}, {0, 90}, {1, 1, 1, 1}).find("0 to 180") != std::string::npos);
  CHECK(refusal({0, 90, 90, 360}, {0, 180}, std::vector<double>(8, 1)).find("ascend") !=
        std::string::npos);
  CHECK(refusal({0}, {0, 180}, {1, 1}).find("2 to") != std::string::npos);
  CHECK(refusal({0, 360}, {0, 180}, {1, 1, 1}).find("as many") != std::string::npos);
  CHECK(refusal({0, 360}, {0, 180}, {1, -1, 1, -1}).find("negative") != std::string::npos);
  CHECK(refusal({0, 360}, {0, 180}, {1, std::nan(""), 1, 1}).find("not a number") !=
        std::string::npos);
  CHECK(refusal({0, 360}, {0, 180}, {0, 0, 0, 0}).find("no light") != std::string::npos);
  CHECK(refusal({0, 360}, {0, 180}, {1, 1, 2, 1}).find("repeat") != std::string::npos);
  CHECK(refusal({0, 360}, {0, 180}, {1, 1, 1, 1}, glm::dmat3(2.0)).find("orthonormal") !=
        std::string::npos);
}
