// A folder for the answer of another process, among those of the system for temporary files. It is
// removed with all that is in it at the end; where this process is killed before, by the next that
// makes one. Any thread.
#pragma once

#include <filesystem>

#include "runtime/core/file_descriptor.hpp"

namespace luxodus {

class AnswerFolder {
 public:
  /// Removes those that killed processes of this user have left, and makes one. The system's reason
  /// is in errno where path() is empty: none could be made.
  AnswerFolder();
  ~AnswerFolder();
  AnswerFolder(const AnswerFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
  FileDescriptor held_;  // locked for as long as the folder is needed
};

}  // namespace luxodus
