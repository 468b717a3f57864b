// Residency plans from artificial profiles: they depend on counts only.
#include "actors/cast/parts/residency.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numeric>

#include "runtime/core/random.hpp"

using namespace luxodus;

namespace {

constexpr uint64_t kib = 1024;

/// Every history of a group visits some cells, one reference per visit.
ReferenceCounts visits_of(std::vector<uint64_t> visits) {
  return {1000, visits, visits};
}

struct Made {
  ReferenceProfile profile;
  std::vector<double> share;

  ResidencyRequest request(size_t nodes, uint64_t resident, uint64_t pinned) const {
    const std::vector<uint64_t> bytes(profile.objects(), kib);
    std::vector<std::vector<uint32_t>> hops(nodes, std::vector<uint32_t>(nodes, 1));
    for (size_t n = 0; n < nodes; ++n) hops[n][n] = 0;
    return {profile,
            share,
            1000,
            bytes,
            bytes,
            std::vector(nodes, resident),
            std::vector(nodes, pinned),
            hops,
            1};
  }
};

/// Groups of equal share; those with similar rows visit similar cells.
Made made(const std::vector<std::vector<uint64_t>>& visits) {
  Made m;
  for (const auto& of_group : visits) {
    m.profile.groups.push_back(visits_of(of_group));
    m.share.push_back(1.0 / static_cast<double>(visits.size()));
  }
  m.profile.eyes = {1, std::vector<uint64_t>(visits[0].size(), 0),
                    std::vector<uint64_t>(visits[0].size(), 0)};
  m.profile.built_bytes.assign(visits[0].size(), kib);
  return m;
}

std::vector<ObjectDemand> zipf(int cells) {
  std::vector<ObjectDemand> demand;
  for (int i = 1; i <= cells; ++i) demand.push_back({1.0 / i, 1.0 / i, kib});
  return demand;
}

/// Hits of an LRU cache of `room` equal cells.
double simulated_lru(const std::vector<ObjectDemand>& cells, size_t room, int references) {
  std::vector<double> cumulative;
  double sum = 0;
  for (const ObjectDemand& cell : cells) cumulative.push_back(sum += cell.visits);
  Random random(1, RandomStream::test);
  random.start(0);
  std::vector<size_t> used;  // the least recently used first
  int hits = 0;
  for (int i = 0; i < references; ++i) {
    const double u = sum * random.uniform_double();
    const auto cell = static_cast<size_t>(
        std::lower_bound(cumulative.begin(), cumulative.end(), u) - cumulative.begin());
    const auto at = std::find(used.begin(), used.end(), cell);
    if (at != used.end()) {
      ++hits;
      used.erase(at);
    } else if (used.size() == room) {
      used.erase(used.begin());
    }
    used.push_back(cell);
  }
  return static_cast<double>(hits) / references;
}

}  // namespace

TEST_CASE("the expected hit rate of independent visits equals that of a simulated cache",
          "[residency]") {
  const auto cells = zipf(200);
  for (const size_t room : {10u, 50u, 120u}) {
    INFO(room << " of 200 cells");
    constexpr int references = 200'000;
    // 200 compulsory misses, and a standard error of 1/sqrt(200 000) at most.
    CHECK(std::abs(lru_hit_rate(cells, room * kib) - simulated_lru(cells, room, references)) <
          0.01);
  }
}

TEST_CASE("with equal visits the hit rate is the share of cells that fit", "[residency]") {
  const std::vector<ObjectDemand> cells(100, {1, 1, kib});
  CHECK(lru_hit_rate(cells, 25 * kib) == Approx(0.25).epsilon(1e-6));
  CHECK(lru_hit_rate(cells, 100 * kib) == 1);
  CHECK(lru_hit_rate(cells, 0) == Approx(0).margin(1e-6));
  CHECK(lru_hit_rate({}, 0) == 1);
}

TEST_CASE("repeated references of a history are hits, however small the cache", "[residency]") {
  const std::vector<ObjectDemand> cells(100, {10, 1, kib});
  CHECK(lru_hit_rate(cells, 0) == Approx(0.9).epsilon(1e-6));
}

TEST_CASE("a node prefers groups that visit similar cells, and all nodes get equal work",
          "[residency]") {
  // Groups 0 and 2 light one end of a building, 1 and 3 the other.
  const Made m = made({{90, 80, 1, 0}, {0, 1, 80, 90}, {80, 90, 1, 0}, {0, 1, 90, 80}});
  const Residency plan = plan_residency(m.request(2, 2 * kib, 0));
  const auto& first = plan.nodes[0].group_ranks;
  const auto& second = plan.nodes[1].group_ranks;
  CHECK(std::max(first[0], first[2]) < std::min(first[1], first[3]));
  CHECK(std::max(second[1], second[3]) < std::min(second[0], second[2]));
}

TEST_CASE("every node ranks every group, also with fewer groups than nodes", "[residency]") {
  const Made m = made({{9, 1}, {1, 9}, {5, 5}});
  for (const size_t nodes : {1u, 2u, 5u, 8u}) {
    const Residency plan = plan_residency(m.request(nodes, kib, 0));
    REQUIRE(plan.nodes.size() == nodes);
    for (const NodeResidency& node : plan.nodes) {
      auto ranks = node.group_ranks;
      std::sort(ranks.begin(), ranks.end());
      CHECK(ranks == std::vector<uint32_t>{0, 1, 2});
    }
  }
}

TEST_CASE("pins are the cells with the most visits per byte, and fit their share", "[residency]") {
  const Made m = made({{10, 400, 30, 200}});
  ResidencyRequest request = m.request(1, 4 * kib, 2 * kib);
  request.built_bytes[1] = 8 * kib;  // 50 visits a KiB, and no room
  const Residency plan = plan_residency(request);
  CHECK(plan.nodes[0].pins == std::vector<uint32_t>{3, 2});
  CHECK(plan.nodes[0].pinned_bytes == 2 * kib);
}

TEST_CASE("a cell is held where it is visited, and no node holds more than 1.5 times its share",
          "[residency]") {
  const Made m = made({{90, 80, 70, 60, 1, 1, 1, 1}, {1, 1, 1, 1, 60, 70, 80, 90}});
  const Residency plan = plan_residency(m.request(2, 4 * kib, 0));
  const size_t low = plan.nodes[0].group_ranks[0] == 0 ? 0 : 1;
  for (size_t cell = 0; cell < 8; ++cell) {
    REQUIRE(plan.holders[cell].size() == 1);
    CHECK(plan.holders[cell][0].value == (cell < 4 ? low : 1 - low));
  }
  // All visits are at one node: it may hold 6 of 8.
  const Made lopsided = made({{1, 1, 1, 1, 1, 1, 1, 1}, {0, 0, 0, 0, 0, 0, 0, 0}});
  const Residency fair = plan_residency(lopsided.request(4, 4 * kib, 0));
  uint64_t held = 0;
  for (const NodeResidency& node : fair.nodes) {
    CHECK(node.held_bytes <= 3 * kib);
    held += node.held_bytes;
  }
  CHECK(held == 8 * kib);
}

TEST_CASE("replicas of a cell are on different nodes, near those far from the first",
          "[residency]") {
  // A line of three nodes with the same work everywhere.
  const Made m = made({{5, 5, 5}});
  ResidencyRequest request = m.request(3, 2 * kib, 0);
  request.hops = {{0, 1, 2}, {1, 0, 1}, {2, 1, 0}};
  request.replicas = 2;
  const Residency plan = plan_residency(request);
  for (const auto& holders : plan.holders) {
    REQUIRE(holders.size() == 2);
    CHECK(holders[0] != holders[1]);
  }
  CHECK(plan.holders[0][0].value == 1);  // the middle costs 2 hops, an end 3
}

TEST_CASE("pins do not lower the expected hit rate of independent visits", "[residency]") {
  std::vector<uint64_t> visits;
  for (uint64_t i = 1; i <= 64; ++i) visits.push_back(6400 / i);
  const Made m = made({visits});
  const double without = plan_residency(m.request(2, 16 * kib, 0)).expected_hit_rate;
  const double with = plan_residency(m.request(2, 16 * kib, 8 * kib)).expected_hit_rate;
  CHECK(with > without);
  CHECK(plan_residency(m.request(2, 64 * kib, 0)).expected_hit_rate == 1);
}

TEST_CASE("a profile without references still gives a plan", "[residency]") {
  const Made m = made({{0, 0, 0}, {0, 0, 0}});
  const Residency plan = plan_residency(m.request(2, kib, kib));
  CHECK(plan.expected_hit_rate == 1);
  for (const auto& holders : plan.holders) CHECK(holders.size() == 1);
}
