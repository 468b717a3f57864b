#include "topology/shipped.hpp"

#include <algorithm>
#include <iterator>

namespace luxodus {
namespace {

/// A graph, as one link of each rotation family.
struct ShippedRow {
  ShippedSize size;
  uint32_t rotation;
  std::vector<GraphLink> families;
};

std::vector<ShippedRow> shipped_rows() {
  // clang-format off: shipped_rows stay shipped_rows.
  return {
      {{6, 4, 0}, 6, {{0, 1}, {0, 2}}},
      {{7, 4, 0}, 7, {{0, 2}, {0, 3}}},
      {{8, 4, 0}, 8, {{0, 2}, {0, 3}}},
      {{9, 4, 0}, 3, {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 4}, {2, 5}}},
      {{10, 4, 0}, 10, {{0, 1}, {0, 4}}},
      {{11, 4, 0}, 11, {{0, 1}, {0, 4}}},
      {{12, 4, 0}, 12, {{0, 2}, {0, 3}}},
      {{13, 4, 0}, 13, {{0, 4}, {0, 6}}},
      {{14, 4, 0},
       2,
       {{0, 2},
        {0, 3},
        {0, 9},
        {0, 10},
        {1, 8},
        {1, 9},
        {1, 11},
        {1, 13},
        {2, 5},
        {3, 4},
        {3, 13},
        {4, 11},
        {4, 12},
        {5, 12},
        {5, 13},
        {6, 13}}},
      {{15, 4, 0},
       3,
       {{0, 1}, {0, 3}, {0, 4}, {0, 13}, {1, 2}, {1, 8}, {1, 12}, {2, 3}, {2, 14}, {4, 9}}},
      {{16, 4, 0},
       4,
       {{0, 5}, {0, 8}, {0, 11}, {0, 15}, {1, 5}, {1, 10}, {2, 7}, {2, 10}, {2, 11}}},
      {{8, 4, 4}, 4, {{0, 1}, {0, 2}, {0, 3}, {1, 5}, {1, 8}}},
      {{16, 4, 4}, 1, {{0, 2},   {0, 5},   {0, 9},   {0, 13},  {1, 6},   {1, 10}, {1, 13},
                       {1, 15},  {2, 4},   {2, 8},   {2, 10},  {3, 7},   {3, 8},  {3, 9},
                       {3, 12},  {4, 6},   {4, 12},  {4, 16},  {5, 7},   {5, 15}, {5, 16},
                       {6, 9},   {6, 15},  {7, 10},  {7, 12},  {8, 14},  {8, 15}, {9, 11},
                       {10, 11}, {11, 14}, {11, 16}, {12, 13}, {13, 14}, {14, 16}}},
      {{24, 4, 0},
       3,
       {{0, 9},
        {0, 10},
        {0, 13},
        {0, 15},
        {1, 3},
        {1, 6},
        {1, 23},
        {2, 12},
        {2, 13},
        {2, 19},
        {3, 4},
        {3, 22},
        {4, 7},
        {4, 15},
        {5, 14},
        {5, 22}}},
      {{32, 4, 0},
       4,
       {{0, 11},
        {0, 23},
        {0, 26},
        {0, 30},
        {1, 2},
        {1, 13},
        {1, 22},
        {1, 30},
        {2, 12},
        {2, 20},
        {3, 5},
        {3, 23},
        {3, 31},
        {4, 13},
        {4, 20},
        {5, 7},
        {6, 22}}},
      {{32, 4, 4},
       4,
       {{0, 15},
        {0, 25},
        {0, 30},
        {0, 32},
        {1, 13},
        {1, 21},
        {1, 28},
        {2, 3},
        {2, 4},
        {2, 11},
        {2, 31},
        {3, 12},
        {3, 30},
        {4, 5},
        {5, 23},
        {6, 15},
        {6, 22}}},
      {{40, 4, 0},
       5,
       {{0, 2},
        {0, 5},
        {0, 10},
        {0, 28},
        {1, 9},
        {1, 14},
        {1, 20},
        {2, 4},
        {2, 39},
        {3, 4},
        {3, 7},
        {3, 14},
        {3, 31},
        {5, 21},
        {5, 30},
        {6, 31}}},
      {{64, 4, 0},
       8,
       {{0, 1},
        {0, 5},
        {0, 10},
        {0, 19},
        {1, 9},
        {1, 47},
        {2, 4},
        {2, 46},
        {2, 60},
        {3, 6},
        {3, 27},
        {4, 23},
        {4, 63},
        {5, 14},
        {5, 15},
        {5, 30}}},
      {{64, 4, 4}, 4, {{0, 9},  {0, 18}, {0, 34},  {0, 51},  {1, 25},  {1, 31}, {1, 42},
                       {1, 62}, {2, 21}, {2, 60},  {3, 35},  {3, 58},  {3, 59}, {4, 24},
                       {4, 45}, {4, 47}, {4, 61},  {5, 6},   {5, 30},  {5, 37}, {6, 8},
                       {6, 14}, {6, 27}, {7, 42},  {7, 44},  {7, 46},  {7, 47}, {8, 9},
                       {8, 64}, {9, 63}, {10, 59}, {11, 61}, {12, 44}, {12, 61}}},
      {{128, 4, 0},
       16,
       {{0, 45},
        {0, 79},
        {0, 105},
        {0, 117},
        {1, 65},
        {1, 83},
        {1, 124},
        {2, 66},
        {2, 69},
        {2, 110},
        {2, 119},
        {3, 38},
        {3, 84},
        {3, 119},
        {4, 52},
        {5, 78},
        {6, 103}}},
      {{256, 4, 0},
       32,
       {{0, 13},
        {0, 18},
        {0, 60},
        {0, 110},
        {1, 41},
        {1, 84},
        {1, 125},
        {2, 131},
        {2, 180},
        {2, 223},
        {3, 91},
        {3, 246},
        {4, 119},
        {5, 15},
        {5, 71},
        {6, 22}}},
  };
  // clang-format on
}

}  // namespace

std::vector<ShippedSize> shipped_sizes() {
  std::vector<ShippedSize> sizes;
  for (const ShippedRow& row : shipped_rows()) sizes.push_back(row.size);
  return sizes;
}

std::optional<Graph> shipped_graph(const ShippedSize& size, ControllerRole role) {
  for (const ShippedRow& row : shipped_rows()) {
    if (row.size != size) continue;
    if (size.controller_links == 0) role = ControllerRole::none;
    return Graph({size.nodes, size.links, role, row.rotation,
                  turned(size.nodes, row.rotation, row.families)});
  }
  return std::nullopt;
}

Result<Graph> minimum_path_graph(const AmpRequest& request) {
  const ControllerRole role =
      request.controller_forwards ? ControllerRole::forwards : ControllerRole::endpoint;
  if (auto shipped = shipped_graph({request.nodes, request.links, request.controller_links}, role))
    return *shipped;
  auto found = find_amp(request, [] { return false; });
  if (!found) return found.problem();
  return std::move(found).value().graph;
}

}  // namespace luxodus
