// Plain values through a file descriptor, in the order they were put: for two processes of one
// program. The reader validates: no list is longer than the bytes that are left, and after the
// first missing value all others count as missing. Not a file format: layout and byte order are
// those of this build. Thread rule: one thread per object.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "runtime/core/file_descriptor.hpp"
#include "runtime/core/result.hpp"

namespace luxodus {

class PlainWriter {
 public:
  /// Writes to a descriptor that it does not own.
  explicit PlainWriter(int descriptor) : descriptor_(descriptor) {}

  template <class T>
  requires std::is_trivially_copyable_v<T>
  void put(const T& value) { add(std::as_bytes(std::span(&value, 1))); }
  template <class T>
  requires std::is_trivially_copyable_v<T>
  void put(const std::vector<T>& values) {
    put(static_cast<uint64_t>(values.size()));
    add(std::as_bytes(std::span(values)));
  }
  void put(const std::string& text) {
    put(static_cast<uint64_t>(text.size()));
    add(std::as_bytes(std::span(text.data(), text.size())));
  }
  void put(const Problem& problem);
  /// Writes what is still held back. False: not all could be written, now or before.
  bool flush();

 private:
  void add(std::span<const std::byte> bytes);

  int descriptor_;
  std::vector<std::byte> held_;
  bool failed_ = false;
};

class PlainReader {
 public:
  /// Reads a file from its beginning to its present end.
  explicit PlainReader(FileDescriptor file);

  /// Returns false, and leaves the value unchanged, if the remaining bytes do not hold it.
  template <class T>
  requires std::is_trivially_copyable_v<T>
  [[nodiscard]] bool get(T& value) { return take(std::as_writable_bytes(std::span(&value, 1))); }
  template <class T>
  requires std::is_trivially_copyable_v<T>
  [[nodiscard]] bool get(std::vector<T>& values) {
    uint64_t count = 0;
    if (!get(count) || count > left_ / sizeof(T)) return fail();
    std::vector<T> read(static_cast<size_t>(count));
    if (!take(std::as_writable_bytes(std::span(read)))) return false;
    values = std::move(read);
    return true;
  }
  [[nodiscard]] bool get(std::string& text);
  [[nodiscard]] bool get(Problem& problem);
  uint64_t left() const { return left_; }

 private:
  bool take(std::span<std::byte> to);
  bool fail();

  FileDescriptor file_;
  uint64_t at_ = 0;              // offset in the file
  uint64_t left_ = 0;            // bytes from there to the end
  std::vector<std::byte> held_;  // read-ahead buffer: most values are small
  size_t given_ = 0;             // bytes of held_ already returned
};

}  // namespace luxodus
