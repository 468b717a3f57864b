#include "actors/apps/view/page_message.hpp"

#include <algorithm>
#include <cmath>

#include "actors/apps/view/edit_history.hpp"
#include "actors/results/formats/json_out.hpp"

namespace luxodus {

namespace {

constexpr int64_t max_id = int64_t{1} << 53;

/// Reads one object's members; keeps the first error.
class Members {
 public:
  explicit Members(const Json& object) : object_(object) {}

  double number(const char* key, double low, double high) {
    const Json* const value = find(key);
    if (value == nullptr || !value->is_number()) return refuse(key, "a number"), low;
    const double v = value->get<double>();
    if (!(v >= low && v <= high)) refuse(key, "within its range");
    return v;
  }
  int64_t whole(const char* key, int64_t most) {
    const Json* const value = find(key);
    if (value == nullptr || !value->is_number_integer()) return refuse(key, "a whole number"), 0;
    const double v = value->get<double>();
    if (!(v >= 0 && v <= static_cast<double>(most))) return refuse(key, "within its range"), 0;
    return value->get<int64_t>();
  }
  bool flag(const char* key) {
    const Json* const value = find(key);
    if (value == nullptr || !value->is_boolean()) return refuse(key, "true or false"), false;
    return value->get<bool>();
  }
  std::string text(const char* key) {
    const Json* const value = find(key);
    if (value == nullptr || !value->is_string()) return refuse(key, "a text"), std::string();
    auto text = value->get<std::string>();
    if (text.empty() || text.size() > limits::view_name_chars)
      refuse(key, "a text of 1 to 200 bytes");
    return text;
  }
  glm::dvec3 vector(const char* key) {
    const Json* const value = find(key);
    glm::dvec3 out(0);
    if (value == nullptr || !value->is_array() || value->size() != 3)
      return refuse(key, "a list of three numbers"), out;
    for (int i = 0; i < 3; ++i) {
      const Json& one = (*value)[static_cast<size_t>(i)];
      if (!one.is_number() || !(std::abs(one.get<double>()) <= 1e7))
        return refuse(key, "a list of three numbers within 1e7"), out;
      out[i] = one.get<double>();
    }
    return out;
  }
  std::vector<std::string> texts(const char* key, size_t most) {
    const Json* const value = find(key);
    if (value == nullptr || !value->is_array() || value->size() > most)
      return refuse(key, "a list of texts that is not too long"), std::vector<std::string>();
    std::vector<std::string> out;
    for (const Json& one : *value) {
      auto text = one.is_string() ? one.get<std::string>() : std::string();
      if (text.empty() || text.size() > limits::view_name_chars)
        return refuse(key, "a list of texts of 1 to 200 bytes"), std::vector<std::string>();
      out.push_back(std::move(text));
    }
    return out;
  }
  bool is_sign(const char* key) {
    const std::string kind = text(key);
    if (kind != "sign" && kind != "luminaire") refuse(key, "\"sign\" or \"luminaire\"");
    return kind == "sign";
  }
  /// Records what a member should be; keeps the first error.
  void refuse(const char* key, const char* should) {
    if (problem_.empty()) problem_ = std::string("\"") + key + "\" must be " + should;
  }
  bool has(const char* key) const { return object_.contains(key) && !object_[key].is_null(); }
  const std::string& problem() const { return problem_; }

 private:
  const Json* find(const char* key) const {
    const auto at = object_.find(key);
    return at == object_.end() ? nullptr : &*at;
  }

  const Json& object_;
  std::string problem_;
};

MoveEdit read_move(Members& m) {
  MoveEdit out;
  out.is_sign = m.is_sign("kind");
  out.name = m.text("name");
  out.position = m.vector("position");
  if (m.has("facing")) out.facing = m.vector("facing");
  return out;
}

AddEdit read_add(Members& m) {
  AddEdit out;
  out.is_sign = m.is_sign("kind");
  out.of = m.text("of");
  if (m.has("of_type")) out.of_type = m.flag("of_type");
  out.position = m.vector("position");
  if (m.has("facing")) out.facing = m.vector("facing");
  return out;
}

RenderAsk read_render(Members& m) {
  RenderAsk out;
  out.id = m.whole("id", max_id);
  out.eye = m.vector("eye");
  out.target = m.vector("target");
  out.up = m.vector("up");
  if (out.eye == out.target) m.refuse("target", "another place than the eye");
  if (out.up == glm::dvec3(0)) m.refuse("up", "a direction");
  out.vertical_fov_deg = m.number("fov", 1, 170);
  out.width = static_cast<int>(m.whole("width", limits::view_picture_pixels));
  out.height = static_cast<int>(m.whole("height", limits::view_picture_pixels));
  if (std::min(out.width, out.height) < limits::min_view_picture_edge ||
      int64_t{out.width} * out.height > limits::view_picture_pixels)
    m.refuse("width", "16 at least, as \"height\", and both together 524288 pixels at most");
  out.human = m.flag("human");
  return out;
}

std::optional<PageMessage> read_message(const std::string& type, Members& m) {
  if (type == "factor")
    return FactorEdit{m.text("group"), m.number("factor", 0, limits::max_view_factor)};
  if (type == "scenario") return ScenarioEdit{m.text("name")};
  if (type == "smoke") return SmokeEdit{m.number("factor", 0, limits::max_view_smoke)};
  if (type == "state")
    return StateEdit{m.number("at", -limits::max_view_seconds, limits::max_view_seconds)};
  if (type == "time")
    return m.has("seconds") ? TimeEdit{m.number("seconds", 0, limits::max_view_seconds)}
                            : TimeEdit{};
  if (type == "move") return read_move(m);
  if (type == "add") return read_add(m);
  if (type == "remove") return RemoveEdit{m.text("name")};
  if (type == "save") return SaveEdit{m.text("name")};
  if (type == "history") return HistoryEdit{m.whole("done", limits::view_steps)};
  if (type == "edit") return EditWish{m.flag("wanted")};
  if (type == "probe")
    return ProbeAsk{m.whole("id", max_id),
                    static_cast<uint32_t>(m.whole("triangle", UINT32_MAX)), m.flag("front")};
  if (type == "judge") return JudgeAsk{m.text("sign"), m.has("id") ? m.whole("id", max_id) : 0};
  if (type == "render") return read_render(m);
  if (type == "stop_render") return RenderStop{};
  if (type == "checks") return ChecksAsk{m.has("id") ? m.whole("id", max_id) : 0};
  if (type == "suggest") return SuggestAsk{m.texts("free", limits::view_added)};
  return std::nullopt;
}

}  // namespace

Result<PageMessage> decode_page_message(std::string_view text) {
  if (text.size() > limits::page_message_bytes) return problem("a message is at most 64 KiB");
  // Not recursive: a text of brackets only would overflow the stack.
  int depth = 0;
  for (const char c : text) {
    if (c == '[' || c == '{') ++depth;
    if (depth > 64) return problem("a message has at most 64 brackets");
  }
  const Json object = Json::parse(text);
  if (!object.is_object() || !object.contains("type") || !object["type"].is_string())
    return problem("a message is a JSON object with a type");
  Members members(object);
  const auto type = object["type"].get<std::string>();
  auto message = read_message(type, members);
  if (!message) return problem("there is no message of this type");
  if (!members.problem().empty()) return problem(members.problem());
  return std::move(*message);
}

bool is_edit(const PageMessage& message) {
  return !std::holds_alternative<EditWish>(message) && !std::holds_alternative<ProbeAsk>(message) &&
         !std::holds_alternative<JudgeAsk>(message) &&
         !std::holds_alternative<RenderAsk>(message) &&
         !std::holds_alternative<RenderStop>(message) &&
         !std::holds_alternative<SuggestAsk>(message) &&
         !std::holds_alternative<ChecksAsk>(message);
}

}  // namespace luxodus
