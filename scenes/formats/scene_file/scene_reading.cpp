#include "scenes/formats/scene_file/scene_reading.hpp"

#include <unistd.h>
#include <xxhash.h>

#include <algorithm>
#include <array>

#include "runtime/core/printable.hpp"
#include "runtime/core/regular_file.hpp"
#include "runtime/toml/words.hpp"

namespace luxodus {

void SceneReading::warning(SourcePlace where, std::string what) {
  scene.warnings.push_back({std::move(where), std::move(what)});
}

void SceneReading::note_for_reader(SourcePlace where, std::string what) {
  scene.notes.push_back({std::move(where), std::move(what)});
}

void SceneReading::declare(std::string_view kind, const std::string& name,
                           const SourcePlace& place) {
  auto& of_kind = names_.try_emplace(std::string(kind)).first->second;
  const auto [it, fresh] = of_kind.emplace(name, place);
  if (!fresh) {
    problem(place, "the " + std::string(kind) + " '" + excerpt(name) +
                       "' is defined twice; first at " + it->second.file + ":" +
                       std::to_string(it->second.line) + "; give one of them another name");
  }
}

void SceneReading::note(std::string_view kind, const std::string& name, const SourcePlace& place) {
  names_.try_emplace(std::string(kind)).first->second.emplace(name, place);
}

bool SceneReading::declared(std::string_view kind, const std::string& name) const {
  const auto it = names_.find(kind);
  return it != names_.end() && it->second.count(name) > 0;
}

bool SceneReading::require(std::string_view kind, const std::string& name,
                           const SourcePlace& place) {
  if (declared(kind, name)) return true;
  if (incomplete || !missed_.insert(std::string(kind) + "\n" + name).second) return false;
  std::vector<std::string_view> known;
  if (const auto it = names_.find(kind); it != names_.end()) {
    for (const auto& [k, unused] : it->second) known.push_back(k);
  }
  std::string what = "there is no " + std::string(kind) + " '" + excerpt(name) + "'";
  if (const auto near = toml::nearest_word(name, known)) {
    what += "; did you mean '" + std::string(*near) + "'?";
  } else if (known.empty()) {
    what += "; this scene has none at all";
  } else if (known.size() <= 12) {
    what += "; known:";
    for (const auto k : known) what += " '" + std::string(k) + "'";
  } else {
    what += " among the " + std::to_string(known.size()) + " of this scene";
  }
  problem(place, std::move(what));
  return false;
}

int SceneReading::material_index(const std::string& name, const SourcePlace& place) {
  for (; materials_indexed_ < scene.materials.size(); ++materials_indexed_) {
    material_at_.emplace(scene.materials[materials_indexed_].name,
                         static_cast<int>(materials_indexed_));
  }
  if (const auto it = material_at_.find(name); it != material_at_.end()) return it->second;
  const auto grey = named_grey(name);
  if (!grey && name != "open") {
    require("material", name, place);
    return 0;
  }
  Material m;
  m.name = name;
  m.place = place;
  m.kind = grey ? MaterialKind::lambertian : MaterialKind::open;
  m.reflectance = Spectrum::constant(grey.value_or(0));
  scene.materials.push_back(m);
  names_["material"].emplace(name, place);
  return static_cast<int>(scene.materials.size()) - 1;
}

int SceneReading::back_of(int material) const {
  const auto it = backs_.find(material);
  return it == backs_.end() || it->second.index < 0 ? material : it->second.index;
}

void SceneReading::set_back(int material, std::string name, SourcePlace place) {
  backs_[material] = {std::move(name), std::move(place), -1};
}

void SceneReading::resolve_backs() {
  for (auto& [unused, back] : backs_) back.index = material_index(back.name, back.place);
}

void SceneReading::hash_bytes(std::string_view bytes) {
  // Chained by the seed: the hash of a file depends on all earlier files and their boundaries.
  scene.content_hash = XXH3_64bits_withSeed(bytes.data(), bytes.size(), scene.content_hash);
}

Result<void> SceneReading::hash_file(const std::filesystem::path& path, FileLife life) {
  if (!hashed_.insert(path.lexically_normal().string()).second) return {};
  auto file = open_regular_file(path);
  if (!file) return file.problem();
  const FileStamp before = stamp_of(file->descriptor.number());
  using State = std::unique_ptr<XXH3_state_t, decltype(&XXH3_freeState)>;
  const State state(XXH3_createState(), &XXH3_freeState);
  const State own(XXH3_createState(), &XXH3_freeState);  // the hash of this file alone
  XXH3_64bits_reset_withSeed(state.get(), scene.content_hash);
  XXH3_64bits_reset(own.get());
  std::array<char, 65536> part;
  ssize_t n = 0;
  while ((n = ::read(file->descriptor.number(), part.data(), part.size())) > 0)
    for (const auto& each : {state.get(), own.get()})
      XXH3_64bits_update(each, part.data(), static_cast<size_t>(n));
  if (n < 0) return problem_in(path, "this file cannot be read", ProblemKind::system);
  scene.content_hash = XXH3_64bits_digest(state.get());
  if (life == FileLife::settled) files.add(path.string(), XXH3_64bits_digest(own.get()), before);
  return {};
}

std::optional<double> named_grey(std::string_view name) {
  for (const std::string_view stem : {"grey", "gray", "white", "black"}) {
    if (name.substr(0, stem.size()) != stem) continue;
    const std::string_view digits = name.substr(stem.size());
    if (digits.empty() || digits.size() > 3) return std::nullopt;
    int percent = 0;
    for (const char c : digits) {
      if (c < '0' || c > '9') return std::nullopt;
      percent = percent * 10 + (c - '0');
    }
    if (percent > 100) return std::nullopt;
    return percent / 100.0;
  }
  return std::nullopt;
}

}  // namespace luxodus
