#include "actors/cast/parts/profile_file.hpp"

#include <fmt/format.h>

#include <bit>
#include <cstring>

#include "actors/results/formats/flux_file.hpp"
#include "actors/results/formats/json_out.hpp"

namespace luxodus {

namespace {

constexpr int schema_version = 2;

Block block_of(const std::string& name, const std::vector<uint64_t>& values) {
  static_assert(std::endian::native == std::endian::little);
  Block block{name, std::vector<std::byte>(values.size() * sizeof(uint64_t))};
  if (!values.empty()) std::memcpy(block.bytes.data(), values.data(), block.bytes.size());
  return block;
}

void add_counts(FluxFile& file, const std::string& name, const ReferenceCounts& counts) {
  file.blocks.push_back(block_of(name + "/units", {static_cast<uint64_t>(counts.units)}));
  file.blocks.push_back(block_of(name + "/references", counts.references));
  file.blocks.push_back(block_of(name + "/visits", counts.visits));
}

std::string name_of_group(size_t group) {
  return "group " + std::to_string(group);
}

/// Reads blocks of known sizes; records the first invalid one.
class Blocks {
 public:
  Blocks(const FluxFile& file, size_t objects) : file_(file), objects_(objects) {}

  std::vector<uint64_t> take(const std::string& name, size_t count) {
    std::vector<uint64_t> values(count, 0);
    const Block* block = file_.find(name);
    if (block != nullptr && block->bytes.size() == count * sizeof(uint64_t))
      std::memcpy(values.data(), block->bytes.data(), block->bytes.size());
    else if (wrong_.empty())
      wrong_ = name;
    return values;
  }
  ReferenceCounts take_counts(const std::string& name) {
    ReferenceCounts counts;
    // Bounds the number, and keeps it usable as a divisor.
    counts.units = static_cast<int64_t>(take(name + "/units", 1)[0] & 0xFFFFFFFFFFFF);
    counts.references = take(name + "/references", objects_);
    counts.visits = take(name + "/visits", objects_);
    return counts;
  }
  const std::string& wrong() const { return wrong_; }

 private:
  const FluxFile& file_;
  size_t objects_;
  std::string wrong_;
};

}  // namespace

Result<void> write_profile(const std::filesystem::path& path, const ReferenceProfile& profile) {
  FluxFile file;
  file.header_json = Json{{"profile", schema_version},
                          {"scene_hash", fmt::format("{:016x}", profile.scene_hash)},
                          {"groups", profile.groups.size()},
                          {"objects", profile.objects()}}
                         .dump(1);
  for (size_t g = 0; g < profile.groups.size(); ++g)
    add_counts(file, name_of_group(g), profile.groups[g]);
  add_counts(file, "eyes", profile.eyes);
  file.blocks.push_back(block_of("built bytes", profile.built_bytes));
  return write_flux_file(path, file);
}

Result<ReferenceProfile> read_profile(const std::filesystem::path& path, const CompiledScene& scene,
                                      size_t objects) {
  auto file = read_flux_file(path);
  if (!file) return file.problem();
  const SourcePlace place{path.string(), 0};
  const Json header = Json::parse(file->header_json);
  if (!header.is_object() || header.value("profile", Json()) != Json(schema_version))
    return problem_in(place,
                      "this is no profile that this version reads: make it with `luxodus "
                      "profile`");
  if (header.value("scene_hash", Json()) != Json(fmt::format("{:016x}", scene.scene_hash)))
    return problem_in(place,
                      "this profile is of another scene, scenario or partition: make it anew with "
                      "`luxodus profile`");
  ReferenceProfile profile;
  profile.scene_hash = scene.scene_hash;
  Blocks blocks(file.value(), objects);
  for (size_t g = 0; g < scene.groups.size(); ++g)
    profile.groups.push_back(blocks.take_counts(name_of_group(g)));
  profile.eyes = blocks.take_counts("eyes");
  profile.built_bytes = blocks.take("built bytes", objects);
  if (!blocks.wrong().empty())
    return problem_in(place, "this profile lacks \"" + blocks.wrong() + "\", or has another size");
  return profile;
}

}  // namespace luxodus
