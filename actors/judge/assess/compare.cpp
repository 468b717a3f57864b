// Compares two assessments: what newly passes or fails, and which values differ significantly.
#include <fmt/format.h>

#include <cmath>
#include <map>

#include "actors/judge/assess/assessment_json.hpp"
#include "actors/judge/assess/state_words.hpp"
#include "actors/judge/texts/remark_json.hpp"

namespace luxodus {

namespace {

/// Differences below these count as none: in standard errors of the difference; for exact values as
/// a share.
constexpr double different_errors = 3, different_share = 1e-6;

using Key = std::string;

/// The edition is part of the key: two rule sets have a check each of the same rule.
Key check_key(const Json& check) {
  return fmt::format("{} ({}) {} {}", check["rule"].get<std::string>(),
                     check["edition"].get<std::string>(), english_in(check, "subject"),
                     english_in(check, "conditions"));
}

Key sight_key(const Json& sight) {
  return fmt::format("{}, {:.2f} m along, eye {:.2f} m, sign \"{}\"{}", english_in(sight, "from"),
                     sight["along"]["value"].get<double>(),
                     sight["eye_height"]["value"].get<double>(), sight["sign"].get<std::string>(),
                     sight["back_face"].get<bool>() ? " (back)" : "");
}

std::map<Key, const Json*> by_key(const Json& rows, Key (*key_of)(const Json&)) {
  std::map<Key, const Json*> out;
  for (const Json& row : rows) out.emplace(key_of(row), &row);
  return out;
}

/// Verdicts that differ; a row may be in one of the two only.
Json changed_verdicts(const Json& before, const Json& after, Key (*key_of)(const Json&)) {
  const auto old_rows = by_key(before, key_of), new_rows = by_key(after, key_of);
  Json out = Json::array();
  const auto verdict = [](const auto& rows, const Key& key) -> Json {
    const auto at = rows.find(key);
    return at == rows.end() ? Json() : (*at->second)["verdict"];
  };
  for (const auto& [key, row] : old_rows)
    if (const Json now = verdict(new_rows, key); now != (*row)["verdict"])
      out.push_back({{"what", key}, {"before", (*row)["verdict"]}, {"after", now}});
  for (const auto& [key, row] : new_rows)
    if (!old_rows.contains(key))
      out.push_back({{"what", key}, {"before", Json()}, {"after", (*row)["verdict"]}});
  return out;
}

Json changed_values(const Json& before, const Json& after) {
  const auto old_rows = by_key(before, check_key);
  Json out = Json::array();
  for (const Json& row : after) {
    const auto at = old_rows.find(check_key(row));
    if (at == old_rows.end() || !row["value"].is_number() || !(*at->second)["value"].is_number())
      continue;
    const double was = (*at->second)["value"].get<double>(), is = row["value"].get<double>();
    if (std::abs(is - was) <= different_share * std::max(std::abs(is), std::abs(was))) continue;
    out.push_back(
        {{"what", check_key(row)}, {"before", was}, {"after", is}, {"unit", row["unit"]}});
  }
  return out;
}

/// Visibility levels that differ significantly.
Json changed_levels(const Json& before, const Json& after) {
  const auto old_rows = by_key(before, sight_key);
  Json out = Json::array();
  for (const Json& row : after) {
    const auto at = old_rows.find(sight_key(row));
    if (at == old_rows.end() || !row.contains("reading_level") ||
        !at->second->contains("reading_level"))
      continue;
    const Json &was = (*at->second)["reading_level"], &is = row["reading_level"];
    if (!was["standard_error"].is_number() || !is["standard_error"].is_number()) continue;
    const double error =
        std::hypot(was["standard_error"].get<double>(), is["standard_error"].get<double>());
    const double change = is["value"].get<double>() - was["value"].get<double>();
    if (!(error > 0) || std::abs(change) < different_errors * error) continue;
    out.push_back({{"what", sight_key(row)},
                   {"before", was["value"]},
                   {"after", is["value"]},
                   {"standard_errors", change / error}});
  }
  return out;
}

/// A verdict or value; `where` says in which assessment it is missing.
std::string shown(const Json& value, const char* where) {
  if (value.is_null()) return std::string("not assessed ") + where;
  return value.is_string() ? value.get<std::string>() : fmt::format("{:.4g}", value.get<double>());
}

/// Differences of judged states and of verdicts on the whole. The place of a medium in its file
/// does not count.
Json changed_state(const Json& before, const Json& after) {
  const auto rows_of = [](Json assessment) {
    if (Json* const media = assessment.at_path("state/smoke/media"))
      for (Json& medium : *media) {
        medium.erase("place");
        medium.erase("notes");
      }
    std::map<std::string, std::string> out;
    for (const auto& [what, words] : state_rows(assessment))
      if (!what.empty() && what != "not assessed") out[what] = words;
    out["verdict"] = verdict_words(assessment);
    return out;
  };
  const auto was = rows_of(before), is = rows_of(after);
  Json out = Json::array();
  const auto add = [&](const std::string& what) {
    const auto a = was.find(what), b = is.find(what);
    const Json old_words = a == was.end() ? Json() : Json(a->second);
    const Json new_words = b == is.end() ? Json() : Json(b->second);
    if (old_words != new_words)
      out.push_back({{"what", what}, {"before", old_words}, {"after", new_words}});
  };
  for (const auto& [what, words] : was) add(what);
  for (const auto& [what, words] : is)
    if (!was.contains(what)) add(what);
  return out;
}

}  // namespace

Json comparison_of(const Json& before, const Json& after) {
  return {{"state", changed_state(before, after)},
          {"checks", changed_verdicts(before["checks"], after["checks"], check_key)},
          {"values", changed_values(before["checks"], after["checks"])},
          {"sights", changed_verdicts(before["sights"], after["sights"], sight_key)},
          {"levels", changed_levels(before["sights"], after["sights"])}};
}

std::string comparison_text(const Json& comparison) {
  std::string out;
  const auto part = [&](const char* key, const char* title) {
    const Json& rows = comparison[key];
    out += fmt::format("{}: {}\n", title, rows.size());
    for (const Json& row : rows) {
      out += fmt::format("  {}: {} -> {}", row["what"].get<std::string>(),
                         shown(row["before"], "before"), shown(row["after"], "after"));
      if (row.contains("unit") && row["unit"] != "1") out += " " + row["unit"].get<std::string>();
      if (row.contains("standard_errors"))
        out += fmt::format(" ({:+.1f} standard errors)", row["standard_errors"].get<double>());
      out += "\n";
    }
  };
  part("state", "what is said of the judged state, and of all checks, differently");
  part("checks", "checks whose verdict changed");
  part("values", "values of checks that changed");
  part("sights", "views of signs whose verdict changed");
  part("levels", "visibility levels that changed by three standard errors or more");
  return out;
}

}  // namespace luxodus
