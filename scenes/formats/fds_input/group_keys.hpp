// Typed access to the keys of a group of an FDS input file. The first mistake is kept; after it all
// keys have their defaults. A null value, nothing between two commas, keeps the default, as in
// Fortran. One thread.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <vector>

#include "scenes/formats/fds_input/boxes.hpp"
#include "scenes/formats/fds_input/namelist.hpp"

namespace luxodus::fds_input {

namespace limits {
/// Coordinates and lengths [m].
inline constexpr double farthest_m = 1e6;
}  // namespace limits

class GroupKeys {
 public:
  /// `problem` receives the first mistake.
  GroupKeys(const Group& group, const std::string& file, std::optional<Problem>& problem)
      : group_(group), file_(file), problem_(problem) {}

  const std::string& name() const { return group_.name; }
  const std::string& file() const { return file_; }
  int line() const { return group_.line; }
  bool has(std::string_view key) const;
  /// Line of a key, or of the group if the key is absent.
  int line_of(std::string_view key) const;

  /// Reports a mistake at the line of a key.
  void fail(std::string_view key, const std::string& what);
  /// Reports "SHAPE of &OBST is not imported: WHAT TO DO" if the group has the key.
  void refuse(std::string_view key, const std::string& what_to_do);

  /// A text without trailing blanks, as Fortran compares texts.
  std::string text(std::string_view key, const std::string& otherwise = "");
  std::vector<std::string> texts(std::string_view key);
  bool flag(std::string_view key, bool otherwise);
  double number(std::string_view key, double otherwise);
  int integer(std::string_view key, int otherwise);
  /// All numbers of a key; each is finite.
  std::vector<double> numbers(std::string_view key);
  /// An array of `otherwise`'s size; elements that are not given keep its values.
  std::vector<double> array(std::string_view key, std::vector<double> otherwise);
  /// Six coordinates, sorted by axis. Errors: fewer.
  std::optional<Box> box(std::string_view key);
  /// Components of 0 to 255, as 0 to 1; nothing where the key is absent.
  std::optional<glm::dvec3> rgb(std::string_view key);

 private:
  const Parameter* last(std::string_view key) const;
  std::optional<double> number_of(std::string_view key, const Value& value);

  const Group& group_;
  const std::string& file_;
  std::optional<Problem>& problem_;
};

}  // namespace luxodus::fds_input
