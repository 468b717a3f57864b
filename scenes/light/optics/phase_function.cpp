// Checks a phase function as a scene describes it, and turns a table into a piecewise linear
// density of the cosine with its exact distribution function. All sums are in double and rounded
// once.
#include "scenes/light/optics/phase_function.hpp"

#include <string>

namespace luxodus {

namespace {

/// Whether the table can be compiled.
Result<void> check_table(const Phase& phase) {
  const std::vector<double>& cosines = phase.table_cos;
  const std::vector<double>& values = phase.table_value;
  if (cosines.size() != values.size()) {
    return problem("a phase table needs as many values as cosines (" +
                   std::to_string(cosines.size()) + " cosines, " + std::to_string(values.size()) +
                   " values)");
  }
  if (cosines.size() < 2 || cosines.size() > phase_limits::max_table_entries) {
    return problem("a phase table needs 2 to " + std::to_string(phase_limits::max_table_entries) +
                   " entries, this one has " + std::to_string(cosines.size()));
  }
  if (cosines.front() != -1.0 || cosines.back() != 1.0) {
    return problem("a phase table runs over cosines from -1 to 1; add the missing ends");
  }
  double total = 0;
  for (std::size_t i = 0; i < cosines.size(); ++i) {
    if (!(values[i] >= 0) || !std::isfinite(values[i])) {
      return problem("phase table entry " + std::to_string(i + 1) +
                     " is negative or not a number; write a density per solid angle, 0 or more");
    }
    if (i == 0) continue;
    // Also false for NaN. Compared in the sampler's precision.
    if (!(static_cast<Real>(1.0 - cosines[i - 1]) > static_cast<Real>(1.0 - cosines[i]))) {
      return problem("phase table cosines must ascend by more than rounding; entry " +
                     std::to_string(i + 1) + " does not");
    }
    total += 0.5 * (values[i - 1] + values[i]) * (cosines[i] - cosines[i - 1]);
  }
  if (!(total > 0) || !std::isfinite(total)) {
    return problem("a phase table needs at least one value above 0, and a finite sum");
  }
  return {};
}

}  // namespace

Result<PhaseFunction> PhaseFunction::make(const Phase& phase, const SourcePlace& where) {
  PhaseFunction out;
  out.kind_ = phase.kind;
  if (phase.kind == PhaseKind::henyey_greenstein) {
    if (!(std::fabs(phase.g) <= 1.0)) {
      return problem_in(where, "the asymmetry g of a phase function lies between -1 and 1");
    }
    const double magnitude = std::fabs(phase.g);
    const bool straight = 1.0 - magnitude < phase_limits::min_one_minus_g;
    if (magnitude == 0.0) out.kind_ = PhaseKind::isotropic;
    out.sign_ = phase.g < 0 ? -1.0_r : 1.0_r;
    out.g_ = straight ? 1.0_r : static_cast<Real>(magnitude);
    out.one_minus_g_ = straight ? 0.0_r : static_cast<Real>(1.0 - magnitude);
    out.mean_cosine_ = out.sign_ * out.g_;
    out.mean_second_ = out.g_ * out.g_;
  }
  if (phase.kind == PhaseKind::rayleigh) out.mean_second_ = 0.1_r;
  if (phase.kind == PhaseKind::tabulated) {
    if (auto ok = check_table(phase); !ok) return problem_in(where, ok.problem());
    out.compile_table(phase);
  }
  return out;
}

void PhaseFunction::compile_table(const Phase& phase) {
  const std::vector<double>& cosines = phase.table_cos;
  const std::vector<double>& values = phase.table_value;
  const std::size_t count = cosines.size();
  double total = 0;
  double moment = 0, square = 0;
  std::vector<double> below(count, 0.0);
  for (std::size_t i = 1; i < count; ++i) {
    const double c0 = cosines[i - 1];
    const double c1 = cosines[i];
    const double f0 = values[i - 1];
    const double f1 = values[i];
    total += 0.5 * (f0 + f1) * (c1 - c0);
    // Simpson's rule is exact for products of two or three linear functions.
    moment += (c1 - c0) / 6.0 * (f0 * c0 + (f0 + f1) * (c0 + c1) + f1 * c1);
    square +=
        (c1 - c0) / 6.0 * (f0 * c0 * c0 + 0.5 * (f0 + f1) * (c0 + c1) * (c0 + c1) + f1 * c1 * c1);
    below[i] = total;
  }
  table_.resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    table_[i] = {static_cast<Real>(1.0 - cosines[i]), static_cast<Real>(values[i] / total),
                 static_cast<Real>(below[i] / total)};
  }
  mean_cosine_ = static_cast<Real>(moment / total);
  mean_second_ = static_cast<Real>(1.5 * square / total - 0.5);
}

PhaseFunction::Deflection PhaseFunction::tabulated(Real u) const {
  // The first node with a distribution value above u ends the segment. u < 1, the last node's
  // value, so there is one; a segment without probability is never found.
  const auto end = std::upper_bound(table_.begin() + 1, table_.end() - 1, u,
                                    [](Real x, const Node& node) { return x < node.below; });
  const Node& right = *end;
  const Node& left = *(end - 1);
  const Real width = left.one_minus_cos - right.one_minus_cos;
  const Real slope = (right.density - left.density) / width;
  // The root of density x + slope x^2 / 2 = rest, in the form without subtraction.
  const Real rest = u - left.below;
  const Real root = safe_sqrt(left.density * left.density + 2.0_r * slope * rest);
  const Real sum = left.density + root;
  const Real x = sum > 0.0_r ? std::min(width, 2.0_r * rest / sum) : 0.0_r;
  const Real one_minus_cos = left.one_minus_cos - x;
  return {1.0_r - one_minus_cos, safe_sqrt(one_minus_cos * (2.0_r - one_minus_cos))};
}

Real PhaseFunction::tabulated_density(Real cos_theta) const {
  const Real sought = std::clamp(1.0_r - cos_theta, 0.0_r, 2.0_r);
  const auto end =
      std::upper_bound(table_.begin() + 1, table_.end() - 1, sought,
                       [](Real x, const Node& node) { return x > node.one_minus_cos; });
  const Node& right = *end;
  const Node& left = *(end - 1);
  const Real t = (left.one_minus_cos - sought) / (left.one_minus_cos - right.one_minus_cos);
  return 0.5_r * inverse_pi_f * (left.density + t * (right.density - left.density));
}

}  // namespace luxodus
