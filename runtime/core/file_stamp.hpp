// Tells from a file's metadata whether it has changed, without reading it again. Any thread.
#pragma once

#include <cstdint>
#include <string>

namespace luxodus {

/// Metadata of a file. Equal stamps mean equal bytes, unless the file was written so shortly before
/// the first stamp that a later write got the same time.
struct FileStamp {
  uint64_t device = 0, inode = 0, bytes = 0;
  int64_t changed_ns = 0;  // ctime, which every write changes and no program can set
  bool sure = false;       // the last write is older than the clock's resolution

  bool same_as(const FileStamp& later) const {
    return sure && device == later.device && inode == later.inode && bytes == later.bytes &&
           changed_ns == later.changed_ns;
  }
};

/// Stamp of an open file. If it cannot be read, the stamp is that of no file, and not sure.
FileStamp stamp_of(int descriptor);
FileStamp stamp_at(const std::string& path);

}  // namespace luxodus
