#include "actors/judge/assess/wrong_verdicts.hpp"

#include <algorithm>
#include <boost/math/distributions/students_t.hpp>

namespace luxodus {

double sure_errors(double wrong, const Comparisons& comparisons, double batches) {
  const double all = static_cast<double>(std::max<size_t>(1, comparisons.views)) *
                     static_cast<double>(comparisons.values) * comparisons.looks;
  const double each_side = std::min(0.5, wrong / all / 2);
  const boost::math::students_t student(batches - 1);
  return boost::math::quantile(boost::math::complement(student, each_side));
}

}  // namespace luxodus
