#include "actors/cast/parts/residency.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

namespace luxodus {

namespace {

/// Limit of a node's held bytes, relative to an even distribution.
constexpr double holding_slack = 1.5;

/// References of an average batch of one group, times the group's share of batches.
struct GroupDemand {
  std::vector<double> references, visits;  // by object
  double work = 0;                         // all references
};

struct Interval {
  double from = 0, to = 0;
  double overlap(const Interval& other) const {
    return std::max(0.0, std::min(to, other.to) - std::max(from, other.from));
  }
  double distance(const Interval& other) const {
    return std::max({0.0, other.from - to, from - other.to});
  }
  double length() const { return to - from; }
};

GroupDemand demand_of(const ResidencyRequest& r, size_t group) {
  const ReferenceProfile& profile = r.profile;
  const ReferenceCounts& flights = profile.groups[group];
  GroupDemand demand;
  const double share = r.group_share[group];
  const auto scale = [](int64_t of, int64_t units) {
    return units > 0 ? static_cast<double>(of) / static_cast<double>(units) : 0;
  };
  const double by_flight = share * scale(r.batch_particles, flights.units);
  const double by_eye = share * scale(1, profile.eyes.units);
  for (size_t object = 0; object < profile.objects(); ++object) {
    demand.references.push_back(by_flight * static_cast<double>(flights.references[object]) +
                                by_eye * static_cast<double>(profile.eyes.references[object]));
    demand.visits.push_back(by_flight * static_cast<double>(flights.visits[object]) +
                            by_eye * static_cast<double>(profile.eyes.visits[object]));
    demand.work += demand.references.back();
  }
  return demand;
}

double likeness(const GroupDemand& a, const GroupDemand& b) {
  const auto dot = [](const auto& x, const auto& y) {
    return std::inner_product(x.visits.begin(), x.visits.end(), y.visits.begin(), 0.0);
  };
  const double lengths = std::sqrt(dot(a, a) * dot(b, b));
  return lengths > 0 ? dot(a, b) / lengths : 0;
}

/// Orders groups, the one with the most work first, then each next to the most similar one left.
std::vector<size_t> row_of(const std::vector<GroupDemand>& groups) {
  std::vector<size_t> left(groups.size()), row;
  std::iota(left.begin(), left.end(), size_t{0});
  const auto take_best = [&](auto&& worth) {
    size_t best = 0;
    for (size_t i = 1; i < left.size(); ++i)
      if (worth(left[i]) > worth(left[best])) best = i;
    row.push_back(left[best]);
    left.erase(left.begin() + static_cast<std::ptrdiff_t>(best));
  };
  if (!left.empty()) take_best([&](size_t g) { return groups[g].work; });
  while (!left.empty())
    take_best([&, last = row.back()](size_t g) { return likeness(groups[last], groups[g]); });
  return row;
}

/// The interval of each group on a line from 0 to 1.
std::vector<Interval> line_of(const std::vector<GroupDemand>& groups) {
  double all = 0;
  for (const GroupDemand& group : groups) all += group.work;
  std::vector<Interval> line(groups.size());
  double at = 0;
  for (const size_t g : row_of(groups)) {
    const double length = all > 0 ? groups[g].work / all : 0;
    line[g] = {at, at + length};
    at += length;
  }
  return line;
}

Interval segment_of(size_t node, size_t nodes) {
  const auto n = static_cast<double>(nodes);
  return {static_cast<double>(node) / n, static_cast<double>(node + 1) / n};
}

std::vector<uint32_t> ranks_of(const Interval& segment, const std::vector<Interval>& line) {
  std::vector<uint32_t> order(line.size()), ranks(line.size());
  std::iota(order.begin(), order.end(), 0u);
  std::stable_sort(order.begin(), order.end(), [&](uint32_t a, uint32_t b) {
    const double x = segment.overlap(line[a]), y = segment.overlap(line[b]);
    return x != y ? x > y : segment.distance(line[a]) < segment.distance(line[b]);
  });
  for (uint32_t rank = 0; rank < order.size(); ++rank) ranks[order[rank]] = rank;
  return ranks;
}

/// [node][group]: the share of a group's work in the node's segment.
using Parts = std::vector<std::vector<double>>;

Parts parts_of(const std::vector<Interval>& line, size_t nodes) {
  Parts parts(nodes, std::vector<double>(line.size(), 0));
  for (size_t n = 0; n < nodes; ++n)
    for (size_t g = 0; g < line.size(); ++g)
      if (line[g].length() > 0)
        parts[n][g] = segment_of(n, nodes).overlap(line[g]) / line[g].length();
  return parts;
}

std::vector<ObjectDemand> demand_at(const std::vector<GroupDemand>& groups,
                                    const std::vector<double>& parts,
                                    const std::vector<uint64_t>& built_bytes) {
  std::vector<ObjectDemand> objects(built_bytes.size());
  for (size_t c = 0; c < objects.size(); ++c) {
    objects[c].bytes = built_bytes[c];
    for (size_t g = 0; g < groups.size(); ++g) {
      objects[c].references += parts[g] * groups[g].references[c];
      objects[c].visits += parts[g] * groups[g].visits[c];
    }
  }
  return objects;
}

void choose_pins(NodeResidency& node, const std::vector<ObjectDemand>& objects, uint64_t most) {
  std::vector<uint32_t> order;
  for (uint32_t c = 0; c < objects.size(); ++c)
    if (objects[c].visits > 0) order.push_back(c);
  const auto worth = [&](uint32_t c) {
    return objects[c].visits / static_cast<double>(std::max<uint64_t>(objects[c].bytes, 1));
  };
  std::stable_sort(order.begin(), order.end(),
                   [&](uint32_t a, uint32_t b) { return worth(a) > worth(b); });
  for (const uint32_t c : order) {
    if (node.pinned_bytes + objects[c].bytes > most) continue;
    node.pinned_bytes += objects[c].bytes;
    node.pins.push_back(c);
  }
}

double references_of(std::span<const ObjectDemand> objects) {
  double all = 0;
  for (const ObjectDemand& object : objects) all += object.references;
  return all;
}

/// Pinned objects are always hits, the others at the rate of the rest of the cache.
double expected_hits(const NodeResidency& node, std::vector<ObjectDemand> objects, uint64_t bytes) {
  const double all = references_of(objects);
  for (const uint32_t c : node.pins) objects[c] = {};
  const double rest = references_of(objects);
  const uint64_t left = bytes > node.pinned_bytes ? bytes - node.pinned_bytes : 0;
  return all - rest + rest * lru_hit_rate(objects, left);
}

/// Assigns objects to holders.
class Dealer {
 public:
  Dealer(const ResidencyRequest& request, const std::vector<GroupDemand>& groups,
         const Parts& parts)
      : request_(request), groups_(groups), parts_(parts), held_(parts.size(), 0) {
    const uint64_t all =
        std::accumulate(request.wire_bytes.begin(), request.wire_bytes.end(), uint64_t{0});
    room_ = holding_slack * static_cast<double>(all) * request.replicas /
            static_cast<double>(held_.size());
    alone_ = costs_beside(std::nullopt);
    beside_.resize(held_.size());
  }

  std::vector<NodeId> deal(size_t object) {
    std::vector<NodeId> holders;
    while (holders.size() < request_.replicas) {
      // A further replica is placed as if only the first existed.
      const Costs& costs = holders.empty() ? alone_ : beside(holders.front().value);
      const size_t node = best(object, costs, holders);
      held_[node] += request_.wire_bytes[object];
      holders.push_back({static_cast<uint16_t>(node)});
    }
    return holders;
  }
  const std::vector<uint64_t>& held() const { return held_; }

 private:
  /// [group][node]: hops of all references of the group's work if the node holds the object.
  using Costs = std::vector<std::vector<double>>;

  Costs costs_beside(std::optional<size_t> other) const {
    Costs costs(groups_.size(), std::vector<double>(held_.size(), 0));
    for (size_t g = 0; g < groups_.size(); ++g)
      for (size_t n = 0; n < held_.size(); ++n) {
        if (parts_[n][g] == 0) continue;
        for (size_t h = 0; h < held_.size(); ++h) {
          uint32_t hops = request_.hops[n][h];
          if (other) hops = std::min(hops, request_.hops[n][*other]);
          costs[g][h] += parts_[n][g] * hops;
        }
      }
    return costs;
  }
  const Costs& beside(size_t other) {
    if (beside_[other].empty()) beside_[other] = costs_beside(other);
    return beside_[other];
  }

  size_t best(size_t object, const Costs& costs, const std::vector<NodeId>& taken) const {
    const auto bytes = static_cast<double>(request_.wire_bytes[object]);
    size_t best = held_.size();
    double least = 0;
    bool fits_best = false;
    for (size_t n = 0; n < held_.size(); ++n) {
      if (std::find(taken.begin(), taken.end(), NodeId{static_cast<uint16_t>(n)}) != taken.end())
        continue;
      const bool fits = static_cast<double>(held_[n]) + bytes <= room_;
      double cost = 0;
      for (size_t g = 0; g < groups_.size() && fits; ++g)
        cost += groups_[g].visits[object] * costs[g][n];
      const bool better =
          best == held_.size() || (fits && !fits_best) ||
          (fits == fits_best && (cost < least || (cost == least && held_[n] < held_[best])));
      if (!better) continue;
      best = n;
      least = cost;
      fits_best = fits;
    }
    return best;
  }

  const ResidencyRequest& request_;
  const std::vector<GroupDemand>& groups_;
  const Parts& parts_;
  std::vector<uint64_t> held_;  // bytes, by node
  double room_ = 0;
  Costs alone_;
  std::vector<Costs> beside_;
};

/// Order of assignment: the objects with the highest cost choose first.
std::vector<uint32_t> dealing_order(const ResidencyRequest& r,
                                    const std::vector<GroupDemand>& groups) {
  std::vector<double> traffic(r.wire_bytes.size(), 0);
  for (const GroupDemand& group : groups)
    for (size_t c = 0; c < traffic.size(); ++c)
      traffic[c] += group.visits[c] * static_cast<double>(r.wire_bytes[c]);
  std::vector<uint32_t> order(traffic.size());
  std::iota(order.begin(), order.end(), 0u);
  std::stable_sort(order.begin(), order.end(),
                   [&](uint32_t a, uint32_t b) { return traffic[a] > traffic[b]; });
  return order;
}

}  // namespace

double lru_hit_rate(std::span<const ObjectDemand> objects, uint64_t bytes) {
  const double references = references_of(objects);
  if (references <= 0) return 1;
  // Expected bytes of objects requested within a time; for the characteristic time this is the size
  // of the cache. It grows with the time, so bisection finds it.
  const auto resident_after = [&](double time) {
    double sum = 0;
    for (const ObjectDemand& object : objects)
      sum -= static_cast<double>(object.bytes) * std::expm1(-object.visits * time);
    return sum;
  };
  double all_bytes = 0, visits = 0;
  for (const ObjectDemand& object : objects) {
    if (object.visits > 0) all_bytes += static_cast<double>(object.bytes);
    visits += object.visits;
  }
  const auto room = static_cast<double>(bytes);
  if (all_bytes <= room || visits <= 0) return 1;
  double low = 0, high = 1 / visits;
  while (resident_after(high) < room && high < 1e300) high *= 2;
  for (int i = 0; i < 64; ++i) {
    const double middle = 0.5 * (low + high);
    (resident_after(middle) < room ? low : high) = middle;
  }
  double misses = 0;
  for (const ObjectDemand& object : objects)
    misses += object.visits * std::exp(-object.visits * high);
  return 1 - misses / references;
}

Residency plan_residency(const ResidencyRequest& request) {
  const size_t nodes = request.resident_bytes.size();
  std::vector<GroupDemand> groups;
  for (size_t g = 0; g < request.group_share.size(); ++g) groups.push_back(demand_of(request, g));
  const std::vector<Interval> line = line_of(groups);
  const Parts parts = parts_of(line, nodes);
  Residency plan;
  double hits = 0, references = 0;
  for (size_t n = 0; n < nodes; ++n) {
    NodeResidency node;
    node.group_ranks = ranks_of(segment_of(n, nodes), line);
    const std::vector<ObjectDemand> objects = demand_at(groups, parts[n], request.built_bytes);
    choose_pins(node, objects, request.pinned_bytes[n]);
    const double here = references_of(objects);
    const double found = expected_hits(node, objects, request.resident_bytes[n]);
    node.expected_hit_rate = here > 0 ? found / here : 1;
    hits += found;
    references += here;
    plan.nodes.push_back(std::move(node));
  }
  plan.expected_hit_rate = references > 0 ? hits / references : 1;
  Dealer dealer(request, groups, parts);
  plan.holders.resize(request.wire_bytes.size());
  for (const uint32_t object : dealing_order(request, groups))
    plan.holders[object] = dealer.deal(object);
  for (size_t n = 0; n < nodes; ++n) plan.nodes[n].held_bytes = dealer.held()[n];
  return plan;
}

}  // namespace luxodus
