// Every table and key of a cluster's file, stated once for runtime/toml, which reads by it.
// README.md repeats the same rows, and a test compares the two. It knows no values: those are in
// cluster_config.hpp. Constant data; any thread.
#pragma once

#include "runtime/toml/schema.hpp"

namespace luxodus::config {

/// All tables, in the order of the README.
const toml::Schema& cluster_schema();

/// What texts of the types "text", "name" and "address" must be, for other files of ours, too.
std::vector<toml::TextRule> text_rules();

}  // namespace luxodus::config
