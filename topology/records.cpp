#include "topology/records.hpp"

namespace luxodus {
namespace {

struct BestKnown {
  uint32_t nodes;
  uint32_t links;
  KnownBest best;
};

constexpr KnownSource bound = KnownSource::meets_bound;
constexpr KnownSource published = KnownSource::published;
constexpr KnownSource searched = KnownSource::searched;

// Nodes, links per node; diameter, average path length, and source.
constexpr BestKnown best_known[] = {
    {8, 3, {2, 1.571429, bound}},       {13, 3, {3, 2.038462, bound}},
    {16, 3, {3, 2.200000, bound}},      {32, 3, {4, 2.935484, bound}},
    {36, 3, {4, 3.067, published}},     {40, 3, {5, 3.171795, searched}},
    {41, 3, {5, 3.230488, searched}},   {53, 3, {5, 3.542816, searched}},
    {64, 3, {5, 3.769841, searched}},   {96, 3, {6, 4.272, published}},
    {128, 3, {7, 4.685039, searched}},  {256, 3, {8, 5.658333, searched}},
    {384, 3, {9, 6.226, published}},    {512, 3, {9, 6.725049, searched}},
    {1024, 3, {11, 7.679, published}},  {8, 4, {2, 1.428571, bound}},
    {13, 4, {2, 1.666667, bound}},      {16, 4, {3, 1.750000, published}},
    {32, 4, {3, 2.354839, bound}},      {40, 4, {3, 2.487179, bound}},
    {41, 4, {3, 2.500000, bound}},      {53, 4, {4, 2.699565, searched}},
    {64, 4, {4, 2.869048, searched}},   {72, 4, {4, 2.985915, bound}},
    {98, 4, {4, 3.275405, published}},  {128, 4, {5, 3.492126, searched}},
    {256, 4, {6, 4.140196, searched}},  {16, 5, {2, 1.666667, bound}},
    {32, 5, {3, 2.032258, bound}},      {64, 5, {3, 2.523810, bound}},
    {72, 5, {3, 2.577465, bound}},      {128, 5, {4, 2.998031, searched}},
    {256, 5, {5, 3.516667, searched}},  {512, 5, {6, 4.042074, searched}},
    {1024, 5, {6, 4.562378, searched}}, {16, 6, {2, 1.600000, bound}},
    {32, 6, {2, 1.806452, bound}},      {64, 6, {3, 2.333333, bound}},
    {128, 6, {4, 2.712598, searched}},  {256, 6, {4, 3.169608, searched}},
    {1024, 6, {6, 4.074352, searched}}, {16, 8, {2, 1.466667, bound}},
    {32, 8, {2, 1.741935, bound}},      {64, 8, {3, 1.927, published}},
    {128, 8, {3, 2.433071, bound}},     {256, 8, {4, 2.736, published}},
    {512, 8, {4, 3.111, published}},    {1024, 8, {5, 3.505, published}},
};

}  // namespace

std::optional<KnownBest> known_best(uint32_t nodes, uint32_t links) {
  for (const BestKnown& row : best_known) {
    if (row.nodes == nodes && row.links == links) return row.best;
  }
  return std::nullopt;
}

}  // namespace luxodus
