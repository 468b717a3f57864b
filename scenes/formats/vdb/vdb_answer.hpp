// Messages between `luxodus` and `luxodus_vdb`. Internal to this room. Plain values; any thread.
#pragma once

#include <string>

#include "runtime/core/plain_stream.hpp"
#include "scenes/formats/vdb/vdb.hpp"

namespace luxodus::vdb {

/// Builds from the same sources of this exchange (program.cmake) share this name.
inline constexpr const char* job = "vdb " LUX_VDB_BUILD;

/// `grid`: "" requests the list.
struct Question {
  std::string file;
  std::string grid;
  UpAxis up = UpAxis::z;
};

inline void put(PlainWriter& out, const Question& question) {
  out.put(question.file);
  out.put(question.grid);
  out.put(question.up);
}

inline bool get(PlainReader& in, Question& question) {
  return in.get(question.file) && in.get(question.grid) && in.get(question.up);
}

inline void put(PlainWriter& out, const VdbGrid& grid) {
  for (const auto* text : {&grid.name, &grid.type, &grid.kind, &grid.fault}) out.put(*text);
  out.put(grid.cells);
}

inline bool get(PlainReader& in, VdbGrid& grid) {
  for (auto* text : {&grid.name, &grid.type, &grid.kind, &grid.fault})
    if (!in.get(*text)) return false;
  return in.get(grid.cells);
}

inline void put(PlainWriter& out, const VdbSmoke& smoke) {
  for (const uint64_t side : {smoke.nx, smoke.ny, smoke.nz}) out.put(side);
  out.put(smoke.origin);
  out.put(smoke.spacing);
  out.put(smoke.values);
}

inline bool get(PlainReader& in, VdbSmoke& smoke) {
  for (uint64_t* side : {&smoke.nx, &smoke.ny, &smoke.nz})
    if (!in.get(*side) || *side == 0 || *side > limits::vdb_cells) return false;
  return in.get(smoke.origin) && in.get(smoke.spacing) && in.get(smoke.values) &&
         smoke.nx * smoke.ny <= limits::vdb_cells &&
         smoke.nx * smoke.ny * smoke.nz == smoke.values.size() && is_finite(smoke.origin) &&
         is_finite(smoke.spacing);
}

}  // namespace luxodus::vdb
