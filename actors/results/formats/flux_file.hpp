// The container of tallies: a JSON header and named blocks of bytes, each compressed and
// checksummed, and a checksum over the whole file. Blocks are returned as they were stored, or not
// at all; their meaning is the caller's. Equal content gives equal bytes (one compression level,
// one thread, no time stamps) for one version of the zstd library.
//
// Layout, little endian:
//   "LUXFLUX\0"  u32 version  u32 number of blocks
//   the header as a record with an empty name, then one record per block:
//     u32 length of name  u32 zero  u64 raw size  u64 packed size  16 bytes XXH3-128 of the raw
//     bytes name  zstd frame
//   16 bytes XXH3-128 of everything before
// Checksums stand in their canonical (big endian) form. They detect accidents, not forgery. Plain
// values; any thread.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/core/atomic_file.hpp"
#include "runtime/core/result.hpp"

namespace luxodus {

namespace limits {
inline constexpr uint32_t flux_file_version = 1;
inline constexpr uint32_t max_flux_blocks = 1u << 16;
inline constexpr uint32_t max_flux_name_bytes = 1024;
inline constexpr uint64_t max_flux_header_bytes = uint64_t{64} << 20;
/// Limit on the sum of all raw bytes, and on the file: what a machine with 64 GiB can still hold
/// twice.
inline constexpr uint64_t max_flux_bytes = uint64_t{32} << 30;
}  // namespace limits

struct Block {
  std::string name;  // unique in its file, not empty; any bytes
  std::vector<std::byte> bytes;
};

struct FluxFile {
  std::string header_json;
  std::vector<Block> blocks;  // their order is kept

  /// The block of that name, or nullptr.
  const Block* find(std::string_view name) const;
};

/// Errors: a name empty, too long or used twice; more than the limits above.
Result<std::vector<std::byte>> encode_flux_file(const FluxFile& file, const SourcePlace& place);
/// Errors: another kind of file, a newer version, cut short, corrupted (names the block), sizes
/// that exceed the given bytes. No memory is allocated for a size that was not checked.
Result<FluxFile> decode_flux_file(std::span<const std::byte> bytes, const SourcePlace& place);

/// Errors: as encode_flux_file and write_file_atomically.
Result<void> write_flux_file(const std::filesystem::path& path, const FluxFile& file);
/// Errors: as decode_flux_file and read_whole_file.
Result<FluxFile> read_flux_file(const std::filesystem::path& path);

}  // namespace luxodus
