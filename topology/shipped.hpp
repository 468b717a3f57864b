// Minimum-path graphs of common sizes, found by long searches (amp.hpp) and compiled into the
// program, so that a start needs neither a search nor a file. Constant values; any thread.
#pragma once

#include <optional>
#include <vector>

#include "topology/amp.hpp"
#include "topology/graph.hpp"

namespace luxodus {

/// A size that ships.
struct ShippedSize {
  uint32_t nodes = 0;
  uint32_t links = 0;
  uint32_t controller_links = 0;

  friend bool operator==(const ShippedSize&, const ShippedSize&) = default;
};

/// All of them.
std::vector<ShippedSize> shipped_sizes();

/// The graph of this size, if it ships. `role` is that of its controller, where it has one: then it
/// is not `none`.
std::optional<Graph> shipped_graph(const ShippedSize& size,
                                   ControllerRole role = ControllerRole::endpoint);

/// The graph that ships for this request, else one that is searched for.
/// Errors: as find_amp.
Result<Graph> minimum_path_graph(const AmpRequest& request);

}  // namespace luxodus
