// The shortest graphs known for some sizes, so that a search can say where it stands: from the
// tables of Graph Golf (research.nii.ac.jp/graphgolf, 2016 to 2018) and of the degree/diameter
// problem (combinatoricswiki.org, 2024), and from searches of our own, before the graphs of
// shipped.hpp were found, where no table was at hand. Constant values; any thread.
#pragma once

#include <cstdint>
#include <optional>

namespace luxodus {

enum class KnownSource {
  meets_bound,  // and so cannot be beaten
  published,    // by others
  searched,     // by a search of our own; others may know better
};

struct KnownBest {
  uint32_t diameter = 0;
  double average = 0;  // hops a pair, to six digits or as many as were published
  KnownSource source = KnownSource::searched;
};

std::optional<KnownBest> known_best(uint32_t nodes, uint32_t links);

}  // namespace luxodus
