// Every table and key of study files and cost files, declared once for runtime/toml. README.md
// repeats the same rows, and a test compares the two. Constant data; any thread.
#pragma once

#include "runtime/toml/schema.hpp"

namespace luxodus {

/// All tables, in the order of the README.
const toml::Schema& study_schema();

}  // namespace luxodus
