#include "scenes/emergency/rule_table.hpp"

#include <algorithm>
#include <optional>
#include <stdexcept>

namespace luxodus {

namespace {

struct Row {
  const char* id;
  const char* edition;
  const char* clause;
  const char* title;
  const char* source;
  std::optional<Deviation> deviation = std::nullopt;  // that has it; else the set itself
};

/// How a source begins where there is none: see Rule::recollected.
constexpr std::string_view from_memory = "recollection";

constexpr const char* en13 = "EN 1838:2013";
constexpr const char* ibc = "IBC 1008.3.5";
constexpr const char* en24 = "EN 1838:2024";
constexpr const char* nfpa = "NFPA 101";
constexpr const char* makers = "makers' guides (inotec, TRILUX, RSV)";

constexpr Row rows[] = {
    {"E1", en13, "4.2.1", "Illuminance on the centre line of an escape route", "BSI excerpt"},
    {"E2", en13, "4.2.1", "Illuminance on the middle half of an escape route",
     "BSI excerpt; makers' guides"},
    {"E4", en13, "4.2.2", "Largest over smallest illuminance on the centre line", "BSI excerpt"},
    {"E5", en24, "", "Illuminance over the width of an escape route but for its edges",
     "liteplan.com on the draft FprEN 1838 of June 2024"},
    {"E6", en13, "4.3", "Illuminance on the core of an open area", "BSI excerpt"},
    {"E6d", en13, "4.3", "Largest over smallest illuminance in an open area", "BSI excerpt"},
    {"E7", en13, "4.4", "Illuminance on the plane of a high-risk task", "inotec, ETAP"},
    {"E7u", en13, "4.4", "Smallest over largest illuminance on the plane of a high-risk task",
     "ETAP"},
    {"E8", en13, "4.2.3, 4.3.3", "Disability glare: intensity of a luminaire",
     "licht.wissen 10, p. 15"},
    {"E9", en13, "4.2.4", "Colour rendering of emergency light", "BSI excerpt"},
    {"E10", en13, "4.2.6", "Onset: half of the light within 5 s, all within 60 s", "BSI excerpt"},
    {"E10h", en13, "4.2.6", "Half of the illuminance asked for, 5 s after the mains have failed",
     "BSI excerpt"},
    {"E10f", en13, "4.2.6", "All of the illuminance asked for, 60 s after the mains have failed",
     "BSI excerpt"},
    {"E10t", en13, "4.4", "The illuminance on a high-risk task, 0.5 s after the mains have failed",
     "recollection, not a source"},
    {"E11", en13, "4.2.5", "Rated duration of an hour or more", "BSI excerpt"},
    {"E11n", "national practice", "", "Rated duration of three hours or more",
     "fernkorn, table of durations", Deviation::duration_3h},
    {"E11u", "BS 5266-1", "", "Rated duration of three hours or more",
     "fernkorn, table of durations", Deviation::uk_bs_5266},
    {"E10g", "ASR A3.4/3", "", "All of the illuminance asked for, 15 s after the mains have failed",
     "messefrankfurt", Deviation::de_asr},
    {"E6k", "BS 5266-1", "", "Illuminance on the core of an open area",
     "recollection, not a source", Deviation::uk_bs_5266},
    {"E12", en13, "4.1.2", "A luminaire within 2 m of a point of emphasis", "glamox.de"},
    {"E13", en13, "4.1.2", "Vertical illuminance at equipment", "glamox.de"},
    {"E14", en13, "4.1.2", "Height of an emergency luminaire above the floor", "TRILUX"},
    {"S1", en13, "5.4.1", "Smallest luminance of a sign's safety colour", "299lighting; TRILUX"},
    {"S2", en13, "5.4.2", "Largest over smallest luminance within a colour of a sign", makers},
    {"S3", en13, "5.4.3", "Luminance of white over that of green", makers},
    {"S4", en13, "5.5", "A sign within its viewing distance, everywhere on a route", makers},
    {"S5", "DIN 4844-1", "", "Mean luminance of white in mains operation", "licht.wissen 10",
     Deviation::de_din_4844},
    {"S6", en13, "4.1.2", "Height of a sign above the floor", "TRILUX"},
    {"S6l", en13, "4.1.2", "A luminaire within 2 m of an externally lit sign", "TRILUX"},
    {"S6a", en13, "5.5", "Angle of a sign above the horizontal at its viewing distance",
     "recollection, not a source"},
    {"S8", "ISO 3864-4", "", "Chromaticity of safety colours", ""},
    {"N1", nfpa, "7.9.2.1", "Mean illuminance along the path at first", "Signify"},
    {"N1m", nfpa, "7.9.2.1", "Smallest illuminance along the path at first", "Signify"},
    {"N2", nfpa, "7.9.2.1", "Mean illuminance along the path at the end", "Signify"},
    {"N2m", nfpa, "7.9.2.1", "Smallest illuminance along the path at the end", "Signify"},
    {"N3", nfpa, "7.9.2.1", "Largest over smallest illuminance along the path", "Signify"},
    {"I1", ibc, "", "Mean illuminance along the path at first", "NYC code", Deviation::us_ibc},
    {"I1m", ibc, "", "Smallest illuminance along the path at first", "NYC code", Deviation::us_ibc},
    {"I2", ibc, "", "Mean illuminance along the path at the end", "NYC code", Deviation::us_ibc},
    {"I2m", ibc, "", "Smallest illuminance along the path at the end", "NYC code",
     Deviation::us_ibc},
    {"N4", "IBC 1008.3.5, group I-2", "", "Smallest illuminance with any one luminaire failed",
     "NYC code", Deviation::us_ibc_i2},
    {"N5", nfpa, "7.9", "Onset within 10 s", "secondary texts"},
    {"N6", nfpa, "7.10.6", "Illuminance on the face of an externally lit sign", "UBC 1013.3"},
    {"N7", nfpa, "7.10.6", "Height of the letters of a sign", "secondary texts"},
    {"N7s", nfpa, "7.10.6", "Stroke of the letters of a sign", "secondary texts"},
    {"N8", nfpa, "7.10.1.5", "Distance to the nearest sign, everywhere on a route",
     "secondary texts"},
    {"N10", nfpa, "7.10", "Signs lit for 90 minutes", "secondary texts"},
    {"F1", "of no code", "", "Smallest illuminance with any one luminaire failed", ""},
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
  rule.title = row.title;
  rule.source = row.source;
  rule.recollected = rule.source.starts_with(from_memory);
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
    if (!rule.clause.empty()) rule.clause += " of 2013";
    rule.status =
        std::string("carried over from ") + en13 + ", not verified against the text of 2024";
  } else if (rule.edition == set.edition) {
    rule.status = set.status;
  }
  return rule;
}

}  // namespace luxodus
