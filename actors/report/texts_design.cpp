// The page of a design: layouts of emergency luminaires (actors/design).
#include "actors/report/texts.hpp"

namespace luxodus {

namespace {

constexpr ReportText design_rows[] = {
    {"design.page",
     {"Layout of emergency luminaires", "Anordnung von Notleuchten",
      "Implantation de luminaires de secours"}},
    {"design.luminaires", {"{0} new luminaires", "{0} neue Leuchten", "{0} luminaires neufs"}},
    {"design.kept", {"{0} stay", "{0} bleiben", "{0} restent"}},
    {"design.gone", {"{0} go", "{0} entfallen", "{0} disparaissent"}},
    {"design.objective", {"{0}: {1}.", "{0}: {1}.", "{0} : {1}."}},
    {"design.objective.number",
     {"Number of luminaires", "Anzahl der Leuchten", "Nombre de luminaires"}},
    {"design.objective.cost", {"Cost", "Kosten", "Coût"}},
    {"design.objective.watts", {"Power [W]", "Leistung [W]", "Puissance [W]"}},
    {"design.objective.weighted", {"Weighted sum", "Gewichtete Summe", "Somme pondérée"}},
    {"design.optimal",
     {"No layout of these candidates has less.", "Keine Anordnung dieser Kandidaten hat weniger.",
      "Aucune implantation de ces candidats n’a moins."}},
    {"design.open",
     {"No layout of these candidates has less than {0}; {1} % are left open.",
      "Keine Anordnung dieser Kandidaten hat weniger als {0}; {1} % bleiben offen.",
      "Aucune implantation de ces candidats n’a moins de {0} ; {1} % restent ouverts."}},
    {"design.greedy",
     {"Taking the most helpful luminaire again and again gives {0}.",
      "Immer wieder die hilfreichste Leuchte zu nehmen ergibt {0}.",
      "Prendre chaque fois le luminaire le plus utile donne {0}."}},
    {"design.notice_codes",
     {"A calculation of direct light in clear air, by the rule sets named below. It does not say "
      "that a building complies with a code.",
      "Eine Berechnung des direkten Lichts in klarer Luft nach den unten genannten Regelwerken. "
      "Sie "
      "sagt nicht, dass ein Gebäude eine Norm erfüllt.",
      "Un calcul de la lumière directe en air clair, selon les référentiels nommés ci-dessous. Il "
      "ne dit pas qu’un bâtiment respecte une norme."}},
    {"design.notice_smoke",
     {"Smoke is not part of this layout: more light under the ceiling can make signs harder to "
      "read. Assess the variant in smoke before it is built.",
      "Rauch geht in diese Anordnung nicht ein: mehr Licht unter der Decke kann Zeichen schlechter "
      "lesbar machen. Die Variante ist vor dem Bau im Rauch zu beurteilen.",
      "La fumée n’entre pas dans cette implantation : plus de lumière sous le plafond peut rendre "
      "les panneaux moins lisibles. Évaluer la variante dans la fumée avant de construire."}},
    {"design.notice_candidates",
     {"The best of the candidate places and types alone: other places may do with less.",
      "Die beste nur unter den Kandidaten: andere Orte kommen womöglich mit weniger aus.",
      "La meilleure parmi les candidats seulement : d’autres places pourraient suffire à moins."}},
    {"design.plan_installation",
     {"What is installed", "Was installiert ist", "Ce qui est installé"}},
    {"design.plan_isolux",
     {"Lines of equal illuminance on the floor, all luminaires lit",
      "Linien gleicher Beleuchtungsstärke am Boden, alle Leuchten an",
      "Lignes d’égal éclairement au sol, tous les luminaires allumés"}},
    {"design.name", {"Name", "Name", "Nom"}},
    {"design.x", {"x [m]", "x [m]", "x [m]"}},
    {"design.y", {"y [m]", "y [m]", "y [m]"}},
    {"design.z", {"z [m]", "z [m]", "z [m]"}},
    {"design.turn", {"Turn [°]", "Drehung [°]", "Rotation [°]"}},
    {"design.cost", {"Cost each", "Kosten je Stück", "Coût unitaire"}},
    {"design.watts", {"Power each", "Leistung je Stück", "Puissance unitaire"}},
    {"design.stays", {"of the scene, stays", "der Szene, bleibt", "de la scène, reste"}},
    {"design.removed",
     {"Luminaires of the scene that go: {0}.", "Leuchten der Szene, die entfallen: {0}.",
      "Luminaires de la scène qui disparaissent : {0}."}},
    {"design.binding_heading", {"What binds", "Was bindet", "Ce qui contraint"}},
    {"design.binding_note",
     {"The last column says how much of the smallest possible objective comes from a constraint, "
      "while fractions of luminaires are allowed (dual values). Constraints that are met to "
      "within 2 % are tight.",
      "Die letzte Spalte sagt, wie viel des kleinstmöglichen Zielwerts von einer Bedingung stammt, "
      "solange Bruchteile von Leuchten erlaubt sind (Dualwerte). Bedingungen, die auf 2 % genau "
      "erfüllt sind, sind knapp.",
      "La dernière colonne dit quelle part de l’objectif minimal vient d’une contrainte, tant que "
      "des fractions de luminaires sont permises (valeurs duales). Les contraintes tenues à 2 % "
      "près sont serrées."}},
    {"design.rule", {"Rule", "Regel", "Règle"}},
    {"design.subject", {"Of", "Von", "De"}},
    {"design.asked", {"Planned for", "Geplant auf", "Prévu"}},
    {"design.least", {"Least there [%]", "Kleinster Wert [%]", "Minimum atteint [%]"}},
    {"design.binding", {"Effect", "Wirkung", "Effet"}},
    {"design.binds",
     {"binds: {0} of the objective", "bindet: {0} des Zielwerts", "contraint : {0} de l’objectif"}},
    {"design.tight", {"tight", "knapp", "serrée"}},
    {"design.slack", {"room to spare", "Reserve", "de la marge"}},
    {"design.kind_minimum",
     {"at least {0} lx everywhere", "überall mindestens {0} lx", "au moins {0} lx partout"}},
    {"design.kind_mean",
     {"a mean of at least {0} lx", "im Mittel mindestens {0} lx", "au moins {0} lx en moyenne"}},
    {"design.kind_early",
     {"at least {0} lx in time after the failure of the mains",
      "rechtzeitig nach dem Netzausfall mindestens {0} lx",
      "au moins {0} lx à temps après la coupure du secteur"}},
    {"design.kind_spread",
     {"largest over smallest illuminance at most {0}",
      "größte durch kleinste Beleuchtungsstärke höchstens {0}",
      "éclairement maximal sur minimal d’au plus {0}"}},
    {"design.kind_two",
     {"{0} luminaires over it", "{0} Leuchten darüber", "{0} luminaires au-dessus"}},
    {"design.kind_failed",
     {"at least {0} lx with any one luminaire failed",
      "mindestens {0} lx bei Ausfall einer beliebigen Leuchte",
      "au moins {0} lx avec un luminaire quelconque en panne"}},
    {"design.kind_near",
     {"a luminaire within {0} m", "eine Leuchte innerhalb von {0} m",
      "un luminaire à moins de {0} m"}},
    {"design.kind_vertical",
     {"at least {0} lx on its front", "mindestens {0} lx auf der Vorderseite",
      "au moins {0} lx sur sa face"}},
    {"design.kind_face",
     {"at least {0} lx on its face", "mindestens {0} lx auf der Fläche",
      "au moins {0} lx sur sa surface"}},
    {"design.others",
     {"What this design does not decide", "Was dieser Entwurf nicht entscheidet",
      "Ce que ce projet ne décide pas"}},
    {"design.others_note",
     {"These checks fail: they are of signs, of luminaires that stay, of places that furniture "
      "hides, or of what the scene does not say.",
      "Diese Prüfungen sind nicht erfüllt: sie betreffen Zeichen, bleibende Leuchten, von Möbeln "
      "verdeckte Orte oder was die Szene nicht sagt.",
      "Ces contrôles échouent : ils concernent les panneaux, les luminaires qui restent, les lieux "
      "cachés par le mobilier, ou ce que la scène ne dit pas."}},
    {"design.settings_heading",
     {"What was asked for", "Was verlangt wurde", "Ce qui était demandé"}},
    {"design.settings",
     {"Rule sets: {0}. Planning margin of minima of illuminance: {1}. When one luminaire fails: "
      "{2}.",
      "Regelwerke: {0}. Planungsfaktor der Mindestbeleuchtungsstärken: {1}. Bei Ausfall einer "
      "Leuchte: {2}.",
      "Référentiels : {0}. Marge de projet des éclairements minimaux : {1}. Quand un luminaire "
      "tombe en panne : {2}."}},
    {"design.failure.none", {"nothing is asked for", "nichts verlangt", "rien n’est demandé"}},
    {"design.failure.two",
     {"two luminaires over each route and open area, and no place below 0.1 lx (our reading of "
      "“not in total darkness”)",
      "zwei Leuchten über jedem Weg und offenen Bereich, und kein Ort unter 0,1 lx (unsere Lesart "
      "von „nicht völlig dunkel“)",
      "deux luminaires sur chaque chemin et espace ouvert, et aucun lieu sous 0,1 lx (notre "
      "lecture de « pas dans l’obscurité totale »)"}},
    {"design.failure.full",
     {"the minima of the rules hold", "die Mindestwerte der Regeln gelten",
      "les minima des règles tiennent"}},
    {"design.candidates",
     {"{0} candidate places, {1} candidates of all types and turns, {2} points of calculation.",
      "{0} Kandidatenplätze, {1} Kandidaten aller Typen und Drehungen, {2} Berechnungspunkte.",
      "{0} places candidates, {1} candidats de tous types et rotations, {2} points de calcul."}},
    {"design.hidden",
     {"{0}, {1}: furniture hides {2} points of calculation from all candidates together, so that "
      "no layout passes with furniture. It is planned for without furniture.",
      "{0}, {1}: Möbel verdecken {2} Berechnungspunkte vor allen Kandidaten zusammen, so dass "
      "keine "
      "Anordnung mit Möbeln genügt. Geplant ist ohne Möbel.",
      "{0}, {1} : le mobilier cache {2} points de calcul à tous les candidats ensemble, si bien "
      "qu’aucune implantation ne suffit avec mobilier. Le projet est fait sans mobilier."}},
    {"design.left_out", {"Left out: {0}.", "Ausgeschlossen: {0}.", "Écartés : {0}."}},
    {"design.left_no_ceiling", {"{0} without a ceiling", "{0} ohne Decke", "{0} sans plafond"}},
    {"design.left_in_bodies", {"{0} in bodies", "{0} in Körpern", "{0} dans des corps"}},
    {"design.left_near_walls",
     {"{0} too near to a wall", "{0} zu nahe an einer Wand", "{0} trop près d’un mur"}},
    {"design.left_near_signs",
     {"{0} too near to a sign", "{0} zu nahe an einem Zeichen", "{0} trop près d’un panneau"}},
    {"design.left_keep_out",
     {"{0} in keep-out zones", "{0} in Sperrzonen", "{0} dans des zones interdites"}},
    {"design.left_too_low", {"{0} below 2 m (E14)", "{0} unter 2 m (E14)", "{0} sous 2 m (E14)"}},
    {"design.left_glaring", {"{0} glaring (E8)", "{0} blendend (E8)", "{0} éblouissants (E8)"}},
};

}  // namespace

std::span<const ReportText> design_texts() {
  return design_rows;
}

}  // namespace luxodus
