// The light that paths of pictures end in.
#include "actors/results/pictures/flux_radiance.hpp"

#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <numbers>
#include <numeric>

#include "scenes/light/geometry/patches.hpp"
#include "scenes/light/transport/packed_scene.hpp"
#include "scenes/light/transport/readout.hpp"
#include "tests/unit/actors/results/files/display_fixture.hpp"

using namespace luxodus;
using namespace luxodus::test;

namespace {

/// A hollow sphere of small patches around a lamp: all of them have the same colour.
const std::string ochre_sphere = R"([run]
max_bands = 4
[[material]]
name = "ochre"
reflectance = [[400, 0.2], [550, 0.4], [700, 0.8]]
[[object]]
name = "sphere"
shape = "sphere"
radius = 2
patch_edge_m = 0.1
mesh_tolerance_m = 0.01
material = "ochre"
[[emitter]]
name = "lamp"
shape = "point"
distribution = "isotropic"
position = [0, 0, 0]
flux_lm = 1000
)";

constexpr size_t bands = 4;
using ByBand = std::array<double, bands>;

/// Luminance by band of the patch that lies under a place of a triangle [cd/m2].
ByBand luminances(const LocalRun& run, const RadianceCache& flux, const Hit& hit, bool front) {
  ByBand out{};
  for (size_t b = 0; b < bands; ++b)
    out[b] = flux.of_surface(hit, front, static_cast<int>(b)) *
             run.scene().bands[static_cast<int>(b)].lm_per_w;
  return out;
}

/// The same of all bands together, from what was counted.
double counted_luminance(const LocalRun& run, const Hit& hit, bool front) {
  const TriangleRecord& t = *hit.triangle;
  const uint32_t n = t.subdivision;
  const uint32_t patch = t.first_patch + (front ? 0 : n * n) + sub_triangle(hit.u, hit.v, n);
  const CompiledScene& scene = run.scene();
  return Readout(scene, run.totals()).lumens(scene.blocks.patches, patch, 1).value /
         (std::numbers::pi * scene.surfaces[t.surface].patch_area_m2(t));
}

}  // namespace

TEST_CASE("a patch with few counts has the colour of its surface, at its own luminance",
          "[display]") {
  const auto run = traced(ochre_sphere, 1 << 12);
  const auto flux = flux_radiance(*run);
  std::vector<ByBand> shares;
  const auto look = [&](const TriangleRecord& t, bool front) {
    Hit hit;
    hit.triangle = &t;
    hit.u = hit.v = 0.3f;
    ByBand lit = luminances(*run, *flux, hit, front);
    const double all = std::accumulate(lit.begin(), lit.end(), 0.0);
    CHECK(all == Approx(counted_luminance(*run, hit, front)).epsilon(1e-4));
    if (!(all > 0)) return;
    for (double& band : lit) band /= all;
    shares.push_back(lit);
  };
  REQUIRE(for_each_cell(run->scene(), [&](const GeometryCell& cell) {
            for (const TriangleRecord& t : cell.triangles)
              for (const bool front : {false, true}) look(t, front);
          }).ok());
  REQUIRE(shares.size() > 1000);
  // Some particles per patch: each patch would have the colour of one or two bands, and a band's
  // share would be off by up to 0.7.
  for (size_t b = 0; b < bands; ++b) {
    const auto [least, most] =
        std::minmax_element(shares.begin(), shares.end(),
                            [b](const ByBand& x, const ByBand& y) { return x[b] < y[b]; });
    CHECK((*most)[b] - (*least)[b] < 0.08);
  }
}
