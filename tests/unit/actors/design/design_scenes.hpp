// Scenes that designs are tested on, and the designs of them, with nobody who watches.
#pragma once

#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <filesystem>
#include <string>

#include "actors/design/design.hpp"
#include "tests/kit/described.hpp"
#include "tests/unit/actors/design/silent.hpp"

namespace luxodus::test {

/// A closed room with a corner at the origin [m].
inline std::string box_room(double x, double y, double z) {
  return fmt::format(R"(
[[object]]
name = "room"
shape = "room"
low = [0, 0, 0]
high = [{}, {}, {}]
material = "white50"
)",
                     x, y, z);
}

/// A rule set, and the state that is judged by it.
inline const std::string judged_2013 = R"(
[assessment]
rules = ["en1838-2013"]
[[scenario]]
name = "failed"
operation = "emergency"
)";

/// `path`: points as the scene file writes them, without the outer brackets.
inline std::string route(const std::string& name, const std::string& path, double width = 1) {
  return fmt::format("[[route]]\nname = \"{}\"\npath = [{}]\nwidth = {}\n", name, path, width);
}

/// The route "way" along x at y [m].
inline std::string way_along(double from, double to, double y, double width = 1) {
  return route("way", fmt::format("[{0}, {1}, 0], [{2}, {1}, 0]", from, y, to), width);
}

inline Result<DesignResult> tried(const std::filesystem::path& file, DesignOptions options = {}) {
  options.threads = 2;
  return design(described(file), options, nobody, silent);
}

inline DesignResult designed(const std::filesystem::path& file, const DesignOptions& options = {}) {
  auto result = tried(file, options);
  INFO((result ? "" : result.problem().text()));
  REQUIRE(result);
  return std::move(result).value();
}

}  // namespace luxodus::test
