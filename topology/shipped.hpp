// Minimum-path graphs of common sizes, found by long searches (amp.hpp) and compiled in, so that a
// start needs neither a search nor a file. Constant data; any thread.
#pragma once

#include <optional>
#include <vector>

#include "topology/amp.hpp"
#include "topology/graph.hpp"

namespace luxodus {

/// A size with a compiled-in graph.
struct ShippedSize {
  uint32_t nodes = 0;
  uint32_t links = 0;
  uint32_t controller_links = 0;

  friend bool operator==(const ShippedSize&, const ShippedSize&) = default;
};

/// All sizes.
std::vector<ShippedSize> shipped_sizes();

/// The compiled-in graph of this size, if there is one. `role` is that of its controller; not
/// `none` if it has one.
std::optional<Graph> shipped_graph(const ShippedSize& size,
                                   ControllerRole role = ControllerRole::endpoint);

/// The compiled-in graph for this request, or one found by a search. Errors: those of find_amp.
Result<Graph> minimum_path_graph(const AmpRequest& request);

}  // namespace luxodus
