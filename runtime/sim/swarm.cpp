#include "runtime/sim/swarm.hpp"

#include <algorithm>
#include <cmath>

#include "runtime/core/random.hpp"

namespace luxodus {

namespace {

/// The random draws of a swarm, in a fixed order.
class Draw {
 public:
  explicit Draw(uint64_t seed) : random_(seed, RandomStream::faults) { random_.start(0); }

  bool chance(double p) { return random_.uniform_double() < p; }
  /// Log-uniform.
  double between(double low, double high) {
    return low * std::pow(high / low, random_.uniform_double());
  }
  Nanoseconds span(Nanoseconds low, Nanoseconds high) {
    return std::llround(between(static_cast<double>(low), static_cast<double>(high)));
  }
  Nanoseconds moment(Nanoseconds end) {
    return std::llround(random_.uniform_double() * static_cast<double>(end));
  }
  size_t below(size_t n) {
    return std::min(n - 1, static_cast<size_t>(random_.uniform_double() * static_cast<double>(n)));
  }

 private:
  Random random_;
};

LinkTraits draw_links(Draw& draw) {
  LinkTraits links;
  links.delay = draw.span(microseconds(5), milliseconds(20));
  links.jitter = draw.span(microseconds(1), milliseconds(5));
  links.bytes_per_second = draw.between(1e6, 1e10);
  links.queue_bytes = static_cast<size_t>(draw.between(1 << 18, 1 << 24));
  const auto share = [&](double most) { return draw.chance(0.5) ? draw.between(1e-4, most) : 0.0; };
  links.tail_share = share(0.1);
  links.tail = draw.span(milliseconds(1), seconds(1));
  links.loss = share(0.1);
  links.duplication = share(0.1);
  links.reordering = share(0.1);
  links.corruption = share(0.02);
  links.ghosts = share(0.01);
  return links;
}

Fault draw_fault(Draw& draw, Fault::Kind kind, const SwarmFrame& frame) {
  Fault fault;
  fault.kind = kind;
  fault.at = draw.moment(frame.lasts);
  fault.lasts = draw.span(milliseconds(10), seconds(10));
  fault.factor = draw.between(2, 50);
  if (kind == Fault::Kind::crash || kind == Fault::Kind::pause || kind == Fault::Kind::slow ||
      kind == Fault::Kind::full_disk || kind == Fault::Kind::failed_read) {
    fault.node = {static_cast<uint16_t>(draw.below(frame.nodes))};
    return fault;
  }
  const Edge edge = frame.edges[draw.below(frame.edges.size())];
  const bool forth = draw.chance(0.5);
  fault.node = forth ? edge.a : edge.b;
  fault.peer = forth ? edge.b : edge.a;
  return fault;
}

/// Isolates one node, or a part of the graph from the rest; in both directions or one.
void draw_partition(Draw& draw, const SwarmFrame& frame, std::vector<Fault>& faults) {
  std::vector<bool> inside(frame.nodes);
  const bool single = draw.chance(0.5);
  const size_t chosen = draw.below(frame.nodes);
  for (size_t i = 0; i < inside.size(); ++i) inside[i] = single ? i == chosen : draw.chance(0.5);
  const bool outwards = draw.chance(0.7);
  const bool inwards = !outwards || draw.chance(0.7);
  Fault cut;
  cut.kind = Fault::Kind::cut;
  cut.at = draw.moment(frame.lasts);
  cut.lasts = draw.span(milliseconds(100), seconds(20));
  for (const Edge& edge : frame.edges) {
    if (inside[edge.a.value] == inside[edge.b.value]) continue;
    const bool a_inside = inside[edge.a.value];
    const NodeId in = a_inside ? edge.a : edge.b, out = a_inside ? edge.b : edge.a;
    if (outwards) faults.push_back({cut.kind, cut.at, cut.lasts, in, out, 1});
    if (inwards) faults.push_back({cut.kind, cut.at, cut.lasts, out, in, 1});
  }
}

}  // namespace

FaultPlan swarm(uint64_t seed, const SwarmFrame& frame) {
  Draw draw(seed);
  FaultPlan plan;
  plan.seed = seed;
  plan.links = draw_links(draw);
  plan.healed_at = frame.lasts;
  for (int k = 0; k < drawn_fault_kinds; ++k) {
    const auto kind = static_cast<Fault::Kind>(k);
    if (draw.chance(0.5)) continue;
    const auto count = static_cast<size_t>(draw.between(1, 8));
    for (size_t i = 0; i < count; ++i) {
      const Fault fault = draw_fault(draw, kind, frame);
      const bool spared = kind == Fault::Kind::crash &&
                          std::count(frame.spared.begin(), frame.spared.end(), fault.node) > 0;
      if (!spared) plan.faults.push_back(fault);
    }
  }
  if (draw.chance(0.5)) draw_partition(draw, frame, plan.faults);
  // No fault outlasts the healing.
  for (Fault& fault : plan.faults)
    fault.lasts = std::min(fault.lasts, std::max<Nanoseconds>(1, frame.lasts - fault.at));
  return plan;
}

}  // namespace luxodus
