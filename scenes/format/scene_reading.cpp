#include "scenes/format/scene_reading.hpp"

#include <unistd.h>
#include <xxhash.h>

#include <algorithm>
#include <array>

#include "runtime/core/printable.hpp"
#include "runtime/core/regular_file.hpp"

namespace luxodus {

void SceneReading::problem(SourcePlace where, std::string what) {
  Problem p{std::move(where), std::move(what)};
  if (problems_.size() >= scene_limits::problems || !said_.insert(p.text()).second) return;
  if (std::find(files_.begin(), files_.end(), p.where.file) == files_.end()) {
    files_.push_back(p.where.file);
  }
  problems_.push_back(std::move(p));
  if (problems_.size() == scene_limits::problems) {
    problems_.push_back({problems_.back().where, "more problems follow; the first " +
                                                     std::to_string(scene_limits::problems) +
                                                     " are shown"});
  }
}

void SceneReading::warning(SourcePlace where, std::string what) {
  scene.warnings.push_back({std::move(where), std::move(what)});
}

Problems SceneReading::take_problems() {
  const auto rank = [this](const Problem& p) {
    const auto file = std::find(files_.begin(), files_.end(), p.where.file) - files_.begin();
    return std::pair(file, p.where.line);
  };
  std::stable_sort(problems_.begin(), problems_.end(),
                   [&](const Problem& a, const Problem& b) { return rank(a) < rank(b); });
  Problems out;
  for (Problem& p : problems_) out.add(std::move(p));
  problems_.clear();
  return out;
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
  std::vector<std::string> known;
  if (const auto it = names_.find(kind); it != names_.end()) {
    for (const auto& [k, unused] : it->second) known.push_back(k);
  }
  std::string what = "there is no " + std::string(kind) + " '" + excerpt(name) + "'";
  if (const auto near = nearest_word(name, known)) {
    what += "; did you mean '" + *near + "'?";
  } else if (known.empty()) {
    what += "; this scene has none at all";
  } else if (known.size() <= 12) {
    what += "; known:";
    for (const auto& k : known) what += " '" + k + "'";
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
  // Chained by the seed: the hash of a file depends on all files before it and on their borders.
  scene.content_hash = XXH3_64bits_withSeed(bytes.data(), bytes.size(), scene.content_hash);
}

std::optional<Problem> SceneReading::hash_file(const std::filesystem::path& path) {
  if (!hashed_.insert(path.lexically_normal().string()).second) return std::nullopt;
  auto file = open_regular_file(path);
  if (!file) return file.problem();
  const std::unique_ptr<XXH3_state_t, decltype(&XXH3_freeState)> state(XXH3_createState(),
                                                                       &XXH3_freeState);
  XXH3_64bits_reset_withSeed(state.get(), scene.content_hash);
  std::array<char, 65536> part;
  ssize_t n = 0;
  while ((n = ::read(file->descriptor.number(), part.data(), part.size())) > 0)
    XXH3_64bits_update(state.get(), part.data(), static_cast<size_t>(n));
  if (n < 0) return Problem{{path.string(), 0}, "this file cannot be read"};
  scene.content_hash = XXH3_64bits_digest(state.get());
  return std::nullopt;
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

int edit_distance(std::string_view a, std::string_view b) {
  // Optimal string alignment: three rows suffice, the swap looks two rows back.
  std::vector<int> before(b.size() + 1), above(b.size() + 1), row(b.size() + 1);
  for (size_t j = 0; j <= b.size(); ++j) above[j] = static_cast<int>(j);
  for (size_t i = 1; i <= a.size(); ++i) {
    row[0] = static_cast<int>(i);
    for (size_t j = 1; j <= b.size(); ++j) {
      const int change = a[i - 1] == b[j - 1] ? 0 : 1;
      row[j] = std::min({above[j] + 1, row[j - 1] + 1, above[j - 1] + change});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1]) {
        row[j] = std::min(row[j], before[j - 2] + 1);
      }
    }
    std::swap(before, above);
    std::swap(above, row);
  }
  return above[b.size()];
}

std::optional<std::string> nearest_word(std::string_view word,
                                        const std::vector<std::string>& known) {
  // Words longer than any key are no slips of the pen; the bound also keeps the search cheap.
  if (word.size() > scene_limits::name_chars) return std::nullopt;
  const std::string* best = nullptr;
  int least = static_cast<int>(word.size()) / 3 + 1;
  for (const std::string& k : known) {
    const int d = edit_distance(word, k);
    if (d < least || (d == least && !best)) {
      least = d;
      best = &k;
    }
  }
  return best ? std::optional(*best) : std::nullopt;
}

}  // namespace luxodus
