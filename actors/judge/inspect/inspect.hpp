// Finds probable mistakes in a scene before anything is traced: lamps in walls, eyes that see
// nothing, rooms that are not closed, routes wider than their corridor, meshes in another unit. It
// applies no code and changes nothing. Called from one thread; works on several. Design: README.md
// of this folder.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "scenes/light/world/description.hpp"

namespace luxodus {

/// An error makes results wrong: commands refuse the scene. A warning may be intended. A note says
/// what a reader of the results should know.
enum class Severity { note, warning, error };
const char* word_of(Severity severity);

struct Finding {
  Severity severity = Severity::note;
  std::string kind;  // for programs: one of the words in README.md
  Problem problem;   // file, line, what, what to do

  /// "file:line: error: what"
  std::string text() const;
};

namespace limits {
/// Findings of one kind and severity that are reported separately; the rest is counted.
inline constexpr size_t findings_of_a_kind = 10;
}  // namespace limits

/// Inspects a scene in these scenarios; a finding common to several is reported once. Errors first,
/// then warnings, then notes. A pack has no findings: it was inspected when it was made.
/// Errors: a scene that cannot be compiled.
Result<std::vector<Finding>> inspect(const std::shared_ptr<const SceneDescription>& scene,
                                     const std::vector<Scenario>& scenarios, int threads);

bool has_error(const std::vector<Finding>& findings);

}  // namespace luxodus
