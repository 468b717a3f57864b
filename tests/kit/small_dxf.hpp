// A small DXF drawing for tests: groups of code and value. Any thread.
#pragma once

#include <initializer_list>
#include <string>
#include <utility>

namespace luxodus::test {

/// Pairs of code and value, one line each.
inline std::string dxf_groups(std::initializer_list<std::pair<int, std::string>> pairs) {
  std::string out;
  for (const auto& [code, value] : pairs) out += std::to_string(code) + "\n" + value + "\n";
  return out;
}

inline std::string dxf_line(const char* layer, const char* x1, const char* y1, const char* x2,
                            const char* y2) {
  return dxf_groups(
      {{0, "LINE"}, {8, layer}, {10, x1}, {20, y1}, {30, "0"}, {11, x2}, {21, y2}, {31, "0"}});
}

inline std::string dxf_insert(const char* block, const char* x, const char* y, const char* turn) {
  return dxf_groups(
      {{0, "INSERT"}, {8, "LIGHTS"}, {2, block}, {10, x}, {20, y}, {30, "0"}, {50, turn}});
}

/// A drawing of these entities, with a header of these variables.
inline std::string dxf_of(const std::string& entities, const std::string& header = "") {
  return dxf_groups({{0, "SECTION"}, {2, "HEADER"}}) + header +
         dxf_groups({{0, "ENDSEC"}, {0, "SECTION"}, {2, "ENTITIES"}}) + entities +
         dxf_groups({{0, "ENDSEC"}, {0, "EOF"}});
}

/// A room of 5 m x 4 m in millimetres, as a closed polyline, with two blocks in it.
inline std::string dxf_drawing(const std::string& more = "", const char* unit = "4") {
  return dxf_groups({{0, "SECTION"},
                     {2, "HEADER"},
                     {9, "$INSUNITS"},
                     {70, unit},
                     {0, "ENDSEC"},
                     {0, "SECTION"},
                     {2, "BLOCKS"},
                     {0, "BLOCK"},
                     {8, "0"},
                     {2, "LAMP"},
                     {70, "0"},
                     {10, "0"},
                     {20, "0"},
                     {30, "0"},
                     {3, "LAMP"},
                     {1, ""}}) +
         dxf_line("WALLS", "0", "0", "1", "1") +
         dxf_groups({{0, "ENDBLK"},
                     {0, "ENDSEC"},
                     {0, "SECTION"},
                     {2, "ENTITIES"},
                     {0, "LWPOLYLINE"},
                     {8, "WALLS"},
                     {90, "4"},
                     {70, "1"},
                     {10, "0"},
                     {20, "0"},
                     {10, "5000"},
                     {20, "0"},
                     {10, "5000"},
                     {20, "4000"},
                     {10, "0"},
                     {20, "4000"}}) +
         dxf_insert("LAMP", "2500", "2000", "30") + dxf_insert("EXIT", "4900", "2000", "90") +
         more + dxf_groups({{0, "ENDSEC"}, {0, "EOF"}});
}

}  // namespace luxodus::test
