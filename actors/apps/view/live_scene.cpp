#include "actors/apps/view/live_scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <set>

#include "runtime/core/output_text.hpp"
#include "scenes/light/geometry/transform.hpp"
#include "scenes/light/signs/onset.hpp"
#include "scenes/light/signs/sign_colours.hpp"
#include "scenes/light/signs/sign_light.hpp"
#include "scenes/light/world/design.hpp"
#include "scenes/light/world/measurements.hpp"

namespace luxodus {

namespace {

/// Small batches, so that every group gets its first light soon.
constexpr int64_t live_batch_particles = 1024;

/// Signs face along their z, luminaires along their -z.
using Aim = Result<Frame> (*)(const glm::dvec3& origin, const glm::dvec3& direction,
                              const glm::dvec3& up);

Result<Frame> moved(const Frame& frame, const SceneEdits::Move& move, Aim aim) {
  if (move.facing) return aim(move.position, *move.facing, {0, 0, 1});
  Frame out = frame;
  out.origin = move.position;
  return out;
}

std::string numbers(const glm::dvec3& v) {
  return "[" + shortest_number(v.x) + ", " + shortest_number(v.y) + ", " + shortest_number(v.z) +
         "]";
}

template <class List>
auto named(const List& list, const std::string& name) {
  const auto at =
      std::find_if(list.begin(), list.end(), [&](const auto& one) { return one.name == name; });
  return at == list.end() ? nullptr : &*at;
}

/// Adds a copy of an element; false if it is null.
template <class Thing>
bool add_copy(std::vector<Thing>& list, const Thing* original, const std::string& name) {
  if (original == nullptr) return false;
  Thing added = *original;
  added.name = name;
  list.push_back(std::move(added));
  return true;
}

/// "exit" of "exit copy" and of "exit copy 2".
std::string without_count(const std::string& name) {
  constexpr std::string_view word = " copy";
  const size_t at = name.rfind(word);
  if (at == std::string::npos || at == 0) return name;
  const std::string rest = name.substr(at + word.size());
  const bool counted = rest.size() > 1 && rest.front() == ' ' &&
                       rest.find_first_not_of("0123456789", 1) == std::string::npos;
  return rest.empty() || counted ? name.substr(0, at) : name;
}

}  // namespace

std::string group_of_luminaire(const std::string& name) {
  return name;
}
std::string group_of_sign(const std::string& name) {
  return "sign " + name;
}
std::string group_of_flame(const std::string& medium) {
  return "flame " + medium;
}

const Emitter* luminaire_to_copy(const SceneDescription& scene, const SceneEdits::Copy& copy) {
  if (!copy.of_type) return named(scene.emitters, copy.of);
  const DesignType* const type = scene.design ? named(scene.design->types, copy.of) : nullptr;
  return type != nullptr && type->stated ? &type->emitter : nullptr;
}

const Sign* sign_to_copy(const SceneDescription& scene, const SceneEdits::Copy& copy) {
  if (!copy.of_type) return named(scene.signs, copy.of);
  const DesignSignType* const type =
      scene.design ? named(scene.design->sign_types, copy.of) : nullptr;
  return type != nullptr && type->stated ? &type->sign : nullptr;
}

Result<SceneDescription> live_description(const SceneDescription& scene, const SceneEdits& edits) {
  SceneDescription out = scene;
  clear_measurements(out);
  out.run.batch_particles = live_batch_particles;
  out.run.groups = GroupRule::by_circuit;  // a named group wins over the circuit
  for (const SceneEdits::Copy& copy : edits.added)
    if (!(copy.is_sign ? add_copy(out.signs, sign_to_copy(out, copy), copy.name)
                       : add_copy(out.emitters, luminaire_to_copy(out, copy), copy.name)))
      return problem_in(scene.file, "there is no \"" + copy.of + "\" to copy");
  for (Emitter& e : out.emitters) {
    e.group = group_of_luminaire(e.name);
    if (const auto move = edits.luminaires.find(e.name); move != edits.luminaires.end()) {
      auto frame = moved(e.frame, move->second, frame_aiming);
      if (!frame) return frame.problem();
      e.frame = frame.value();
    }
  }
  for (Sign& sign : out.signs) {
    sign.group = group_of_sign(sign.name);
    if (const auto move = edits.signs.find(sign.name); move != edits.signs.end()) {
      auto frame = moved(sign.frame, move->second, frame_facing);
      if (!frame) return frame.problem();
      sign.frame = frame.value();
    }
  }
  for (Medium& medium : out.media)
    if (medium.emission) medium.emission->group = group_of_flame(medium.name);
  return out;
}

Result<SceneDescription> dimmed_description(const SceneDescription& scene, const SceneEdits& edits,
                                            const std::map<std::string, double>& factors) {
  auto out = live_description(scene, edits);
  if (!out) return out;
  const auto factor_of = [&](const std::string& group) {
    const auto at = factors.find(group);
    return at == factors.end() ? 1.0 : at->second;
  };
  for (Emitter& e : out->emitters) {
    const double factor = factor_of(e.group);
    e.mains_flux *= factor;
    e.emergency_flux *= factor;
  }
  for (Sign& sign : out->signs) {
    scale_luminances(sign, factor_of(sign.group));
  }
  for (Medium& medium : out->media)
    if (medium.emission) medium.emission->power_w *= factor_of(medium.emission->group);
  return out;
}

std::optional<double> seconds_said(const Scenario& scenario) {
  if (scenario.operation == Operation::mains || !scenario.says_seconds) return std::nullopt;
  return scenario.seconds_after_failure;
}

std::map<std::string, double> shares_after(const SceneDescription& scene, Operation operation,
                                           std::optional<double> seconds) {
  std::map<std::string, double> out;
  if (!seconds || operation == Operation::mains) return out;
  for (const Emitter& e : scene.emitters)
    if (!e.onset.empty() || e.duration_s)
      out[group_of_luminaire(e.name)] = emergency_share(e, *seconds);
  for (const Sign& sign : scene.signs)
    if (is_exhausted(sign.duration_s, *seconds)) out[group_of_sign(sign.name)] = 0;
  for (const Sign& sign : scene.signs)
    if (const double first = decay_share(sign.decay, 0); !sign.decay.empty() && first > 0)
      out[group_of_sign(sign.name)] = decay_share(sign.decay, *seconds) / first;
  return out;
}

namespace {

/// The requested scenario with its smoke. The effect of time on its light is in factors.
Result<Scenario> live_scenario(const SceneDescription& scene, const SceneEdits& edits) {
  auto scenario = find_scenario(scene, edits.scenario);
  if (!scenario) return scenario;
  Scenario& state = scenario.value();
  state.smoke_factor *= edits.smoke;
  for (Scenario::Factor& medium : state.media) medium.factor *= edits.smoke;
  state.seconds_after_failure = 0;
  state.says_seconds = false;
  return scenario;
}

}  // namespace

Result<std::shared_ptr<const CompiledScene>> compile_live(const SceneDescription& scene,
                                                          const SceneEdits& edits) {
  auto description = live_description(scene, edits);
  if (!description) return description.problem();
  const auto scenario = live_scenario(scene, edits);
  if (!scenario) return scenario.problem();
  CompileOptions options;
  options.bands_of = &scene;
  return compile_scene(std::make_shared<SceneDescription>(std::move(description).value()),
                       scenario.value(), options);
}

Result<std::shared_ptr<const CompiledScene>> compile_dimmed(
    const SceneDescription& scene, const SceneEdits& edits,
    const std::map<std::string, double>& factors) {
  auto description = dimmed_description(scene, edits, factors);
  if (!description) return description.problem();
  for (Emitter& e : description->emitters) e.group.clear();
  for (Sign& sign : description->signs) sign.group.clear();
  for (Medium& medium : description->media)
    if (medium.emission) medium.emission->group.clear();
  description->run.groups = GroupRule::one;
  description->run.batch_particles = scene.run.batch_particles;
  const auto scenario = live_scenario(scene, edits);
  if (!scenario) return scenario.problem();
  return compile_scene(std::make_shared<SceneDescription>(std::move(description).value()),
                       scenario.value(), {});
}

std::string name_for_copy(const SceneDescription& scene, const SceneEdits& edits,
                          const std::string& of, bool of_type) {
  // Groups are identified by name, and a luminaire's may equal that of a sign.
  std::set<std::string> taken;
  const auto take = [&](const std::string& name, const std::string& group) {
    taken.insert(name);
    taken.insert(group);
  };
  for (const Sign& sign : scene.signs) take(sign.name, group_of_sign(sign.name));
  for (const Emitter& e : scene.emitters) take(e.name, group_of_luminaire(e.name));
  for (const Medium& medium : scene.media) take(medium.name, group_of_flame(medium.name));
  for (const SceneEdits::Copy& copy : edits.added)
    take(copy.name, copy.is_sign ? group_of_sign(copy.name) : group_of_luminaire(copy.name));
  const std::string first = of_type ? of : without_count(of) + " copy";
  std::string name = first;
  for (int i = 2; taken.count(name) + taken.count(group_of_sign(name)) > 0; ++i)
    name = first + " " + std::to_string(i);
  return name;
}

std::string variant_text(const SceneDescription& scene, const SceneEdits& edits,
                         const std::map<std::string, double>& factors, const std::string& name) {
  const std::string original = std::filesystem::absolute(scene.file).string();
  std::string out = "# A variant that was made in a live view.\ntitle = \"" +
                    (scene.title.empty() ? scene.name : scene.title) + ": " + name +
                    "\"\ninclude = [\"" + original + "\"]\n";
  const auto change = [&](const char* kind, const std::string& of, const std::string& copy,
                          const SceneEdits::Move* move, double factor) {
    out += fmt::format("\n[[change]]\nkind = \"{}\"\nof = \"{}\"\n", kind, of);
    if (!copy.empty()) out += "copy = \"" + copy + "\"\n";
    if (move != nullptr) out += "position = " + numbers(move->position) + "\n";
    if (move != nullptr && move->facing) out += "facing = " + numbers(*move->facing) + "\n";
    if (factor != 1) out += "factor = " + shortest_number(factor) + "\n";
  };
  const auto factor_of = [&](const std::string& group) {
    const auto at = factors.find(group);
    return at == factors.end() ? 1.0 : at->second;
  };
  const auto move_of = [](const auto& moves, const std::string& of) {
    const auto at = moves.find(of);
    return at == moves.end() ? nullptr : &at->second;
  };
  // First of all: copies start from the unchanged original.
  for (const SceneEdits::Copy& copy : edits.added) {
    const auto& moves = copy.is_sign ? edits.signs : edits.luminaires;
    const auto group = copy.is_sign ? group_of_sign(copy.name) : group_of_luminaire(copy.name);
    const char* const kind = copy.of_type ? (copy.is_sign ? "design_sign" : "design_type")
                             : copy.is_sign ? "sign"
                                            : "luminaire";
    change(kind, copy.of, copy.name, move_of(moves, copy.name), factor_of(group));
  }
  for (const Emitter& e : scene.emitters) {
    const double factor = factor_of(group_of_luminaire(e.name));
    const auto* move = move_of(edits.luminaires, e.name);
    if (move != nullptr || factor != 1) change("luminaire", e.name, "", move, factor);
  }
  for (const Sign& sign : scene.signs) {
    const double factor = factor_of(group_of_sign(sign.name));
    const auto* move = move_of(edits.signs, sign.name);
    if (move != nullptr || factor != 1) change("sign", sign.name, "", move, factor);
  }
  // The grids of one fire simulation share a name.
  std::set<std::string> media;
  for (const Medium& medium : scene.media)
    if (edits.smoke != 1 && media.insert(medium.name).second)
      out += fmt::format("\n[[change]]\nkind = \"medium\"\nof = \"{}\"\nfactor = {}\n", medium.name,
                         shortest_number(edits.smoke));
  return out;
}

}  // namespace luxodus
