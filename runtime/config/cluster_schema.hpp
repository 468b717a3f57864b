// Every table and key of a cluster file, declared once for runtime/toml. README.md repeats the same
// rows, and a test compares the two. It holds no values: those are in cluster_config.hpp. Constant
// data; any thread.
#pragma once

#include "runtime/toml/schema.hpp"

namespace luxodus::config {

/// All tables, in the order of the README.
const toml::Schema& cluster_schema();

/// Rules for texts of the types "text", "name" and "address", also used for other files.
std::vector<toml::TextRule> text_rules();

}  // namespace luxodus::config
