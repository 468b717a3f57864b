#include "actors/apps/view/suggestions.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "actors/judge/design/suggest.hpp"

namespace luxodus {

namespace {

/// Time limit of the search: a viewer waits for it.
constexpr double search_seconds = 5;
/// Places of the map of help, the best first: as many as a page draws.
constexpr size_t max_helpful_places = 4000;

Json list_of_places(std::vector<HelpfulPlace> places) {
  std::stable_sort(places.begin(), places.end(),
                   [](const HelpfulPlace& a, const HelpfulPlace& b) { return a.share > b.share; });
  if (places.size() > max_helpful_places) places.resize(max_helpful_places);
  Json out = Json::array();
  for (const HelpfulPlace& one : places)
    out.push_back({{"position", vector_json(one.position)}, {"share", number_json(one.share)}});
  return out;
}

std::string words_for(const Suggestion& found) {
  const size_t count = found.luminaires.size();
  switch (found.end) {
    case LayoutEnd::infeasible:
      return "no luminaires of these types at these places would pass the rules";
    case LayoutEnd::unknown:
      return "none was found in this time";
    default:
      if (count == 0) return "what is there holds what the rules ask of luminaires";
      return fmt::format("{} more would do{}", count,
                         found.bound >= static_cast<double>(count)
                             ? ", and no fewer"
                             : fmt::format("; fewer than {:.0f} would not", found.bound));
  }
}

}  // namespace

Json suggestion(const SceneDescription& scene, const SceneEdits& edits,
                const std::vector<std::string>& free, const LiveOptions& options,
                const std::atomic<bool>& interrupt) {
  const auto refused = [](const std::string& why) -> Json {
    return {{"type", "refused"}, {"why", why}, {"suggestion", true}};
  };
  for (const std::string& name : free)
    if (std::none_of(edits.added.begin(), edits.added.end(), [&](const SceneEdits::Copy& copy) {
          return copy.name == name && !copy.is_sign;
        }))
      return refused("only luminaires that were added in this view need not stay, and \"" + name +
                     "\" was not");
  auto now = live_description(scene, edits);
  if (!now) return refused(now.problem().what);
  std::erase_if(now->emitters, [&](const Emitter& e) {
    return std::find(free.begin(), free.end(), e.name) != free.end();
  });
  SuggestOptions asked;
  asked.seconds = search_seconds;
  asked.threads = options.threads;
  const auto found =
      suggest(std::make_shared<const SceneDescription>(std::move(now).value()), asked, interrupt);
  if (!found) return refused(found.problem().what);
  Json luminaires = Json::array();
  for (const SuggestedLuminaire& one : found->luminaires)
    luminaires.push_back({{"of", one.of},
                          {"position", vector_json(one.position)},
                          {"facing", vector_json(one.aim)}});
  return {{"type", "suggested"},
          {"luminaires", std::move(luminaires)},
          {"instead_of", free},
          {"least", number_json(found->least)},
          {"missing", number_json(found->missing)},
          {"helpful", list_of_places(found->helpful)},
          {"words", words_for(found.value())}};
}

}  // namespace luxodus
