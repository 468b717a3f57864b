// Atomic replacement of files. A file written here is either the old one or the new one, even after
// a full disk, a crash or a power cut: the bytes go to a temporary name in the same folder, are
// synced, and take the target's name in one rename. Every failure is a Problem with the path and
// the system's reason. Any thread; two writers of one path do not disturb each other, the later
// rename wins.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "runtime/core/result.hpp"

namespace luxodus {

/// A file that is written piece by piece and appears only when it is complete: without commit() it
/// leaves no trace. commit() reports the first write that failed.
class AtomicFile {
 public:
  /// Errors: those of write_file_atomically.
  static Result<AtomicFile> create(const std::filesystem::path& path);
  AtomicFile(AtomicFile&&) noexcept;
  ~AtomicFile();

  /// Appends to what write() wrote before.
  void write(std::span<const std::byte> bytes);
  /// Writes at an offset, such as a header that is known only at the end.
  void write_at(uint64_t offset, std::span<const std::byte> bytes);
  /// Replaces the target. Call it once, as the last call.
  Result<void> commit();

 private:
  struct State;
  explicit AtomicFile(std::unique_ptr<State> state);
  static int finish(State& state);

  std::unique_ptr<State> state_;
};

/// Replaces or makes the file `path` and keeps its permissions. A target that is not a regular file
/// (a symbolic link, a folder, a device) is rejected, and so is a folder that is a link: see
/// output_path.hpp. Errors: the folder is missing or not writable, no space, an invalid name. The
/// old file is then untouched and no temporary file is left.
Result<void> write_file_atomically(const std::filesystem::path& path,
                                   std::span<const std::byte> bytes);
Result<void> write_file_atomically(const std::filesystem::path& path, std::string_view text);

}  // namespace luxodus
