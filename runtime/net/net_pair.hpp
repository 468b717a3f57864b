// Two nodes with a link, between which costs are measured: one asks, the other holds what is asked
// for. Constant data and pure functions; any thread.
#pragma once

#include "runtime/net/net_config.hpp"

namespace luxodus::net_pair {

inline constexpr NodeId asker{0}, holder{1};

inline NetConfig config_of(NodeId self) {
  NetConfig config;
  config.self = self;
  config.incarnation = {1000u + self.value};
  config.nodes = 2;
  config.edges = {{asker, holder}};
  config.identity.node = self;
  return config;
}

}  // namespace luxodus::net_pair
