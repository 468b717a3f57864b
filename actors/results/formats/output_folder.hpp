// The folder that a command writes its results into: checked before the work begins, so that hours
// of tracing do not fail at an unwritable folder, and held by one process at a time. Any thread;
// the lock belongs to the process.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "runtime/core/atomic_file.hpp"
#include "runtime/core/output_path.hpp"
#include "runtime/core/result.hpp"

namespace luxodus {

/// The files that a command is about to write, by paths within its folder.
struct OutputPlan {
  std::vector<std::string> files;
  std::vector<std::string> folders;
};

class OutputFolder {
 public:
  /// Makes the folder if missing, and locks it until this object or the process ends. Stale
  /// temporary files of killed writers are removed.
  /// Errors: a folder that cannot be made or written; another process that writes into it, by its
  /// number; a planned file that exists as a folder, a device or a symbolic link; a planned
  /// subfolder that exists as something else.
  static Result<OutputFolder> claim(const std::filesystem::path& folder, const OutputPlan& plan);
  OutputFolder(OutputFolder&&) noexcept;
  OutputFolder& operator=(OutputFolder&&) noexcept;
  /// Unlocks. A folder that claim() has made and that is still empty is removed.
  ~OutputFolder();

  /// With symbolic links resolved, so that files are written there and nowhere else.
  const std::filesystem::path& path() const;
  /// As the user named it.
  const std::filesystem::path& named() const;

 private:
  struct State;
  explicit OutputFolder(std::unique_ptr<State> state);

  std::unique_ptr<State> state_;
};

/// Checks whether a file can be written, by its path and its folder.
/// Errors: as write_file_atomically, before anything is computed.
Result<void> check_output_file(const std::filesystem::path& file);

}  // namespace luxodus
