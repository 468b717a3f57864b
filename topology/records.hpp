// The shortest graphs known for some sizes, for comparison with a search: from the tables of Graph
// Golf (research.nii.ac.jp/graphgolf, 2016 to 2018) and of the degree/diameter problem
// (combinatoricswiki.org, 2024); for sizes without a table from our own searches, before the graphs
// of shipped.hpp were found. Constant data; any thread.
#pragma once

#include <cstdint>
#include <optional>

namespace luxodus {

enum class KnownSource {
  meets_bound,  // optimal
  published,    // by others
  searched,     // by our own search; better ones may be known elsewhere
};

struct KnownBest {
  uint32_t diameter = 0;
  double average = 0;  // hops per pair, to six digits or as published
  KnownSource source = KnownSource::searched;
};

std::optional<KnownBest> known_best(uint32_t nodes, uint32_t links);

}  // namespace luxodus
