// Nanoseconds per free flight and per optical depth, by kind of media.
#include <chrono>
#include <cstdio>

#include "tests/bench/tables.hpp"
#include "tests/unit/scenes/light/optics/media_test_tools.hpp"

namespace luxodus::bench {
namespace {

using namespace media_test;

struct Ray {
  glm::vec3 o;
  glm::vec3 d;
  double tau;
  float choice;
};

template <MediaNeed N>
void time_it(const char* name, const std::vector<Medium>& media, float t_max = 5) {
  const MediaSet set = try_compile(media, glm::dvec3(0)).value();
  ResidentBricks bricks(set);
  Draws draw(51);
  std::vector<Ray> rays;
  for (int i = 0; i < 4096; ++i) {
    const glm::vec3 o(draw.point({0, 0, 0}, {6, 6, 3}));
    const glm::vec3 d(draw.direction());
    const double tau = -std::log1p(-draw());
    rays.push_back({o, d, tau, static_cast<float>(draw())});
  }
  double sum = 0;
  double best = 1e9;
  double best_depth = 1e9;
  for (int round = 0; round < 100; ++round) {
    auto start = std::chrono::steady_clock::now();
    for (const Ray& r : rays) {
      sum += static_cast<double>(
          free_flight<N>(set, 0, r.o, r.d, t_max, r.tau, static_cast<double>(r.choice), bricks).t);
    }
    auto end = std::chrono::steady_clock::now();
    best = std::min(best, std::chrono::duration<double>(end - start).count());
    start = std::chrono::steady_clock::now();
    for (const Ray& r : rays) sum += optical_depth<N>(set, 0, r.o, r.d, t_max, bricks);
    end = std::chrono::steady_clock::now();
    best_depth = std::min(best_depth, std::chrono::duration<double>(end - start).count());
  }
  std::printf("%-36s flight %7.1f ns   depth %7.1f ns   (%g)\n", name,
              best * 1e9 / static_cast<double>(rays.size()),
              best_depth * 1e9 / static_cast<double>(rays.size()), sum);
}

Medium stack_of(int n) {
  std::vector<Layer> list;
  for (int i = 0; i < n; ++i)
    list.push_back({3.0 * i / n, 3.0 * (i + 1) / n, smoke(0.1 * i * 6 / n)});
  return layers(list);
}

}  // namespace

void print_flights() {
  time_it<MediaNeed::homogeneous>("homogeneous", {everywhere(smoke(0.3))});
  for (const int n : {2, 6, 16, 17, 24, 100}) {
    const std::string name = std::to_string(n) + " layers";
    time_it<MediaNeed::layered>(name.c_str(), {stack_of(n)});
  }
  time_it<MediaNeed::general>("6 layers, general kernel", {stack_of(6)});
  Frame frame;
  frame.origin = {3, 3, 1};
  time_it<MediaNeed::general>("one ellipsoid", {body(ellipsoid({1, 1, 1}), smoke(1), frame)});
  time_it<MediaNeed::general>("6 layers and ellipsoid",
                              {stack_of(6), body(ellipsoid({1, 1, 1}), smoke(1), frame)});
  Medium room = stack_of(6);
  room.footprint.polygon = {{0, 0}, {6, 0}, {6, 3}, {3, 3}, {3, 6}, {0, 6}};
  time_it<MediaNeed::general>("6 layers in an L-shaped room", {room});
  Medium cells = grid(60, 60, 30, {6, 6, 3}, smoke(1));
  Draws draw(52);
  for (int i = 0; i < 60 * 60 * 30; ++i)
    cells.data.extinction.push_back(static_cast<float>(0.6 * draw()));
  time_it<MediaNeed::general>("60 x 60 x 30 cells of 0.1 m", {cells});
}

}  // namespace luxodus::bench
