// Opens every file that a user names, without blocking and only if it is a regular file: a pipe or
// a terminal could block forever, and a device may deliver endless bytes or act when it is opened.
// Memory is never allocated beyond a limit. Any thread.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "runtime/core/file_descriptor.hpp"
#include "runtime/core/result.hpp"

namespace luxodus {

struct RegularFile {
  FileDescriptor descriptor;
  uint64_t bytes = 0;  // when it was opened
};

/// Opens a file for reading. Errors: not there, not readable, a folder, pipe, socket or device.
Result<RegularFile> open_regular_file(const std::filesystem::path& path);

/// The size of a file that can be read, for a reader that opens it by its name [bytes]. Errors: as
/// open_regular_file; "there is no such file" only where that is so.
Result<uint64_t> size_of_regular_file(const std::filesystem::path& path);

/// All bytes of a file. Errors: as open_regular_file; longer than `max_bytes`; a failed read.
Result<std::string> read_regular_file(const std::filesystem::path& path, uint64_t max_bytes);
/// All bytes of a binary file. Errors: those of read_regular_file.
Result<std::vector<std::byte>> read_whole_file(const std::filesystem::path& path,
                                               uint64_t max_bytes);

}  // namespace luxodus
