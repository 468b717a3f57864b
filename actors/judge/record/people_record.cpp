#include "actors/judge/record/people_record.hpp"

#include <algorithm>

#include "runtime/core/regular_file.hpp"

namespace luxodus {

std::optional<double> PeopleAtTime::reading_share() const {
  if (present == 0) return std::nullopt;
  return static_cast<double>(reading) / static_cast<double>(present);
}

PeopleTotals totals_of(const std::vector<FollowedPerson>& people) {
  PeopleTotals out;
  for (const FollowedPerson& one : people) {
    out.read_s += one.read_s;
    out.undecided_s += one.undecided_s;
    out.all_s += one.read_s + one.undecided_s + one.unread_s;
    out.longest_unread_s = std::max(out.longest_unread_s, one.longest_unread_s);
    out.never += one.first_read_s ? 0 : 1;
  }
  return out;
}

Json followed_people_json(const FollowedPeople& people) {
  return json_of(people);
}

Result<FollowedPeople> read_followed_people(const std::filesystem::path& file) {
  const auto text = read_regular_file(file, limits::followed_people_bytes);
  if (!text) return text.problem();
  const Json json = Json::parse(text.value());
  if (!json.is_object() || json.value("format", Json()) != followed_people_format)
    return problem_in(file, std::string("is not a \"") + followed_people_format +
                                "\": make it anew by luxodus walk");
  FollowedPeople out;
  if (const auto ok = read_fields(json, out); !ok)
    return problem_in(file, ok.problem().what +
                                ": this file is damaged or of another version; make it anew by "
                                "luxodus walk");
  return out;
}

}  // namespace luxodus
