// The choice among layouts of equal objective: what occupants and installers prefer. Pure: the same
// layout gives the same choice. Thread rule: one thread.
#pragma once

#include "actors/judge/design/layout_problem.hpp"

namespace luxodus {

/// A score; larger is better. It rewards brighter darkest places (also with one luminaire failed),
/// uniformity, few rows of luminaires, few types, and symmetric regions.
double preference(const LayoutProblem& problem, const LayoutSums& sums);

/// Share of luminaires with another one of their type at the mirror image, about the centre of
/// their region's places, lengthwise and crosswise; 1 for a layout that is symmetric in both.
double symmetry_of(const LayoutProblem& problem, const Layout& layout);

/// Improves the preference of a layout by mirroring one half of a region to the other, aligning
/// luminaires in one row, or changing them to one type, repeatedly. The objective never grows.
/// Requires: all demands hold.
Layout tidied(const LayoutIndex& index, Layout layout);

}  // namespace luxodus
