#include "topology/lift.hpp"

#include <utility>

namespace luxodus {

Lift::Lift(const LiftShape& shape, Random& random)
    : shape_(shape), joints_(size_t{shape.base} * shape.links) {
  std::vector<Dart> order(joints_.size());
  for (Dart d = 0; d < darts(); ++d) order[d] = d;
  for (Dart i = darts(); i > 1; --i) std::swap(order[i - 1], order[random_below(random, i)]);

  size_t next = 0;
  for (; next < shape.controller_links / shape.turns; ++next) set(order[next], to_controller, 0);
  for (; next + 1 < order.size(); next += 2) {
    join(order[next], order[next + 1], random_below(random, shape.turns));
  }
  if (next < order.size()) leave_alone(order[next]);
  former_.clear();
}

void Lift::set(Dart dart, Dart mate, uint32_t turn) {
  former_.push_back({dart, joints_[dart]});
  joints_[dart] = {mate, mate == to_controller ? 0 : mate / shape_.links, turn};
}

void Lift::join(Dart a, Dart b, uint32_t turn) {
  set(a, b, turn);
  set(b, a, (shape_.turns - turn) % shape_.turns);
}

void Lift::leave_alone(Dart dart) {
  set(dart, dart, shape_.turns % 2 == 0 ? shape_.turns / 2 : 0);
}

void Lift::change(Random& random) {
  // One change in eight keeps the joints and changes a turn, if there are turns.
  constexpr uint32_t turns_alone_one_in = 8;
  former_.clear();
  const Dart a = random_below(random, darts());
  const Dart b = random_below(random, darts());
  const Dart mate = joints_[a].mate;
  const bool turn_alone = shape_.turns > 1 && random_below(random, turns_alone_one_in) == 0;
  if (turn_alone && mate != to_controller && mate != a) {
    join(a, mate, random_below(random, shape_.turns));
  } else if (a != b && mate == b && shape_.turns % 2 == 0) {
    leave_alone(a);
    leave_alone(b);
  } else if (a != b && mate == a && joints_[b].mate == b) {
    join(a, b, random_below(random, shape_.turns));
  } else {
    exchange(a, b, random);
  }
}

/// The 2-opt move: the two darts exchange their partners.
void Lift::exchange(Dart a, Dart b, Random& random) {
  const Joint of_a = joints_[a];
  const Joint of_b = joints_[b];
  if (a == b || of_a.mate == b) return;
  const auto give = [&](Dart dart, Dart former, const Joint& joint) {
    if (joint.mate == to_controller) {
      set(dart, to_controller, 0);
    } else if (joint.mate == former) {
      leave_alone(dart);
    } else {
      join(dart, joint.mate, random_below(random, shape_.turns));
    }
  };
  give(a, b, of_b);
  give(b, a, of_a);
}

void Lift::take_back() {
  for (; !former_.empty(); former_.pop_back()) {
    joints_[former_.back().dart] = former_.back().joint;
  }
}

std::vector<GraphLink> Lift::links() const {
  std::vector<GraphLink> once;
  for (Dart a = 0; a < darts(); ++a) {
    const auto [mate, base, turn] = joints_[a];
    const Vertex from = a / shape_.links;
    const Vertex to = mate == to_controller ? shape_.workers() : turn * shape_.base + base;
    if (from != to) once.push_back(link_between(from, to));
  }
  return turned(shape_.workers(), shape_.turns, once);
}

}  // namespace luxodus
