// A temporary folder for the answer of another process. It is removed with its contents at the end;
// if this process is killed, the next process that makes one removes it. Any thread.
#pragma once

#include <filesystem>

#include "runtime/core/file_descriptor.hpp"

namespace luxodus {

class AnswerFolder {
 public:
  /// Removes folders left by killed processes of this user, and makes one. If none could be made,
  /// path() is empty and errno has the system's reason.
  AnswerFolder();
  ~AnswerFolder();
  AnswerFolder(const AnswerFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
  FileDescriptor held_;  // locked as long as the folder is needed
};

}  // namespace luxodus
