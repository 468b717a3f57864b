// The files that a scene was read from, each with a hash of its bytes. Long-running programs, which
// read states of the scene at other times, use them to detect that the scene on disk has changed.
// Index and frames of fire simulations are not included: a running simulation still adds to them.
// Plain values; any thread.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>

#include "runtime/core/file_stamp.hpp"
#include "runtime/core/result.hpp"

namespace luxodus {

/// Whether a file stays unchanged while a scene is open, or a running program still writes to it.
enum class FileLife { settled, grows };

class FilesAsRead {
 public:
  /// `before`: stamp of the file taken before it was hashed; without it the file is read at every
  /// check.
  void add(const std::string& path, uint64_t hash, FileStamp before = {}) {
    files_[path] = {hash, before};
  }
  /// The hash of a file that was added; nothing for others.
  std::optional<uint64_t> hash_of(const std::string& path) const;

  /// Errors: the first file that is not on the disk any more, or has other bytes there. Reads those
  /// whose stamps are others.
  Result<void> unchanged_on_disk() const;
  /// Errors: the first file that a later reading of the scene has found with other bytes.
  Result<void> unchanged_in(const FilesAsRead& later) const;

 private:
  struct File {
    uint64_t hash = 0;
    FileStamp stamp;
  };
  std::map<std::string, File> files_;  // by path
};

/// XXH3 of the bytes of a file. Errors: as open_regular_file; a failed read.
Result<uint64_t> hash_of_file(const std::string& path);

}  // namespace luxodus
