// The choice among layouts of one objective: what people who walk there and installers prefer.
// Pure: the same layout gives the same choice. Thread rule: one thread.
#pragma once

#include "actors/judge/design/layout_problem.hpp"

namespace luxodus {

/// Larger is better: places that are bright where they are darkest, also with a luminaire out, even
/// light, luminaires in few rows and of few types, and regions that are their own mirror images.
double preference(const LayoutProblem& problem, const LayoutSums& sums);

/// Of the luminaires, the share that has another one of its type at its mirror image, about the
/// middles of the places of its region, along and across: 1 of a layout that is symmetric about
/// both.
double symmetry_of(const LayoutProblem& problem, const Layout& layout);

/// A layout that is preferred, of those that luminaires mirrored from one half of a region to the
/// other, brought into one row, or taken of another type would give, again and again. Never a
/// larger objective. Requires: all holds.
Layout tidied(const LayoutIndex& index, Layout layout);

}  // namespace luxodus
