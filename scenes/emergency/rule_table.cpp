#include "scenes/emergency/rule_table.hpp"

#include <algorithm>
#include <stdexcept>

namespace luxodus {

namespace {

struct Row {
  const char* id;
  const char* edition;
  const char* clause;
  const char* title;
  const char* source;
};

constexpr const char* en13 = "EN 1838:2013";
constexpr const char* en24 = "EN 1838:2024 (FprEN)";
constexpr const char* nfpa = "NFPA 101";
constexpr const char* makers = "makers' guides (inotec, TRILUX, RSV)";

constexpr Row rows[] = {
    {"E1", en13, "4.2.1", "Illuminance on the centre line of an escape route", "BSI excerpt"},
    {"E2", en13, "4.2.1", "Illuminance on the middle half of an escape route",
     "BSI excerpt; makers' guides"},
    {"E4", en13, "4.2.2", "Largest over smallest illuminance on the centre line", "BSI excerpt"},
    {"E5", en24, "", "Illuminance over the width of an escape route but for its edges",
     "liteplan.com"},
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
    {"E12", en13, "4.1.2", "A luminaire within 2 m of a point of emphasis", "glamox.de"},
    {"E13", en13, "4.1.2", "Vertical illuminance at equipment", "glamox.de"},
    {"S1", en13, "5.4.1", "Smallest luminance of a sign's safety colour", "299lighting; TRILUX"},
    {"S2", en13, "5.4.2", "Largest over smallest luminance within a colour of a sign", makers},
    {"S3", en13, "5.4.3", "Luminance of white over that of green", makers},
    {"S4", en13, "5.5", "A sign within its viewing distance, everywhere on a route", makers},
    {"S5", "DIN 4844-1", "", "Mean luminance of white in mains operation", "licht.wissen 10"},
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
    {"N4", "IBC 1008.3.5", "", "Smallest illuminance with one unit failed (Group I-2 alone)",
     "NYC code"},
    {"N5", nfpa, "7.9", "Onset within 10 s", "secondary texts"},
    {"N6", nfpa, "7.10.6", "Illuminance on the face of an externally lit sign", "UBC 1013.3"},
    {"N7", nfpa, "7.10.6", "Height of the letters of a sign", "secondary texts"},
    {"N7s", nfpa, "7.10.6", "Stroke of the letters of a sign", "secondary texts"},
    {"N8", nfpa, "7.10.1.5", "Distance to the nearest sign, everywhere on a route",
     "secondary texts"},
    {"N10", nfpa, "7.10", "Signs lit for 90 minutes", "secondary texts"},
};

}  // namespace

Rule rule_of(std::string_view id) {
  const auto* at =
      std::find_if(std::begin(rows), std::end(rows), [&](const Row& row) { return row.id == id; });
  if (at == std::end(rows)) throw std::logic_error("no rule " + std::string(id));
  return {at->id, at->edition, at->clause, at->title, at->source};
}

}  // namespace luxodus
