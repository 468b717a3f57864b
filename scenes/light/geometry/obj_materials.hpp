// What an OBJ and its material libraries (MTL) say of materials. Internal to the import of meshes.
// Messages do not quote the text, because the file may be one that the reader of the message must
// not see; they do quote names read from a mesh. No shared state; any thread.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/core/result.hpp"

namespace luxodus {

/// Lines of words in an OBJ or MTL: they end in LF, CR LF or CR; one that ends in a backslash goes
/// on in the next.
class MeshLines {
 public:
  /// Requires: a text that outlives this. A byte order mark is skipped.
  explicit MeshLines(std::string_view text);

  /// The next line and its number; false at the end.
  bool next(std::string_view& line);
  int number() const { return number_; }
  size_t at() const { return at_; }

 private:
  std::string_view text_;
  size_t at_ = 0;
  int number_ = 0, ended_ = 0;
  std::string joined_;
};

/// Removes and returns the first word of a line; "" if there is none.
std::string_view take_word(std::string_view& line);
/// The rest of a line as one name, which may contain blanks.
std::string_view without_blanks(std::string_view rest);
/// A number as OBJ writes it: "1", "+.5", "-1.", "2e-3"; tiny ones are 0. Nothing where the word is
/// no number; infinite and NaN are returned as such.
std::optional<double> mesh_number(std::string_view word);

/// Colours of materials. For a material without one there is none.
class ObjMaterials {
 public:
  explicit ObjMaterials(std::string obj) : obj_(std::move(obj)) {}

  /// A line of the OBJ, after its first word: "mtllib", "usemtl".
  void names_library(std::string_view rest);
  void uses(std::string_view name, int line);
  /// Reads the libraries that the OBJ names and that are there. Errors: one that is too large, or
  /// a number in it that is none.
  Result<void> read_libraries();

  /// The colour of this material. Errors: why there is none, and where.
  Result<glm::dvec3> colour(const std::string& material) const;
  const std::vector<std::string>& files() const { return read_; }
  /// What the libraries say and is not read.
  std::vector<std::string> notes() const;

 private:
  struct Declared {
    SourcePlace place;
    std::optional<glm::dvec3> colour;
    bool has_picture = false;  // a texture for its colour
    bool emits = false, lets_pass = false;
  };

  Result<void> read_library(const std::string& path);
  Result<void> take_line(std::string_view word, std::string_view rest, Declared& material,
                         const SourcePlace& place);

  std::string obj_;
  std::vector<std::string> libraries_;    // as named
  std::vector<std::string> read_;         // files
  std::map<std::string, int> first_use_;  // lines of the OBJ
  std::map<std::string, Declared> declared_;
};

}  // namespace luxodus
