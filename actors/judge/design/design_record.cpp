#include "actors/judge/design/design_record.hpp"

#include <array>

#include "actors/judge/record/record_forms.hpp"

namespace luxodus {

template <>
inline constexpr size_t names_of<LayoutEnd> = 6;
template <>
inline constexpr size_t names_of<DemandKind> = 10;
template <>
inline constexpr size_t names_of<RaceEnd> = 4;
template <>  // places that are taken are no candidates that were left out
inline constexpr size_t members_to_list<LeftOut> = members_of<LeftOut>() - 1;

const char* name_of(LayoutEnd end) {
  constexpr std::array<const char*, names_of<LayoutEnd>> words{
      "optimal", "within the gap", "out of time", "interrupted", "infeasible", "unknown"};
  return words[static_cast<size_t>(end)];
}

const char* name_of(DemandKind kind) {
  constexpr std::array<const char*, names_of<DemandKind>> words{
      "minimum", "mean", "early", "spread", "two", "failed", "near", "vertical", "face", "flight"};
  return words[static_cast<size_t>(kind)];
}

Json design_json(const DesignRecord& record) {
  return json_of(record);
}

Result<DesignRecord> design_of(const Json& json) {
  if (text_in(json, "format") != design_format)
    return problem(std::string("its \"format\" is not \"") + design_format + "\"");
  DesignRecord out;
  if (auto ok = read_fields(json, out); !ok) return ok.problem();
  return out;
}

}  // namespace luxodus
