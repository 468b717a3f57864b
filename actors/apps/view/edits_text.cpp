#include "actors/apps/view/edits_text.hpp"

#include "actors/results/formats/json_out.hpp"

namespace luxodus {

namespace {

using Moves = std::map<std::string, SceneEdits::Move>;

Json moves_json(const Moves& moves) {
  Json out = Json::object();
  for (const auto& [name, move] : moves) {
    Json one = {{"position", vector_json(move.position)}};
    if (move.facing) one["facing"] = vector_json(*move.facing);
    out[name] = std::move(one);
  }
  return out;
}

Json copies_json(const std::vector<SceneEdits::Copy>& copies) {
  Json out = Json::array();
  for (const SceneEdits::Copy& copy : copies)
    out.push_back({{"is_sign", copy.is_sign},
                   {"of", copy.of},
                   {"name", copy.name},
                   {"of_type", copy.of_type}});
  return out;
}

// The library throws for missing members and other types, which is caught below.

glm::dvec3 read_vector(const Json& list) {
  return {list.at(0).get<double>(), list.at(1).get<double>(), list.at(2).get<double>()};
}

Moves read_moves(const Json& object) {
  Moves out;
  for (const auto& [name, one] : object.items()) {
    SceneEdits::Move& move = out[name];
    move.position = read_vector(one.at("position"));
    if (one.contains("facing")) move.facing = read_vector(one.at("facing"));
  }
  return out;
}

}  // namespace

std::string edits_text(const SceneEdits& edits) {
  const Json object = {
      {"scenario", edits.scenario},        {"smoke", edits.smoke},
      {"signs", moves_json(edits.signs)},  {"luminaires", moves_json(edits.luminaires)},
      {"added", copies_json(edits.added)}, {"at_s", edits.at_s ? Json(*edits.at_s) : Json()}};
  return object.dump();
}

Result<SceneEdits> parse_edits(std::string_view text) {
  if (text.size() > limits::edits_bytes) return problem("a wish is at most 1 MiB");
  try {
    const Json object = Json::parse(text);
    SceneEdits out;
    out.scenario = object.at("scenario").get<std::string>();
    out.smoke = object.at("smoke").get<double>();
    out.signs = read_moves(object.at("signs"));
    out.luminaires = read_moves(object.at("luminaires"));
    for (const Json& one : object.at("added"))
      out.added.push_back({one.at("is_sign").get<bool>(), one.at("of").get<std::string>(),
                           one.at("name").get<std::string>(), one.at("of_type").get<bool>()});
    if (const Json& at = object.at("at_s"); !at.is_null()) out.at_s = at.get<double>();
    return out;
  } catch (const Json::exception& e) {
    return problem(std::string("this is no wish of a live view: ") + e.what());
  }
}

}  // namespace luxodus
