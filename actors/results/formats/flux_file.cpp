// Reads the records in order, so that a message can name the damaged block; the whole-file checksum
// comes last and covers what the records do not (names, reserved fields). Every size is compared
// with the remaining bytes and the limits before it is used.
#include "actors/results/formats/flux_file.hpp"

#include <xxhash.h>
#include <zstd.h>

#include <array>
#include <cstring>
#include <set>

#include "runtime/core/output_text.hpp"
#include "runtime/core/printable.hpp"
#include "runtime/core/regular_file.hpp"

namespace luxodus {
namespace {

constexpr std::array<char, 8> magic = {'L', 'U', 'X', 'F', 'L', 'U', 'X', '\0'};
// Level 3 is zstd's default; 9 takes three times as long and saves a few per cent of float data.
constexpr int compression_level = 3;
constexpr size_t start_bytes = 16;
constexpr size_t checksum_bytes = 16;
constexpr size_t record_bytes = 4 + 4 + 8 + 8 + checksum_bytes;
// A zstd block yields at most 128 KiB and takes at least 4 bytes (RFC 8878, 3.1.1.2): no frame
// expands by more than this.
constexpr uint64_t max_expansion = (128u << 10) / 4;

using Checksum = std::array<std::byte, checksum_bytes>;

Checksum checksum(std::span<const std::byte> bytes) {
  XXH128_canonical_t canonical;
  XXH128_canonicalFromHash(&canonical, XXH3_128bits(bytes.data(), bytes.size()));
  Checksum out;
  std::memcpy(out.data(), canonical.digest, out.size());
  return out;
}

template <class Unsigned>
void put(std::vector<std::byte>& out, Unsigned value) {
  for (size_t i = 0; i < sizeof value; ++i) out.push_back(static_cast<std::byte>(value >> (8 * i)));
}

void put_bytes(std::vector<std::byte>& out, std::span<const std::byte> bytes) {
  out.insert(out.end(), bytes.begin(), bytes.end());
}

template <class Unsigned>
Unsigned get(std::span<const std::byte> bytes, size_t at) {
  Unsigned value = 0;
  for (size_t i = 0; i < sizeof value; ++i) {
    value |= static_cast<Unsigned>(std::to_integer<Unsigned>(bytes[at + i]) << (8 * i));
  }
  return value;
}

std::string called(std::string_view name) {
  return name.empty() ? "the header" : "block '" + excerpt(name) + "'";
}

std::span<const std::byte> bytes_of(std::string_view text) {
  return std::as_bytes(std::span(text.data(), text.size()));
}

/// Appends one record. Errors: zstd's message (out of memory).
Result<void> put_record(std::vector<std::byte>& out, std::string_view name,
                        std::span<const std::byte> raw, const SourcePlace& place) {
  std::vector<std::byte> packed(ZSTD_compressBound(raw.size()));
  const size_t size =
      ZSTD_compress(packed.data(), packed.size(), raw.data(), raw.size(), compression_level);
  if (ZSTD_isError(size)) {
    return problem_in(place, "cannot compress " + called(name) + ": " + ZSTD_getErrorName(size),
                      ProblemKind::system);
  }
  packed.resize(size);
  put(out, static_cast<uint32_t>(name.size()));
  put(out, uint32_t{0});
  put(out, static_cast<uint64_t>(raw.size()));
  put(out, static_cast<uint64_t>(packed.size()));
  put_bytes(out, checksum(raw));
  put_bytes(out, bytes_of(name));
  put_bytes(out, packed);
  return {};
}

/// Reads records one after another from untrusted bytes.
class RecordReader {
 public:
  RecordReader(std::span<const std::byte> bytes, const SourcePlace& place)
      : bytes_(bytes), place_(place) {}

  /// The next record. `which`: what messages call it until its name is known.
  Result<Block> next(const std::string& which);
  uint64_t left() const { return bytes_.size() - at_; }

 private:
  Problem cut_short(const std::string& what) const {
    return {place_, "this file is cut short: it ends before the end of " + what +
                        "; copy it again or compute it anew"};
  }
  Problem damaged(const std::string& what, const std::string& how) const {
    return {place_,
            "this file is damaged: " + what + " " + how + "; copy it again or compute it anew"};
  }
  Result<std::vector<std::byte>> unpack(const std::string& what, uint64_t raw_size,
                                        uint64_t packed_size) const;

  std::span<const std::byte> bytes_;
  SourcePlace place_;
  size_t at_ = 0;
  uint64_t raw_total_ = 0;
};

Result<Block> RecordReader::next(const std::string& which) {
  if (left() < record_bytes) return cut_short(which);
  const auto name_size = get<uint32_t>(bytes_, at_);
  const auto reserved = get<uint32_t>(bytes_, at_ + 4);
  const auto raw_size = get<uint64_t>(bytes_, at_ + 8);
  const auto packed_size = get<uint64_t>(bytes_, at_ + 16);
  Checksum expected;
  std::memcpy(expected.data(), bytes_.data() + at_ + 24, expected.size());
  at_ += record_bytes;
  if (reserved != 0) return damaged(which, "has a field that must be zero and is not");
  if (name_size > limits::max_flux_name_bytes) return damaged(which, "has an absurdly long name");
  if (left() < name_size) return cut_short(which);
  Block block;
  block.name.assign(reinterpret_cast<const char*>(bytes_.data() + at_), name_size);
  at_ += name_size;
  const std::string what = which == "the header" ? which : called(block.name);

  if (packed_size > left()) return cut_short(what);
  if (raw_size > limits::max_flux_bytes - raw_total_ || raw_size > packed_size * max_expansion ||
      (which == "the header" && raw_size > limits::max_flux_header_bytes)) {
    return damaged(what, "claims " + std::to_string(raw_size) + " bytes, more than it can hold");
  }
  raw_total_ += raw_size;
  Result<std::vector<std::byte>> raw = unpack(what, raw_size, packed_size);
  if (!raw) return raw.problem();
  if (checksum(raw.value()) != expected) return damaged(what, "does not match its checksum");
  block.bytes = std::move(raw).value();
  at_ += static_cast<size_t>(packed_size);
  return block;
}

Result<std::vector<std::byte>> RecordReader::unpack(const std::string& what, uint64_t raw_size,
                                                    uint64_t packed_size) const {
  const std::byte* packed = bytes_.data() + at_;
  const auto size = static_cast<size_t>(packed_size);
  // Compared before memory is allocated: both sizes must agree, and one frame fills the record.
  if (ZSTD_getFrameContentSize(packed, size) != raw_size ||
      ZSTD_findFrameCompressedSize(packed, size) != size) {
    return damaged(what, "is not compressed as its record says");
  }
  std::vector<std::byte> raw(static_cast<size_t>(raw_size));
  const size_t got = ZSTD_decompress(raw.data(), raw.size(), packed, size);
  if (ZSTD_isError(got)) {
    return damaged(what, std::string("cannot be decompressed (") + ZSTD_getErrorName(got) + ")");
  }
  if (got != raw.size()) return damaged(what, "is shorter than its record says");
  return raw;
}

Result<void> check_names(const FluxFile& file, const SourcePlace& place) {
  std::set<std::string_view> names;
  for (const Block& block : file.blocks) {
    if (block.name.empty())
      return problem_in(place, "a block of a flux file needs a name", ProblemKind::bug);
    if (block.name.size() > limits::max_flux_name_bytes) {
      return problem_in(place,
                        called(block.name) + " has too long a name; the most is " +
                            std::to_string(limits::max_flux_name_bytes) + " bytes",
                        ProblemKind::bug);
    }
    if (!names.insert(block.name).second) {
      return problem_in(place, called(block.name) + " is there twice; names must differ",
                        ProblemKind::bug);
    }
  }
  return {};
}

/// The magic, the version and the number of blocks.
Result<uint32_t> read_start(std::span<const std::byte> bytes, const SourcePlace& place) {
  const size_t compared = std::min(bytes.size(), magic.size());
  if (bytes.empty() || std::memcmp(bytes.data(), magic.data(), compared) != 0) {
    return problem_in(place, "this is not a flux file: it does not begin with LUXFLUX");
  }
  if (bytes.size() < start_bytes + checksum_bytes) {
    return problem_in(place,
                      "this file is cut short: it ends before the end of its start; "
                      "copy it again or compute it anew");
  }
  const auto version = get<uint32_t>(bytes, 8);
  if (version > limits::flux_file_version) {
    return problem_in(place, "this flux file has version " + std::to_string(version) +
                                 ", this program reads up to " +
                                 std::to_string(limits::flux_file_version) +
                                 "; use a newer program or compute the file anew");
  }
  if (version == 0) return problem_in(place, "this file is damaged: it has version 0");
  const auto blocks = get<uint32_t>(bytes, 12);
  if (blocks > limits::max_flux_blocks) {
    return problem_in(place,
                      "this file is damaged: it claims " + std::to_string(blocks) + " blocks");
  }
  return blocks;
}

}  // namespace

const Block* FluxFile::find(std::string_view name) const {
  for (const Block& block : blocks) {
    if (block.name == name) return &block;
  }
  return nullptr;
}

Result<std::vector<std::byte>> encode_flux_file(const FluxFile& file, const SourcePlace& place) {
  if (Result<void> named = check_names(file, place); !named) return named.problem();
  if (file.blocks.size() > limits::max_flux_blocks) {
    return problem_in(
        place, "a flux file holds at most " + std::to_string(limits::max_flux_blocks) + " blocks");
  }
  if (file.header_json.size() > limits::max_flux_header_bytes) {
    return problem_in(place, "the header of a flux file is too long");
  }
  uint64_t total = file.header_json.size();
  for (const Block& block : file.blocks) total += block.bytes.size();
  if (total > limits::max_flux_bytes) {
    return problem_in(
        place, std::to_string(total) + " bytes are too much for one flux file (the most is " +
                   std::to_string(limits::max_flux_bytes) + "); use larger patches or voxels");
  }
  std::vector<std::byte> out;
  put_bytes(out, bytes_of({magic.data(), magic.size()}));
  put(out, limits::flux_file_version);
  put(out, static_cast<uint32_t>(file.blocks.size()));
  if (auto done = put_record(out, "", bytes_of(file.header_json), place); !done) {
    return done.problem();
  }
  for (const Block& block : file.blocks) {
    if (auto done = put_record(out, block.name, block.bytes, place); !done) return done.problem();
  }
  put_bytes(out, checksum(out));
  return out;
}

Result<FluxFile> decode_flux_file(std::span<const std::byte> bytes, const SourcePlace& place) {
  const Result<uint32_t> blocks = read_start(bytes, place);
  if (!blocks) return blocks.problem();
  const auto content = bytes.first(bytes.size() - checksum_bytes);
  RecordReader reader(content.subspan(start_bytes), place);
  Result<Block> header = reader.next("the header");
  if (!header) return header.problem();
  FluxFile file;
  file.header_json.assign(reinterpret_cast<const char*>(header->bytes.data()),
                          header->bytes.size());
  for (uint32_t i = 0; i < blocks.value(); ++i) {
    Result<Block> block =
        reader.next("block " + std::to_string(i + 1) + " of " + std::to_string(blocks.value()));
    if (!block) return block.problem();
    file.blocks.push_back(std::move(block).value());
  }
  if (reader.left() != 0) {
    return problem_in(place,
                      "this file is damaged: it goes on after its last block; "
                      "copy it again or compute it anew");
  }
  const Checksum sum = checksum(content);
  if (!header->name.empty() ||
      std::memcmp(sum.data(), bytes.data() + content.size(), sum.size()) != 0) {
    return problem_in(place,
                      "this file is damaged: it does not match the checksum at its end; "
                      "copy it again or compute it anew");
  }
  if (Result<void> named = check_names(file, place); !named) return named.problem();
  return file;
}

Result<void> write_flux_file(const std::filesystem::path& path, const FluxFile& file) {
  Result<std::vector<std::byte>> bytes = encode_flux_file(file, {path.string(), 0});
  if (!bytes) return bytes.problem();
  return write_file_atomically(path, std::span<const std::byte>(bytes.value()));
}

Result<FluxFile> read_flux_file(const std::filesystem::path& path) {
  Result<std::vector<std::byte>> bytes = read_whole_file(path, limits::max_flux_bytes);
  if (!bytes) return bytes.problem();
  return decode_flux_file(bytes.value(), {path.string(), 0});
}

}  // namespace luxodus
