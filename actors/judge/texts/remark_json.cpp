#include "actors/judge/texts/remark_json.hpp"

#include <algorithm>

#include "actors/results/formats/json_out.hpp"

namespace luxodus {

Json remark_json(const Remark& remark) {
  Json arguments = Json::array();
  for (const RemarkArgument& one : remark.arguments)
    std::visit([&](const auto& value) { arguments.push_back(Json(value)); }, one);
  return {{"id", kind_of(remark.id).name},
          {"args", std::move(arguments)},
          {"text", english().remark(remark)}};
}

Json subject_json(const Subject& subject) {
  Json out = {{"kind", name_of(subject.kind)}, {"name", subject.name}};
  if (subject.kind == SubjectKind::emphasis)
    out["emphasis"] = emphasis_words.at(static_cast<size_t>(subject.emphasis));
  out["text"] = english().subject(subject);
  return out;
}

Result<Remark> read_remark(const Json& json) {
  if (!json.is_object()) return problem("a remark is not a table");
  const std::string name = text_in(json, "id");
  const auto kinds = remark_kinds();
  const auto kind = std::find_if(kinds.begin(), kinds.end(),
                                 [&](const RemarkKind& one) { return one.name == name; });
  if (kind == kinds.end()) return problem("the \"id\" of a remark is \"" + name + "\": unknown");
  const auto arguments = json.find("args");
  if (arguments == json.end() || !arguments->is_array() || arguments->size() != arity_of(*kind))
    return problem("the \"args\" of the remark \"" + name + "\" are not as many as it has");
  Remark out{kind->id};
  for (const Json& one : *arguments) {
    if (one.is_number())
      out.arguments.emplace_back(one.get<double>());
    else if (one.is_string())
      out.arguments.emplace_back(one.text());
    else
      return problem("an argument of the remark \"" + name + "\" is neither a text nor a number");
  }
  return out;
}

Result<Subject> read_subject(const Json& json) {
  if (!json.is_object()) return problem("a subject is not a table");
  const std::string kind = text_in(json, "kind");
  size_t number = 0;
  constexpr auto count = static_cast<size_t>(SubjectKind::count);
  while (number < count && name_of(static_cast<SubjectKind>(number)) != kind) ++number;
  if (number == count) return problem("the \"kind\" of a subject is \"" + kind + "\": unknown");
  Subject out{static_cast<SubjectKind>(number)};
  out.name = text_in(json, "name");
  if (out.kind != SubjectKind::emphasis) return out;
  const auto word =
      std::find(emphasis_words.begin(), emphasis_words.end(), text_in(json, "emphasis"));
  if (word == emphasis_words.end()) return problem("a point of emphasis is of no kind");
  out.emphasis = static_cast<EmphasisKind>(word - emphasis_words.begin());
  return out;
}

}  // namespace luxodus
