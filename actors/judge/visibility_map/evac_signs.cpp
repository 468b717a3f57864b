#include "actors/judge/visibility_map/evac_signs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "runtime/core/regular_file.hpp"
#include "scenes/emergency/smoke_laws.hpp"

namespace luxodus {

namespace {

namespace fs = std::filesystem;

/// Sections of a config.json that may have signs, in the order in which they are read.
constexpr const char* sections[] = {"exits", "checkpoints", "waypoints"};
/// Jin's constant of a sign that states none.
constexpr int default_constant = 3;
/// Cosine of the largest angle between the directions of one sign in both programs.
constexpr double same_direction = 0.7;

glm::dvec2 direction_of(double alpha_deg) {
  const double alpha = alpha_deg * std::numbers::pi / 180;
  return {std::sin(alpha), std::cos(alpha)};
}

/// The double next to a decimal of so many parts of one: the other program compares numbers
/// exactly with those that people have written.
double rounded(double value, double parts) {
  return std::round(value * parts) / parts + 0.0;
}

std::optional<size_t> sign_of(const EvacSign& wanted, const std::vector<const Sign*>& signs) {
  for (size_t s = 0; s < signs.size(); ++s)
    if (signs[s]->name == wanted.node) return s;
  std::optional<size_t> best;
  double nearest = same_sign_m;
  for (size_t s = 0; s < signs.size(); ++s) {
    const Frame& frame = signs[s]->frame;
    const double along = glm::dot(glm::dvec2(frame.axes[2]), direction_of(wanted.alpha_deg));
    const double distance = glm::length(glm::dvec2(frame.origin) - wanted.place);
    if ((signs[s]->double_sided ? std::abs(along) : along) < same_direction || distance > nearest)
      continue;
    nearest = distance;
    best = s;
  }
  return best;
}

/// False, 0, "" and empty lists count as no sign there.
bool says_something(const Json& value) {
  if (value.is_null() || (value.is_structured() && value.empty())) return false;
  if (value.is_boolean()) return value.get<bool>();
  if (value.is_number()) return value.get<double>() != 0;
  return !value.is_string() || !value.get<std::string>().empty();
}

/// Throws Json::exception if a value is missing or of another kind.
EvacSign evac_sign(const std::string& node, const Json& sign) {
  EvacSign out;
  out.node = node;
  out.place = {sign.at("x").get<double>(), sign.at("y").get<double>()};
  out.alpha_deg = sign.at("alpha").get<double>();
  const Json constant = sign.contains("c") ? sign.at("c") : Json(default_constant);
  out.description = Json::array();
  for (const Json& value : {Json(node), sign.at("x"), sign.at("y"), sign.at("alpha"), constant})
    out.description.push_back(value);
  return out;
}

/// An id that comes again replaces the sign, and keeps the place of the first.
void take(EvacSign sign, std::vector<EvacSign>& out) {
  const auto same = std::find_if(out.begin(), out.end(),
                                 [&](const EvacSign& one) { return one.node == sign.node; });
  if (same != out.end())
    *same = std::move(sign);
  else
    out.push_back(std::move(sign));
}

Result<std::vector<EvacSign>> signs_in(const Json& config, const fs::path& file) {
  std::vector<EvacSign> out;
  for (const char* section : sections) {
    const auto nodes = config.find(section);
    if (nodes == config.end() || !nodes->is_object()) continue;
    for (const auto& [node, data] : nodes->items()) {
      const auto sign = data.is_object() ? data.find("sign") : data.end();
      if (!data.is_object() || sign == data.end() || !says_something(*sign)) continue;
      if (out.size() == limits::evac_signs)
        return problem_in(file, 0, fmt::format("more than {} signs", limits::evac_signs));
      try {
        take(evac_sign(node, *sign), out);
      } catch (const Json::exception& e) {
        return problem_in(file, 0,
                          fmt::format("the sign of \"{}\" in \"{}\" needs the numbers x, y and "
                                      "alpha: {}",
                                      node, section, e.what()));
      }
    }
  }
  return out;
}

}  // namespace

Result<std::vector<EvacSign>> read_evac_signs(const fs::path& config,
                                              const std::vector<const Sign*>& signs) {
  const auto text = read_regular_file(config, limits::evac_config_bytes);
  if (!text) return text.problem();
  Json root;
  try {
    root = Json::parse(text.value());
  } catch (const Json::exception& e) {
    return problem_in(config, 0, std::string("this is no config.json: ") + e.what());
  }
  if (!root.is_object()) return problem_in(config, 0, "this is no config.json: no JSON object");
  auto out = signs_in(root, config);
  if (!out) return out.problem();
  if (out->empty())
    return problem_in(config, 0,
                      "no exit, checkpoint or waypoint has a \"sign\" with x, y and alpha");
  for (EvacSign& one : out.value()) {
    const auto sign = sign_of(one, signs);
    if (!sign)
      return problem_in(
          config, 0,
          fmt::format("the sign of \"{}\" at ({:g}, {:g}), alpha {:g}, is none of the map: no sign "
                      "has this name, and none hangs within {:g} m and faces the same way",
                      one.node, one.place.x, one.place.y, one.alpha_deg, same_sign_m));
    one.sign = *sign;
  }
  return out;
}

std::vector<EvacSign> evac_signs_of(const std::vector<const Sign*>& signs) {
  std::vector<EvacSign> out;
  for (size_t s = 0; s < signs.size(); ++s) {
    const Frame& frame = signs[s]->frame;
    const glm::dvec2 facing(frame.axes[2]);
    double alpha = std::atan2(facing.x, facing.y) * 180 / std::numbers::pi;
    if (alpha < 0) alpha += 360;
    EvacSign one;
    one.node = signs[s]->name;
    one.place = {rounded(frame.origin.x, 1000), rounded(frame.origin.y, 1000)};
    one.alpha_deg = std::fmod(rounded(alpha, 10), 360);
    one.sign = s;
    one.description = Json::array();
    for (const Json& value : {Json(one.node), Json(one.place.x), Json(one.place.y),
                              Json(one.alpha_deg), Json(jin_constant(signs[s]->lighting))})
      one.description.push_back(value);
    out.push_back(std::move(one));
  }
  return out;
}

std::optional<std::string> fds_folder_of(const EvacRun& run, const SceneDescription& scene) {
  fs::path folder = run.fds_folder;
  if (folder.empty())
    for (const Medium& medium : scene.media)
      if (medium.simulation && !medium.simulation->index.empty()) {
        folder = fs::path(medium.simulation->index).parent_path();
        if (folder.empty()) folder = ".";
        break;
      }
  if (folder.empty()) return std::nullopt;
  std::error_code error;
  const fs::path resolved = fs::weakly_canonical(fs::absolute(folder, error), error);
  std::string text = (error ? folder : resolved).string();
  while (text.size() > 1 && text.back() == '/') text.pop_back();
  return text;
}

Json evac_meta(const EvacRun& run, const std::string& fds_folder,
               const std::vector<EvacSign>& signs) {
  Json waypoints = Json::array();
  for (const EvacSign& sign : signs) waypoints.push_back(sign.description);
  return {{"fds_dir", fds_folder},
          {"waypoints", std::move(waypoints)},
          {"time_step_s", run.reroute_interval_s},
          {"slice_height_m", run.slice_height_m}};
}

std::string evac_words(const EvacRun& run, const std::optional<std::string>& fds_folder,
                       const std::string& file) {
  if (!fds_folder)
    return fmt::format(
        "pyFDS-Evac will NOT take {}: no fire simulation is known by which it could tell that the "
        "file is for its case; give --evac-fds-dir. It would compute anew and overwrite the file",
        file);
  const std::string how =
      fmt::format("--fds-dir {} --reroute-interval {:g} --smoke-slice-height {:g} --vis-cache {}",
                  *fds_folder, run.reroute_interval_s, run.slice_height_m, file);
  std::error_code error;
  const std::string absent =
      fs::is_directory(*fds_folder, error)
          ? ""
          : fmt::format(" (there is no folder {} on this machine)", *fds_folder);
  if (run.config.empty())
    return fmt::format(
        "whether pyFDS-Evac will take {} is not known: it compares the signs of its config.json "
        "with those of the file, which have the names, places and Jin's constants of the scene; "
        "give --evac-config. It has to be run with {}{}, else it computes anew and overwrites the "
        "file",
        file, how, absent);
  return fmt::format(
      "pyFDS-Evac will take {} for {} if it is run with {}{}; else it computes anew "
      "and overwrites the file",
      file, run.config, how, absent);
}

}  // namespace luxodus
