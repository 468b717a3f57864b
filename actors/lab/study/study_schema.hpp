// Every table and key of a study's file and of a file of costs, stated once for runtime/toml, which
// reads by it. README.md repeats the same rows, and a test compares the two. Constant data; any
// thread.
#pragma once

#include "runtime/toml/schema.hpp"

namespace luxodus {

/// All tables, in the order of the README.
const toml::Schema& study_schema();

}  // namespace luxodus
