#include "scenes/formats/pack/scene_pack.hpp"

#include <sys/mman.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <numeric>

#include "runtime/core/atomic_file.hpp"
#include "runtime/core/hash.hpp"
#include "runtime/core/regular_file.hpp"
#include "scenes/formats/pack/skeleton.hpp"

namespace luxodus {

namespace {

constexpr std::array<char, 8> magic{'L', 'U', 'X', 'P', 'A', 'C', 'K', '\n'};
constexpr uint64_t alignment = 64;

struct Head {
  std::array<char, 8> magic;
  uint32_t version;
  uint32_t holds_objects;  // 0 or 1
  uint64_t file_bytes;
  uint64_t skeleton_offset;
  uint64_t skeleton_bytes;
  uint64_t skeleton_hash;
  std::array<uint64_t, 9> unused;
  uint64_t head_hash;  // hash of all fields before it
};
static_assert(sizeof(Head) == 128);

uint64_t hash_of(std::span<const std::byte> bytes) {
  return object_id_of(bytes).value;
}
uint64_t hash_of(const Head& head) {
  return hash_of(std::as_bytes(std::span(&head, 1)).first(offsetof(Head, head_hash)));
}
constexpr uint64_t aligned(uint64_t offset) {
  return (offset + alignment - 1) / alignment * alignment;
}

/// Counts what it writes, so that offsets are known.
class Writer {
 public:
  explicit Writer(AtomicFile file) : file_(std::move(file)) {}

  uint64_t at() const { return at_; }
  void write(std::span<const std::byte> bytes) {
    file_.write(bytes);
    at_ += bytes.size();
  }
  void align() {
    static constexpr std::array<std::byte, alignment> zeros{};
    write(std::span(zeros).first(aligned(at_) - at_));
  }
  /// Writes the skeleton after the objects, and the head before them.
  Result<uint64_t> end(std::span<const std::byte> skeleton, bool holds_objects) {
    Head head{magic, limits::pack_version, holds_objects ? 1u : 0u, 0,
              at_,   skeleton.size(),      hash_of(skeleton),       {},
              0};
    write(skeleton);
    head.file_bytes = at_;
    head.head_hash = hash_of(head);
    file_.write_at(0, std::as_bytes(std::span(&head, 1)));
    auto done = file_.commit();
    if (!done) return done.problem();
    return at_;
  }

 private:
  AtomicFile file_;
  uint64_t at_ = 0;
};

Result<Writer> begin(const std::filesystem::path& path) {
  auto file = AtomicFile::create(path);
  if (!file) return file.problem();
  Writer writer(std::move(file).value());
  const Head empty{};
  writer.write(std::as_bytes(std::span(&empty, 1)));
  return writer;
}

/// A mapped file: only pages that are accessed take memory.
class MappedPack final : public ObjectFile {
 public:
  static Result<std::shared_ptr<MappedPack>> open(const std::filesystem::path& path) {
    const auto failed = [&](const char* doing) { return system_problem(path, doing, errno); };
    auto file = open_regular_file(path);
    if (!file) return file.problem();
    void* at = MAP_FAILED;
    const uint64_t bytes = file->bytes;
    if (bytes >= sizeof(Head))
      at = ::mmap(nullptr, bytes, PROT_READ, MAP_SHARED, file->descriptor.number(), 0);
    if (bytes < sizeof(Head)) return problem_in(path, "this is no pack: it is too short");
    if (at == MAP_FAILED) return failed("cannot map this file");
    return std::shared_ptr<MappedPack>(
        new MappedPack(path.string(), {static_cast<const std::byte*>(at), bytes}));
  }
  ~MappedPack() override { ::munmap(const_cast<std::byte*>(bytes_.data()), bytes_.size()); }

  const std::string& name() const override { return name_; }
  std::span<const std::byte> object(uint32_t index) const override {
    if (places_.empty()) return {};
    return bytes_.subspan(places_[index].first, places_[index].second);
  }
  std::span<const std::byte> bytes() const { return bytes_; }
  /// Errors: objects that do not end where the skeleton begins.
  Result<void> place_objects(const PackedScene& packed, const Head& head) {
    uint64_t at = sizeof(Head);
    for (const PackedScene::Object& object : packed.objects) {
      if (object.wire_bytes == 0 || object.wire_bytes > head.skeleton_offset - at)
        return problem_in(name_, "the objects of this pack are not where they should be");
      places_.emplace_back(at, object.wire_bytes);
      at = aligned(at + object.wire_bytes);
      if (at > head.skeleton_offset)
        return problem_in(name_, "the objects of this pack are not where they should be");
    }
    return {};
  }

 private:
  MappedPack(std::string name, std::span<const std::byte> bytes)
      : name_(std::move(name)), bytes_(bytes) {}

  std::string name_;
  std::span<const std::byte> bytes_;
  std::vector<std::pair<uint64_t, uint64_t>> places_;  // offset and length; none without objects
};

/// The head of a mapped file, checked against the file's size.
Result<Head> head_of(const MappedPack& pack) {
  Head head{};
  std::memcpy(&head, pack.bytes().data(), sizeof head);
  const SourcePlace place{pack.name(), 0};
  if (head.magic != magic) return problem_in(place, "this is no pack of a scene");
  if (head.version != limits::pack_version) {
    return problem_in(place, "this pack has format " + std::to_string(head.version) +
                                 ", this program reads " + std::to_string(limits::pack_version) +
                                 ": pack the scene again");
  }
  if (head.head_hash != hash_of(head) || head.holds_objects > 1)
    return problem_in(place, "the head of this pack is damaged: pack the scene again");
  if (head.file_bytes != pack.bytes().size()) {
    return problem_in(place, "this pack has " + std::to_string(pack.bytes().size()) +
                                 " bytes and should have " + std::to_string(head.file_bytes) +
                                 ": copy it again");
  }
  if (head.skeleton_offset < sizeof(Head) || head.skeleton_offset > head.file_bytes ||
      head.skeleton_bytes != head.file_bytes - head.skeleton_offset ||
      head.skeleton_bytes > limits::max_skeleton_bytes)
    return problem_in(place, "the head of this pack is damaged: pack the scene again");
  return head;
}

/// Errors: bytes whose hash is not the head's.
Result<std::span<const std::byte>> skeleton_of(const MappedPack& pack, const Head& head) {
  const auto bytes = pack.bytes().subspan(head.skeleton_offset, head.skeleton_bytes);
  if (hash_of(bytes) != head.skeleton_hash)
    return problem_in(pack.name(), "the skeleton of this pack is damaged: copy it again");
  return bytes;
}

}  // namespace

void PackReport::add(ScenePart::Kind kind, uint64_t bytes) {
  ++objects;
  bricks += kind == ScenePart::Kind::brick ? 1 : 0;
  tiles += kind == ScenePart::Kind::tile ? 1 : 0;
  object_bytes += bytes;
  largest_object_bytes = std::max(largest_object_bytes, bytes);
}

Result<PackReport> write_pack(const std::filesystem::path& path, const CompiledScene& scene,
                              int partition, const std::function<bool(double)>& progress) {
  if (scene.triangles == 0)
    return problem_in(scene.description->file, "the scene has no triangles to pack");
  auto writer = begin(path);
  if (!writer) return writer.problem();
  const SceneParts parts(scene);
  PackedScene packed = summary_of(scene, parts, partition);
  PackReport report;
  for (size_t i = 0; i < parts.count(); ++i) {
    const std::vector<std::byte> bytes = encode_part(scene, parts[i]);
    packed.objects[i] = {object_id_of(bytes), bytes.size()};
    writer->write(bytes);
    writer->align();
    report.add(parts[i].kind, bytes.size());
    const double share = static_cast<double>(i + 1) / static_cast<double>(parts.count());
    if (progress && !progress(share)) return problem_in(path, "interrupted; nothing was written");
  }
  const std::vector<std::byte> skeleton = encode_skeleton(*scene.description, packed);
  auto bytes = writer->end(skeleton, true);
  if (!bytes) return bytes.problem();
  report.skeleton_bytes = skeleton.size();
  report.file_bytes = bytes.value();
  return report;
}

Result<PackReport> write_skeleton_pack(const std::filesystem::path& path,
                                       const std::filesystem::path& from) {
  auto pack = MappedPack::open(from);
  if (!pack) return pack.problem();
  auto head = head_of(*pack.value());
  if (!head) return head.problem();
  auto skeleton = skeleton_of(*pack.value(), head.value());
  if (!skeleton) return skeleton.problem();
  auto writer = begin(path);
  if (!writer) return writer.problem();
  auto bytes = writer->end(skeleton.value(), false);
  if (!bytes) return bytes.problem();
  return PackReport{bytes.value(), skeleton.value().size(), 0, 0, 0, 0, 0};
}

bool is_pack(const std::filesystem::path& path) {
  std::array<char, 8> begin{};
  const auto file = open_regular_file(path);
  return file.ok() &&
         ::read(file->descriptor.number(), begin.data(), begin.size()) == ssize_t{begin.size()} &&
         begin == magic;
}

Result<std::shared_ptr<const SceneDescription>> read_pack(const std::filesystem::path& path) {
  auto pack = MappedPack::open(path);
  if (!pack) return pack.problem();
  const auto head = head_of(*pack.value());
  if (!head) return head.problem();
  const auto bytes = skeleton_of(*pack.value(), head.value());
  if (!bytes) return bytes.problem();
  auto skeleton = decode_skeleton(bytes.value());
  if (!skeleton) return problem_in(path, skeleton.problem());
  auto packed = std::make_shared<PackedScene>(std::move(skeleton->packed));
  if (head->holds_objects == 1) {
    if (auto placed = pack.value()->place_objects(*packed, head.value()); !placed)
      return placed.problem();
  }
  packed->file = std::move(pack).value();
  auto description = std::make_shared<SceneDescription>(std::move(skeleton->description));
  description->packed = std::move(packed);
  return std::shared_ptr<const SceneDescription>(std::move(description));
}

}  // namespace luxodus
