#include "scenes/emergency/rule_table.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <stdexcept>

namespace luxodus {

namespace {

/// The document that quotes a rule.
struct Source {
  RemarkId id = RemarkId::count;
  const char* name = nullptr;  // argument of the remark
};
using Sources = std::array<Source, 2>;  // entries without an id are empty

struct Row {
  const char* id;
  const char* edition;
  const char* clause;
  Sources sources;
  std::optional<Deviation> deviation =
      std::nullopt;  // the rule belongs to this deviation; none: to the set itself
};

constexpr const char* en13 = "EN 1838:2013";
constexpr const char* ibc = "IBC 1008.3.5";
constexpr const char* en24 = "EN 1838:2024";
constexpr const char* nfpa = "NFPA 101";
constexpr Source bsi{RemarkId::source_bsi};
constexpr Source guides{RemarkId::source_guides};
constexpr Source makers{RemarkId::source_makers, "inotec, TRILUX, RSV"};
constexpr Source liteplan{RemarkId::source_liteplan};
constexpr Source fernkorn{RemarkId::source_fernkorn};
constexpr Source secondary{RemarkId::source_secondary};
constexpr Source recollection{RemarkId::source_recollection};
constexpr Source of(const char* name) {
  return {RemarkId::source_named, name};
}

constexpr Row rows[] = {
    {"E1", en13, "4.2.1", {bsi}},
    {"E2", en13, "4.2.1", {bsi, guides}},
    {"E4", en13, "4.2.2", {bsi}},
    {"E5", en24, "", {liteplan}},
    {"E6", en13, "4.3", {bsi}},
    {"E6d", en13, "4.3", {bsi}},
    {"E7", en13, "4.4", {of("inotec, ETAP")}},
    {"E7u", en13, "4.4", {of("ETAP")}},
    {"E8", en13, "4.2.3, 4.3.3", {of("licht.wissen 10, p. 15")}},
    {"E9", en13, "4.2.4", {bsi}},
    {"E10", en13, "4.2.6", {bsi}},
    {"E10h", en13, "4.2.6", {bsi}},
    {"E10f", en13, "4.2.6", {bsi}},
    {"E10t", en13, "4.4", {recollection}},
    {"E11", en13, "4.2.5", {bsi}},
    {"E11n", "national practice", "", {fernkorn}, Deviation::duration_3h},
    {"E11u", "BS 5266-1", "", {fernkorn}, Deviation::uk_bs_5266},
    {"E10g", "ASR A3.4/3", "", {of("messefrankfurt")}, Deviation::de_asr},
    {"E6k", "BS 5266-1", "", {recollection}, Deviation::uk_bs_5266},
    {"E12", en13, "4.1.2", {of("glamox.de")}},
    {"E13", en13, "4.1.2", {of("glamox.de")}},
    {"E14", en13, "4.1.2", {of("TRILUX")}},
    {"S1", en13, "5.4.1", {of("299lighting; TRILUX")}},
    {"S2", en13, "5.4.2", {makers}},
    {"S3", en13, "5.4.3", {makers}},
    {"S4", en13, "5.5", {makers}},
    {"S5", "DIN 4844-1", "", {of("licht.wissen 10")}, Deviation::de_din_4844},
    {"S6", en13, "4.1.2", {of("TRILUX")}},
    {"S6l", en13, "4.1.2", {of("TRILUX")}},
    {"S6a", en13, "5.5", {recollection}},
    {"S8", "ISO 3864-4", "", {}},
    {"N1", nfpa, "7.9.2.1", {of("Signify")}},
    {"N1m", nfpa, "7.9.2.1", {of("Signify")}},
    {"N2", nfpa, "7.9.2.1", {of("Signify")}},
    {"N2m", nfpa, "7.9.2.1", {of("Signify")}},
    {"N3", nfpa, "7.9.2.1", {of("Signify")}},
    {"I1", ibc, "", {of("NYC code")}, Deviation::us_ibc},
    {"I1m", ibc, "", {of("NYC code")}, Deviation::us_ibc},
    {"I2", ibc, "", {of("NYC code")}, Deviation::us_ibc},
    {"I2m", ibc, "", {of("NYC code")}, Deviation::us_ibc},
    {"N4", "IBC 1008.3.5, group I-2", "", {of("NYC code")}, Deviation::us_ibc_i2},
    {"N5", nfpa, "7.9", {secondary}},
    {"N6", nfpa, "7.10.6", {of("UBC 1013.3")}},
    {"N7", nfpa, "7.10.6", {secondary}},
    {"N7s", nfpa, "7.10.6", {secondary}},
    {"N8", nfpa, "7.10.1.5", {secondary}},
    {"N10", nfpa, "7.10", {secondary}},
    {"F1", "of no code", "", {}},
};

const Row& row_of(std::string_view id) {
  const auto* at =
      std::find_if(std::begin(rows), std::end(rows), [&](const Row& row) { return row.id == id; });
  if (at == std::end(rows)) throw std::logic_error("no rule " + std::string(id));
  return *at;
}

}  // namespace

Rule own_rule(std::string_view id) {
  const Row& row = row_of(id);
  Rule rule;
  rule.id = row.id;
  rule.edition = row.edition;
  rule.clause = row.clause;
  for (const Source& source : row.sources)
    if (source.id != RemarkId::count)
      rule.sources.push_back(source.name == nullptr ? remark(source.id)
                                                    : remark(source.id, source.name));
  return rule;
}

Rule rule_of(std::string_view id, const CodeChoice& codes) {
  Rule rule = own_rule(id);
  const NamedRules& set = named(codes.set);
  rule.set = set.id;
  if (const auto deviation = row_of(id).deviation) rule.deviation = named(*deviation).id;
  const bool of_2013 = rule.edition == en13;
  if (of_2013 && codes.set == RuleSet::en1838_2024) {
    rule.edition = en24;
    rule.status = remark(RemarkId::carried_over);
  } else if (rule.edition == set.edition && set.status) {
    rule.status = remark(*set.status);
  }
  return rule;
}

}  // namespace luxodus
