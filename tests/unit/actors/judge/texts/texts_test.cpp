// Texts of all languages are complete, have the same placeholders, and follow the customs of each.
#include "actors/judge/texts/texts.hpp"

#include <catch2/catch.hpp>
#include <set>

#include "actors/judge/texts/remark_json.hpp"

using namespace luxodus;

namespace {

constexpr Language languages[] = {Language::en, Language::de, Language::fr};

/// The placeholders of a text with their formats: "0", "1:.2f".
std::multiset<std::string> places_of(const std::string& text) {
  std::multiset<std::string> out;
  for (size_t from = text.find('{'); from != std::string::npos; from = text.find('{', from + 1))
    out.insert(text.substr(from + 1, text.find('}', from) - from - 1));
  return out;
}

std::string key_of(const RemarkKind& kind) {
  return "remark." + std::string(kind.name);
}

}  // namespace

TEST_CASE("every language has every text, with the same placeholders for names and numbers",
          "[texts]") {
  const auto& english = texts_of(Language::en);
  CHECK(english.size() > 500);
  for (const Language language : languages) {
    INFO(Texts(language).code());
    const auto& texts = texts_of(language);
    CHECK(texts.size() == english.size());
    for (const auto& [key, text] : english) {
      INFO(key);
      const auto at = texts.find(key);
      REQUIRE(at != texts.end());
      CHECK_FALSE(at->second.empty());
      CHECK(places_of(at->second) == places_of(text));
    }
  }
}

TEST_CASE("every kind of remark has a text that uses each of its arguments", "[texts]") {
  const auto& english = texts_of(Language::en);
  std::set<std::string> keys;
  for (size_t i = 0; i < remark_kinds().size(); ++i) {
    const RemarkKind& kind = remark_kinds()[i];
    INFO(kind.name);
    CHECK(static_cast<size_t>(kind.id) == i);
    CHECK(keys.insert(key_of(kind)).second);
    const auto at = english.find(key_of(kind));
    REQUIRE(at != english.end());
    std::set<std::string> arguments;
    for (const std::string& place : places_of(at->second))
      arguments.insert(place.substr(0, place.find(':')));
    CHECK(arguments.size() == arity_of(kind));
    for (size_t n = 0; n < arity_of(kind); ++n) CHECK(arguments.contains(std::to_string(n)));
  }
  // No text belongs to a remark that no longer exists.
  for (const auto& [key, text] : english)
    if (key.starts_with("remark.") && key != "remark.join") {
      INFO(key);
      CHECK(keys.contains(key));
    }
}

TEST_CASE("remarks keep names and write numbers in the format of the language", "[texts]") {
  const Texts en(Language::en), de(Language::de), fr(Language::fr);
  const Remark late = remark(RemarkId::after_mains_failure, 0.5);
  CHECK(en.remark(late) == "0.5 s after the mains have failed");
  CHECK(de.remark(late) == "0,5 s nach dem Netzausfall");
  CHECK(fr.remark(remark(RemarkId::points_in_bodies, 7, 351)) ==
        "7 points sur 351 se trouvent dans des corps et sont omis");
  const Remarks hidden{remark(RemarkId::nearest_luminaire, "north; lamp"),
                       remark(RemarkId::behind_something, "near", 1.25)};
  CHECK(en.remarks(hidden) ==
        "the nearest is \"north; lamp\"; \"near\" is 1.25 m away, but behind something solid, or "
        "shining elsewhere");
  CHECK(de.remarks(hidden) ==
        "die nächste ist „north; lamp“; „near“ ist 1,25 m entfernt, aber hinter etwas Festem oder "
        "anderswohin strahlend");
  CHECK(fr.say("views.undecided", fr.remark(remark(RemarkId::legible_or_not))) ==
        "indécis : lisible ou non : plus de chemins le diront (--rounds)");
}

TEST_CASE("subjects and clauses have texts in each language", "[texts]") {
  const Texts en(Language::en), de(Language::de);
  CHECK(en.subject({SubjectKind::route, "corridor"}) == "route \"corridor\"");
  CHECK(de.subject({SubjectKind::all_signs}) == "alle Zeichen");
  CHECK(de.subject({SubjectKind::emphasis, "lobby", EmphasisKind::first_aid}) ==
        "„lobby“ (Erste Hilfe)");
  Rule rule;
  rule.clause = "4.1.2";
  CHECK(de.clause(rule) == "4.1.2");
  rule.status = remark(RemarkId::carried_over);
  CHECK(de.clause(rule) == "4.1.2 von 2013");
}

TEST_CASE("a remark with a wrong number of arguments is rejected", "[texts]") {
  CHECK_THROWS(remark(RemarkId::points_in_bodies, 7));
  CHECK_THROWS(remark(RemarkId::no_value, "name"));
}

TEST_CASE("remarks and subjects are read back from JSON unchanged", "[texts][json]") {
  const Remarks remarks{remark(RemarkId::other_storey, "lamp", 1.5), remark(RemarkId::no_value)};
  for (const Remark& one : remarks) {
    const auto read = read_remark(remark_json(one));
    REQUIRE(read);
    CHECK(read.value() == one);
  }
  for (const Subject& subject : {Subject{SubjectKind::sign, "exit"}, Subject{SubjectKind::building},
                                 Subject{SubjectKind::emphasis, "door", EmphasisKind::refuge}}) {
    const auto again = read_subject(subject_json(subject));
    REQUIRE(again);
    CHECK(again.value() == subject);
  }
}

TEST_CASE("JSON that holds no remark or subject of this program is rejected", "[texts][json]") {
  CHECK_FALSE(read_remark(Json("a sentence")));
  CHECK_FALSE(read_remark({{"id", "unheard_of"}, {"args", Json::array()}}));
  CHECK_FALSE(read_remark({{"id", "points_in_bodies"}, {"args", Json::array({Json(1)})}}));
  CHECK_FALSE(read_remark({{"id", "worst_of_failures"}, {"args", Json::array({Json(true)})}}));
  CHECK_FALSE(read_remark({{"id", "no_value"}}));
  CHECK_FALSE(read_subject({{"kind", "planet"}, {"name", "earth"}}));
  CHECK_FALSE(read_subject({{"kind", "emphasis"}, {"name", "door"}, {"emphasis", "gate"}}));
}
