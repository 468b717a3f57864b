#include "actors/judge/validate/experiment.hpp"

#include <algorithm>
#include <cctype>

namespace luxodus::light {

namespace {

std::string in_lower_case(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

}  // namespace

Experiments all_experiments() {
  Experiments all;
  add_jin_experiments(all);
  add_sign_experiments(all);
  add_clear_air_experiments(all);
  return all;
}

Experiments experiments_named(const std::string& text) {
  const std::string wanted = in_lower_case(text);
  Experiments all = all_experiments();
  const bool is_id = std::any_of(all.begin(), all.end(), [&](const Experiment& one) {
    return in_lower_case(one.id) == wanted;
  });
  std::erase_if(all, [&](const Experiment& one) {
    const std::string id = in_lower_case(one.id);
    if (is_id) return id != wanted;
    return (id + " " + in_lower_case(one.title)).find(wanted) == std::string::npos;
  });
  return all;
}

}  // namespace luxodus::light
