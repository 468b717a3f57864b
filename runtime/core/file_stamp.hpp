// Whether a file is still what it was, by what the file system says of it: without reading it anew.
// Any thread.
#pragma once

#include <cstdint>
#include <string>

namespace luxodus {

/// What the file system says of a file. Two that are equal are of the same bytes, unless the file
/// had been written so shortly before the first that a later write has the same time.
struct FileStamp {
  uint64_t device = 0, inode = 0, bytes = 0;
  int64_t changed_ns = 0;  // of the status, which every write changes and no program sets
  bool sure = false;       // the file was last written well before

  bool same_as(const FileStamp& later) const {
    return sure && device == later.device && inode == later.inode && bytes == later.bytes &&
           changed_ns == later.changed_ns;
  }
};

/// Of an open file. A stamp that cannot be had is that of no file, and not sure.
FileStamp stamp_of(int descriptor);
FileStamp stamp_at(const std::string& path);

}  // namespace luxodus
