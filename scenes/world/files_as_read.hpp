// The files that a scene was read from, each with a hash of its bytes: what goes on with a scene
// for long, and reads states of it at other times, tells by them that the scene on the disk is
// another one now. Frames of fire simulations are not among them: a simulation that still runs adds
// to them. Plain values; any thread.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>

#include "runtime/core/result.hpp"

namespace luxodus {

class FilesAsRead {
 public:
  void add(const std::string& path, uint64_t hash) { hashes_[path] = hash; }
  /// The hash of a file that was added; none of others.
  std::optional<uint64_t> hash_of(const std::string& path) const;

  /// The first file that is not on the disk any more, or has other bytes there. Reads all of them.
  std::optional<Problem> change_on_disk() const;
  /// The first file that a later reading of the scene has found with other bytes.
  std::optional<Problem> change_in(const FilesAsRead& later) const;

 private:
  std::map<std::string, uint64_t> hashes_;  // by path
};

/// XXH3 of the bytes of a file. Errors: as open_regular_file; a failed read.
Result<uint64_t> hash_of_file(const std::string& path);

}  // namespace luxodus
