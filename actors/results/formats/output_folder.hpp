// The folder that a command writes its results into: checked before the work begins, so that hours
// of tracing do not end at a folder that cannot be written, and held by one process at a time.
// Any thread; the lock belongs to the process.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "runtime/core/atomic_file.hpp"
#include "runtime/core/output_path.hpp"
#include "runtime/core/result.hpp"

namespace luxodus {

/// What a command is about to write, by paths within its folder.
struct OutputPlan {
  std::vector<std::string> files;
  std::vector<std::string> folders;
};

class OutputFolder {
 public:
  /// Makes the folder if need be, and locks it until this ends, however it ends. Stale temporary
  /// files of killed writers are removed.
  /// Errors: a folder that cannot be made or written; another process that writes into it, by its
  /// number; what is planned as a file and is a folder, a device or a symbolic link; what is
  /// planned as a subfolder and is none.
  static Result<OutputFolder> claim(const std::filesystem::path& folder, const OutputPlan& plan);
  OutputFolder(OutputFolder&&) noexcept;
  OutputFolder& operator=(OutputFolder&&) noexcept;
  /// Unlocks. A folder that claim() has made and that nothing was written into is removed.
  ~OutputFolder();

  /// Without symbolic links, so that files are written into it and nowhere else.
  const std::filesystem::path& path() const;
  /// As it was named, for people.
  const std::filesystem::path& named() const;

 private:
  struct State;
  explicit OutputFolder(std::unique_ptr<State> state);

  std::unique_ptr<State> state_;
};

/// Whether a file that a command is about to write can be: by its place and by its folder.
/// Errors: as write_file_atomically, before anything is computed.
Result<void> check_output_file(const std::filesystem::path& file);

}  // namespace luxodus
