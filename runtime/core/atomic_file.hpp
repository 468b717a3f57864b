// Whole files in, whole files out. A file written here is either the old one or the new one, also
// after a full disk, a crash or a power cut: the bytes go to a temporary name in the same folder,
// are synced, and take the target's name in one rename. Every failure is a Problem with the path
// and the system's reason. Any thread; two writers of one path do not disturb each other, the later
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

/// A file that is written piece by piece, and is there only once it is whole: without commit() it
/// leaves no trace. The first piece that cannot be written is told by commit().
class AtomicFile {
 public:
  /// Errors: as write_file_atomically.
  static Result<AtomicFile> create(const std::filesystem::path& path);
  AtomicFile(AtomicFile&&) noexcept;
  ~AtomicFile();

  /// Behind what was written last by this.
  void write(std::span<const std::byte> bytes);
  /// At a place of the file, such as a head that is known at the end.
  void write_at(uint64_t offset, std::span<const std::byte> bytes);
  /// Makes it the target. To be called once, and nothing after it.
  Result<void> commit();

 private:
  struct State;
  explicit AtomicFile(std::unique_ptr<State> state);
  static int finish(State& state);

  std::unique_ptr<State> state_;
};

/// Replaces or makes the file `path`, keeping its permissions. What is no regular file (a symbolic
/// link, a folder, a device) is refused, and so is a folder that is a link: see output_path.hpp.
/// Errors: the folder is missing or not writable, no space, a name the system does not take. The
/// old file is then untouched and no temporary file is left.
Result<void> write_file_atomically(const std::filesystem::path& path,
                                   std::span<const std::byte> bytes);
Result<void> write_file_atomically(const std::filesystem::path& path, std::string_view text);

}  // namespace luxodus
