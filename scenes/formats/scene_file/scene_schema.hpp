// The schema of scene files: every table and key, defined once for runtime/toml, which reads by it.
// README.md repeats the same rows, and a test compares the two. Constant data; any thread.
#pragma once

#include <vector>

#include "runtime/toml/schema.hpp"

namespace luxodus {

using toml::KeySpec;
using toml::TableSpec;

/// All tables, in the order of the README.
const toml::Schema& scene_schema();

/// The keys of `a`, then those of `b`.
inline std::vector<KeySpec> joined(std::vector<KeySpec> a, const std::vector<KeySpec>& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

/// The key `repeat`, for everything that is placed.
KeySpec repeat_key();
/// Keys of a photometric file; `whether`: "required", or "" where another key may replace them.
std::vector<KeySpec> photometric_file_keys(const char* whether);
/// The key `ifc_guid`, for everything that may come from a model.
KeySpec ifc_guid_key();
/// Keys of a luminaire's operating states.
std::vector<KeySpec> operation_keys();

/// Keys of a sign except its name, place and routes; none is required.
std::vector<KeySpec> sign_body_keys();

// Parts of the schema, one per source file.
std::vector<TableSpec> geometry_schema();
TableSpec run_keys();                      // part of geometry_schema
std::vector<TableSpec> object_schema();    // part of geometry_schema
std::vector<TableSpec> data_set_schema();  // part of light_schema
std::vector<TableSpec> light_schema();
std::vector<TableSpec> measurement_schema();
std::vector<TableSpec> scenario_schema();
std::vector<TableSpec> assessment_schema();
std::vector<TableSpec> project_schema();
std::vector<TableSpec> design_schema();
std::vector<TableSpec> people_schema();

}  // namespace luxodus
