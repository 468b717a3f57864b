#include "scenes/emergency/rule_table.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <stdexcept>

namespace luxodus {

namespace {

constexpr const char* en13 = "EN 1838:2013";
constexpr const char* ibc = "IBC 1008.3.5";
constexpr const char* en24 = "EN 1838:2024";
constexpr const char* nfpa = "NFPA 101";
constexpr RuleSource bsi{RemarkId::source_bsi};
constexpr RuleSource guides{RemarkId::source_guides};
constexpr RuleSource makers{RemarkId::source_makers, "inotec, TRILUX, RSV"};
constexpr RuleSource liteplan{RemarkId::source_liteplan};
constexpr RuleSource fernkorn{RemarkId::source_fernkorn};
constexpr RuleSource secondary{RemarkId::source_secondary};
constexpr RuleSource recollection{RemarkId::source_recollection};
constexpr RuleSource of(const char* name) {
  return {RemarkId::source_named, name};
}

constexpr std::nullopt_t none = std::nullopt;
constexpr bool at_least = true, at_most = false;

constexpr RuleRow rows[] = {
    {RuleId::E1, "E1", en13, "4.2.1", {bsi}, 1, at_least, "lx", DecidedBy::luminaires},
    {RuleId::E2, "E2", en13, "4.2.1", {bsi, guides}, 0.5, at_least, "lx", DecidedBy::luminaires},
    {RuleId::E4, "E4", en13, "4.2.2", {bsi}, 40, at_most, "1", DecidedBy::luminaires},
    {RuleId::E5, "E5", en24, "", {liteplan}, 1, at_least, "lx", DecidedBy::luminaires},
    {RuleId::E6, "E6", en13, "4.3", {bsi}, 0.5, at_least, "lx", DecidedBy::luminaires},
    {RuleId::E6d, "E6d", en13, "4.3", {bsi}, 40, at_most, "1", DecidedBy::luminaires},
    {RuleId::E7,
     "E7",
     en13,
     "4.4",
     {of("inotec, ETAP")},
     15,
     at_least,
     "lx",
     DecidedBy::luminaires},
    {RuleId::E7u, "E7u", en13, "4.4", {of("ETAP")}, 0.1, at_least, "1", DecidedBy::luminaires},
    {RuleId::E8,
     "E8",
     en13,
     "4.2.3, 4.3.3",
     {of("licht.wissen 10, p. 15")},
     none,
     at_most,
     "cd",
     DecidedBy::luminaires},
    {RuleId::E9, "E9", en13, "4.2.4", {bsi}, none, at_least, "", DecidedBy::nothing},
    {RuleId::E10, "E10", en13, "4.2.6", {bsi}, none, at_least, "", DecidedBy::nothing},
    {RuleId::E10h, "E10h", en13, "4.2.6", {bsi}, none, at_least, "lx", DecidedBy::luminaires},
    {RuleId::E10f, "E10f", en13, "4.2.6", {bsi}, none, at_least, "lx", DecidedBy::luminaires},
    {RuleId::E10t,
     "E10t",
     en13,
     "4.4",
     {recollection},
     none,
     at_least,
     "lx",
     DecidedBy::luminaires},
    {RuleId::E11, "E11", en13, "4.2.5", {bsi}, 1, at_least, "h", DecidedBy::nothing},
    {RuleId::E11n,
     "E11n",
     "national practice",
     "",
     {fernkorn},
     3,
     at_least,
     "h",
     DecidedBy::nothing,
     Deviation::duration_3h},
    {RuleId::E11u,
     "E11u",
     "BS 5266-1",
     "",
     {fernkorn},
     3,
     at_least,
     "h",
     DecidedBy::nothing,
     Deviation::uk_bs_5266},
    {RuleId::E10g,
     "E10g",
     "ASR A3.4/3",
     "",
     {of("messefrankfurt")},
     none,
     at_least,
     "lx",
     DecidedBy::luminaires,
     Deviation::de_asr},
    {RuleId::E6k,
     "E6k",
     "BS 5266-1",
     "",
     {recollection},
     1,
     at_least,
     "lx",
     DecidedBy::luminaires,
     Deviation::uk_bs_5266},
    {RuleId::E12, "E12", en13, "4.1.2", {of("glamox.de")}, 2, at_most, "m", DecidedBy::luminaires},
    {RuleId::E12s,
     "E12s",
     en13,
     "4.1.2",
     {of("glamox.de")},
     0.1,
     at_least,
     "lx",
     DecidedBy::luminaires},
    {RuleId::E13,
     "E13",
     en13,
     "4.1.2",
     {of("glamox.de")},
     5,
     at_least,
     "lx",
     DecidedBy::luminaires},
    {RuleId::E14, "E14", en13, "4.1.2", {of("TRILUX")}, 2, at_least, "m", DecidedBy::luminaires},
    {RuleId::S1,
     "S1",
     en13,
     "5.4.1",
     {of("299lighting; TRILUX")},
     none,
     at_least,
     "cd/m2",
     DecidedBy::lit_sign},
    {RuleId::S2, "S2", en13, "5.4.2", {makers}, 10, at_most, "1", DecidedBy::sign},
    {RuleId::S3, "S3", en13, "5.4.3", {makers}, none, at_least, "1", DecidedBy::sign},
    {RuleId::S4,
     "S4",
     en13,
     "5.5",
     {makers},
     1,
     at_most,
     "of the viewing distance",
     DecidedBy::placed_signs},
    {RuleId::S5,
     "S5",
     "DIN 4844-1",
     "",
     {of("licht.wissen 10")},
     500,
     at_least,
     "cd/m2",
     DecidedBy::sign,
     Deviation::de_din_4844},
    {RuleId::S6, "S6", en13, "4.1.2", {of("TRILUX")}, 2, at_least, "m", DecidedBy::sign},
    {RuleId::S6l, "S6l", en13, "4.1.2", {of("TRILUX")}, 2, at_most, "m", DecidedBy::luminaires},
    {RuleId::S6a, "S6a", en13, "5.5", {recollection}, 20, at_most, "deg", DecidedBy::sign},
    {RuleId::S8, "S8", "ISO 3864-4", "", {}, none, at_least, "", DecidedBy::nothing},
    {RuleId::S8c,
     "S8c",
     "ISO 7010",
     "",
     {of("E001, E002, E003, E007")},
     none,
     at_least,
     "",
     DecidedBy::sign},
    {RuleId::N1,
     "N1",
     nfpa,
     "7.9.2.1",
     {of("Signify")},
     10.8,
     at_least,
     "lx",
     DecidedBy::luminaires},
    {RuleId::N1m,
     "N1m",
     nfpa,
     "7.9.2.1",
     {of("Signify")},
     1.1,
     at_least,
     "lx",
     DecidedBy::luminaires},
    {RuleId::N2,
     "N2",
     nfpa,
     "7.9.2.1",
     {of("Signify")},
     6.5,
     at_least,
     "lx",
     DecidedBy::luminaires},
    {RuleId::N2m,
     "N2m",
     nfpa,
     "7.9.2.1",
     {of("Signify")},
     0.65,
     at_least,
     "lx",
     DecidedBy::luminaires},
    {RuleId::N3, "N3", nfpa, "7.9.2.1", {of("Signify")}, 40, at_most, "1", DecidedBy::luminaires},
    {RuleId::I1,
     "I1",
     ibc,
     "",
     {of("NYC code")},
     11,
     at_least,
     "lx",
     DecidedBy::luminaires,
     Deviation::us_ibc},
    {RuleId::I1m,
     "I1m",
     ibc,
     "",
     {of("NYC code")},
     1,
     at_least,
     "lx",
     DecidedBy::luminaires,
     Deviation::us_ibc},
    {RuleId::I2,
     "I2",
     ibc,
     "",
     {of("NYC code")},
     6,
     at_least,
     "lx",
     DecidedBy::luminaires,
     Deviation::us_ibc},
    {RuleId::I2m,
     "I2m",
     ibc,
     "",
     {of("NYC code")},
     0.6,
     at_least,
     "lx",
     DecidedBy::luminaires,
     Deviation::us_ibc},
    {RuleId::N4,
     "N4",
     "IBC 1008.3.5, group I-2",
     "",
     {of("NYC code")},
     2.2,
     at_least,
     "lx",
     DecidedBy::luminaires,
     Deviation::us_ibc_i2},
    {RuleId::N5, "N5", nfpa, "7.9", {secondary}, 0.65, at_least, "lx", DecidedBy::luminaires},
    {RuleId::N6,
     "N6",
     nfpa,
     "7.10.6",
     {of("UBC 1013.3")},
     54,
     at_least,
     "lx",
     DecidedBy::luminaires},
    {RuleId::N7, "N7", nfpa, "7.10.6", {secondary}, 0.152, at_least, "m", DecidedBy::sign},
    {RuleId::N7s, "N7s", nfpa, "7.10.6", {secondary}, 0.019, at_least, "m", DecidedBy::sign},
    {RuleId::N8, "N8", nfpa, "7.10.1.5", {secondary}, 30, at_most, "m", DecidedBy::placed_signs},
    {RuleId::N10, "N10", nfpa, "7.10", {secondary}, 1.5, at_least, "h", DecidedBy::nothing},
    {RuleId::F1, "F1", "of no code", "", {}, none, at_least, "lx", DecidedBy::nothing},
};

static_assert(std::size(rows) + 1 == static_cast<size_t>(RuleId::count));

}  // namespace

const RuleRow& row_of(RuleId id) {
  if (id == RuleId::none) throw std::logic_error("there is no such rule");
  return rows[static_cast<size_t>(id) - 1];
}

double limit_of(RuleId id) {
  return row_of(id).limit.value();
}

std::string_view name_of(RuleId id) {
  return id == RuleId::none ? std::string_view() : row_of(id).name;
}

std::optional<RuleId> rule_named(std::string_view name) {
  for (const RuleRow& row : rows)
    if (row.name == name) return row.id;
  return std::nullopt;
}

Rule own_rule(RuleId id) {
  const RuleRow& row = row_of(id);
  Rule rule;
  rule.id = id;
  rule.edition = row.edition;
  rule.clause = row.clause;
  for (const RuleSource& source : row.sources)
    if (source.id != RemarkId::count)
      rule.sources.push_back(source.name == nullptr ? remark(source.id)
                                                    : remark(source.id, source.name));
  return rule;
}

Rule rule_of(RuleId id, const CodeChoice& codes) {
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
