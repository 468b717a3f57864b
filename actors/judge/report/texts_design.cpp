// The page of a design: layouts of emergency luminaires (actors/judge/design).
#include "actors/judge/report/texts.hpp"

namespace luxodus {

namespace {

constexpr ReportText design_rows[] = {
    {"design.page",
     {"Layout of emergency luminaires", "Anordnung von Notleuchten",
      "Implantation de luminaires de secours"}},
    {"design.luminaire", {"{0} new luminaire", "{0} neue Leuchte", "{0} luminaire neuf"}},
    {"design.luminaires", {"{0} new luminaires", "{0} neue Leuchten", "{0} luminaires neufs"}},
    {"design.kept", {"{0} stay", "{0} bleiben", "{0} restent"}},
    {"design.battery", {"battery class", "Batterieklasse", "classe de batterie"}},
    {"design.not_placed",
     {"“{0}” is not placed: it lasts {1} h, and {2} asks for {3} h.",
      "„{0}“ wird nicht gesetzt: Die Versorgung hält {1} h, und {2} verlangt {3} h.",
      "« {0} » n’est pas posé : il tient {1} h, et {2} demande {3} h."}},
    {"design.moved", {"{0} are moved", "{0} werden versetzt", "{0} sont déplacés"}},
    {"design.moved_from",
     {"of the scene, moved from {0}", "der Szene, versetzt von {0}",
      "de la scène, déplacé de {0}"}},
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
    {"design.off_place",
     {"With all new luminaires mounted up to {0} m off their places, each in its worst direction, "
      "the least is {1} % of a minimum of the rules, without the planning margin: {2}, at {3}.",
      "Sind alle neuen Leuchten bis {0} m neben ihrem Ort montiert, jede in der schlechtesten "
      "Richtung, so ist der kleinste Wert {1} % eines Mindestwerts der Regeln, ohne "
      "Planungsfaktor: {2}, bei {3}.",
      "Avec tous les luminaires neufs montés jusqu’à {0} m à côté de leur place, chacun dans la "
      "pire direction, le plus faible est {1} % d’un minimum des règles, sans la marge de projet : "
      "{2}, en {3}."}},
    {"design.off_place_fails",
     {"No layout of these candidates was found whose minima hold then.",
      "Keine Anordnung dieser Kandidaten wurde gefunden, deren Mindestwerte dann gelten.",
      "Aucune implantation de ces candidats n’a été trouvée dont les minimums tiennent alors."}},
    {"design.signs_heading", {"Signs", "Zeichen", "Panneaux"}},
    {"design.sign", {"{0} new sign.", "{0} neues Zeichen.", "{0} panneau neuf."}},
    {"design.signs", {"{0} new signs.", "{0} neue Zeichen.", "{0} panneaux neufs."}},
    {"design.signs_guide",
     {"From everywhere on the routes, but for what is named below, a sign ahead is seen within its "
      "viewing distance that belongs to the route and points along it.",
      "Von überall auf den Wegen, außer wo unten genannt, ist voraus innerhalb der "
      "Erkennungsweite ein Zeichen zu sehen, das zum Weg gehört und an ihm entlang zeigt.",
      "De partout sur les itinéraires, sauf mention ci-dessous, on voit devant soi, à sa distance "
      "de vision, un panneau qui appartient à l’itinéraire et pointe le long de celui-ci."}},
    {"design.signs_optimal",
     {"No plan with these places has less.", "Kein Plan mit diesen Orten hat weniger.",
      "Aucun plan avec ces places n’a moins."}},
    {"design.signs_unguided",
     {"Route “{0}”: no sign guides from {1} of {2} places, first at {3}.",
      "Weg „{0}“: von {1} von {2} Orten führt kein Zeichen, zuerst bei {3}.",
      "Itinéraire « {0} » : aucun panneau ne guide depuis {1} des {2} places, d’abord en {3}."}},
    {"design.signs_behind",
     {"Furniture hides all places for signs there.", "Möbel verdecken dort alle Orte für Zeichen.",
      "Le mobilier y cache toutes les places pour des panneaux."}},
    {"design.signs_behind_signs",
     {"Signs hide each other there in all plans that were tried.",
      "Zeichen verdecken dort einander in allen Plänen, die versucht wurden.",
      "Des panneaux s’y cachent les uns les autres dans tous les plans essayés."}},
    {"design.signs_removed",
     {"Signs of the scene that go: {0}.", "Zeichen der Szene, die entfallen: {0}.",
      "Panneaux de la scène qui disparaissent : {0}."}},
    {"design.mount", {"Where", "Wo", "Où"}},
    {"design.mount.above a door or at the end of a way",
     {"above a door or at the end of a way", "über einer Tür oder am Ende eines Wegs",
      "au-dessus d’une porte ou au bout d’un chemin"}},
    {"design.mount.beside a door or a way",
     {"beside a door or a way", "neben einer Tür oder einem Weg",
      "à côté d’une porte ou d’un "
      "chemin"}},
    {"design.mount.under the ceiling", {"under the ceiling", "unter der Decke", "sous le plafond"}},
    {"design.ways", {"Routes and arrows", "Wege und Pfeile", "Itinéraires et flèches"}},
    {"design.arrow.left", {"left", "links", "gauche"}},
    {"design.arrow.right", {"right", "rechts", "droite"}},
    {"design.arrow.ahead", {"ahead", "geradeaus", "tout droit"}},
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
    {"design.because",
     {"{0} more because of {1}: without it {2} would do.",
      "{0} mehr wegen dieser Forderung: {1}. Ohne sie würden {2} genügen.",
      "{0} de plus à cause de cette exigence : {1}. Sans elle, {2} suffiraient."}},
    {"design.because_at_least",
     {"At least {0} more because of {1}: without it {2} would do.",
      "Mindestens {0} mehr wegen dieser Forderung: {1}. Ohne sie würden {2} genügen.",
      "Au moins {0} de plus à cause de cette exigence : {1}. Sans elle, {2} suffiraient."}},
    {"design.because_failures",
     {"the failure of single luminaires", "Ausfall einzelner Leuchten",
      "la panne de luminaires isolés"}},
    {"design.because_failure",
     {"the single failure of {0}", "Ausfall von {0} allein", "la panne de {0} seul"}},
    {"design.because_amount", {"{0} ({1})", "{0} ({1})", "{0} ({1})"}},
    {"design.one_luminaire", {"1 luminaire", "1 Leuchte", "1 luminaire"}},
    {"design.some_luminaires", {"{0} luminaires", "{0} Leuchten", "{0} luminaires"}},
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
    {"design.kind_flight",
     {"a luminaire whose light falls directly on it, {0} lx on each tread",
      "eine Leuchte, deren Licht direkt darauf fällt, {0} lx auf jeder Stufe",
      "un luminaire dont la lumière y tombe directement, {0} lx sur chaque marche"}},
    {"design.unlit_flight",
     {"The flight of stairs “{0}” is not planned: no candidate lights all of its treads.",
      "Der Treppenlauf „{0}“ ist nicht geplant: Kein Platz beleuchtet alle seine Stufen.",
      "La volée d’escalier « {0} » n’est pas prévue : aucun emplacement n’éclaire toutes ses "
      "marches."}},
    {"design.side_heading",
     {"Layouts side by side", "Entwürfe nebeneinander", "Implantations côte à côte"}},
    {"design.side_note",
     {"All of them pass the rules. Where they stand in smoke, the section before tells.",
      "Alle bestehen die Regeln. Wie sie im Rauch dastehen, sagt der Abschnitt davor.",
      "Toutes satisfont aux règles. La section précédente dit ce qu’elles valent dans la fumée."}},
    {"design.side_layout",
     {"{0}: {1} new luminaires, {2} {3}", "{0}: {1} neue Leuchten, {2} {3}",
      "{0} : {1} luminaires neufs, {2} {3}"}},
    {"design.side_recommended",
     {"{0}, recommended: {1} new luminaires, {2} {3}", "{0}, empfohlen: {1} neue Leuchten, {2} {3}",
      "{0}, conseillée : {1} luminaires neufs, {2} {3}"}},
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
    {"design.notice_in_smoke",
     {"Layouts were compared in the smoke of the scenarios that are named; of other fires they say "
      "nothing.",
      "Anordnungen wurden im Rauch der genannten Szenarien verglichen; über andere Brände sagen "
      "sie nichts.",
      "Les implantations ont été comparées dans la fumée des scénarios nommés ; elles ne disent "
      "rien d’autres feux."}},
    {"design.smoke_heading", {"In smoke", "Im Rauch", "Dans la fumée"}},
    {"design.smoke_range", {"{0} to {1} %", "{0} bis {1} %", "{0} à {1} %"}},
    {"design.smoke_first",
     {"With layout {0}, the best by the rules alone, a sign ahead is read from {1} of the routes’ "
      "length, in the worst of the scenarios.",
      "Mit Anordnung {0}, der besten allein nach den Regeln, ist im schlechtesten der Szenarien "
      "von {1} der Weglänge ein Zeichen voraus lesbar.",
      "Avec l’implantation {0}, la meilleure d’après les seules règles, un panneau est lisible "
      "devant soi depuis {1} de la longueur des itinéraires, dans le pire des scénarios."}},
    {"design.smoke_same",
     {"With no other layout is a sign surely read from more places. That other luminaires help "
      "people "
      "to read these signs in this smoke is not shown.",
      "Mit keiner anderen Anordnung ist sicher von mehr Orten ein Zeichen lesbar. Dass andere "
      "Leuchten helfen, diese Zeichen in diesem Rauch zu lesen, ist nicht gezeigt.",
      "Avec aucune autre implantation un panneau n’est lisible avec certitude depuis plus de "
      "places. Que d’autres luminaires aident à lire ces panneaux dans cette fumée n’est pas "
      "montré."}},
    {"design.smoke_better",
     {"Layout {0} has {1} new luminaires instead of {2}, and a sign is read from {3}, {4} beside "
      "layout {5}: it is recommended.",
      "Anordnung {0} hat {1} statt {2} neue Leuchten, und von {3} ist ein Zeichen lesbar, {4} "
      "gegen Anordnung {5}: sie wird empfohlen.",
      "L’implantation {0} a {1} luminaires neufs au lieu de {2}, et un panneau est lisible depuis "
      "{3}, {4} face à l’implantation {5} : elle est recommandée."}},
    {"design.smoke_signs_help",
     {"Signs {0} times as bright would be read from {1}: that helps more than any layout that was "
      "tried.",
      "Zeichen mit der {0}-fachen Leuchtdichte wären von {1} lesbar: das hilft mehr als jede "
      "Anordnung, die versucht wurde.",
      "Des panneaux {0} fois plus lumineux seraient lisibles depuis {1} : cela aide plus que toute "
      "implantation essayée."}},
    {"design.smoke_signs",
     {"Signs {0} times as bright would be read from {1}.",
      "Zeichen mit der {0}-fachen Leuchtdichte wären von {1} lesbar.",
      "Des panneaux {0} fois plus lumineux seraient lisibles depuis {1}."}},
    {"design.smoke_low_helps",
     {"With {0} low-level signs beside the others, {1} m above the floor, a sign would be read "
      "from "
      "{2}: that helps more than any layout that was tried.",
      "Mit {0} bodennahen Zeichen neben den anderen, {1} m über dem Boden, wäre von {2} ein "
      "Zeichen "
      "lesbar: das hilft mehr als jede Anordnung, die versucht wurde.",
      "Avec {0} panneaux bas en plus des autres, à {1} m du sol, un panneau serait lisible depuis "
      "{2} : cela aide plus que toute implantation essayée."}},
    {"design.smoke_low_signs",
     {"With {0} low-level signs beside the others, {1} m above the floor, a sign would be read "
      "from "
      "{2}.",
      "Mit {0} bodennahen Zeichen neben den anderen, {1} m über dem Boden, wäre von {2} ein "
      "Zeichen "
      "lesbar.",
      "Avec {0} panneaux bas en plus des autres, à {1} m du sol, un panneau serait lisible depuis "
      "{2}."}},
    {"design.smoke_veil",
     {"Layout {0} has more light, and from {1} places where a sign is read with layout {2} none is "
      "read: light in the smoke veils it.",
      "Anordnung {0} hat mehr Licht, und an {1} Orten, an denen mit Anordnung {2} ein Zeichen "
      "lesbar ist, ist es keines: Licht im Rauch verschleiert es.",
      "L’implantation {0} a plus de lumière, et depuis {1} places d’où un panneau est lisible avec "
      "l’implantation {2} aucun ne l’est : la lumière dans la fumée le voile."}},
    {"design.smoke_interrupted",
     {"Interrupted before all layouts were judged.",
      "Unterbrochen, bevor alle Anordnungen beurteilt waren.",
      "Interrompu avant que toutes les implantations soient jugées."}},
    {"design.smoke_time",
     {"Time ended the comparison after round {0} of paths: layouts {1} cannot be told apart yet "
      "from those that are read from more places or cost less.",
      "Die Zeit hat den Vergleich nach Runde {0} von Strahlen beendet: die Anordnungen {1} sind "
      "noch nicht von denen zu unterscheiden, die von mehr Orten lesbar sind oder weniger kosten.",
      "Le temps a mis fin à la comparaison après le tour {0} de chemins : les implantations {1} ne "
      "se distinguent pas encore de celles qui sont lisibles depuis plus de places ou coûtent "
      "moins."}},
    {"design.smoke_rounds",
     {"After the last round of paths ({0}) layouts {1} cannot be told apart from those that are "
      "read "
      "from more places or cost less.",
      "Nach der letzten Runde von Strahlen ({0}) sind die Anordnungen {1} nicht von denen zu "
      "unterscheiden, die von mehr Orten lesbar sind oder weniger kosten.",
      "Après le dernier tour de chemins ({0}), les implantations {1} ne se distinguent pas de "
      "celles "
      "qui sont lisibles depuis plus de places ou coûtent moins."}},
    {"design.smoke_until", {"Guides until", "Führt bis", "Guide jusqu’à"}},
    {"design.smoke_until_never", {"never", "nie", "jamais"}},
    {"design.smoke_until_s", {"{0} s", "{0} s", "{0} s"}},
    {"design.smoke_until_range", {"{0} to {1} s", "{0} bis {1} s", "{0} à {1} s"}},
    {"design.smoke_until_up_to", {"{0} s at most", "höchstens {0} s", "{0} s au plus"}},
    {"design.smoke_until_last",
     {"{0} s, the last state", "{0} s, dem letzten Zustand", "{0} s, le dernier état"}},
    {"design.smoke_until_label", {"{0}, until {1}", "{0}, bis {1}", "{0}, jusqu’à {1}"}},
    {"design.smoke_until_first",
     {"With layout {0} signs guide from every place of every route until {1}.",
      "Mit Anordnung {0} führen Zeichen von jedem Ort jedes Weges bis {1}.",
      "Avec l’implantation {0}, des panneaux guident depuis chaque place de chaque itinéraire "
      "jusqu’à {1}."}},
    {"design.smoke_until_no",
     {"With layout {0} signs do not guide from every place of the routes in any state.",
      "Mit Anordnung {0} führen Zeichen in keinem Zustand von jedem Ort der Wege.",
      "Avec l’implantation {0}, les panneaux ne guident dans aucun état depuis chaque place des "
      "itinéraires."}},
    {"design.smoke_until_note",
     {"A layout guides until the last state of the scene up to which a sign that leads along is "
      "read from every place of every route, at all eye heights; a range is what the paths leave "
      "undecided. Between two states the worse holds. Albedo and extinction of the smoke are taken "
      "as stated. It is no analysis of available and required safe egress time.",
      "Eine Anordnung führt bis zum letzten Zustand der Szene, bis zu dem von jedem Ort jedes "
      "Weges in allen Augenhöhen ein Zeichen lesbar ist, das weiterführt; ein Bereich ist, was die "
      "Strahlen offen lassen. Zwischen zwei Zuständen gilt der schlechtere. Albedo und Extinktion "
      "des Rauchs gelten wie angegeben. Es ist keine Analyse der verfügbaren und der nötigen Zeit "
      "zur Räumung.",
      "Une implantation guide jusqu’au dernier état de la scène jusqu’auquel un panneau qui mène "
      "plus loin est lisible depuis chaque place de chaque itinéraire, à toutes les hauteurs "
      "d’œil ; une plage est ce que les chemins laissent indécis. Entre deux états vaut le pire. "
      "Albédo et extinction de la fumée sont pris comme indiqués. Ce n’est pas une analyse des "
      "temps disponible et nécessaire à l’évacuation."}},
    {"design.smoke_plot",
     {"What is read in smoke, against what it takes", "Was im Rauch lesbar ist, gegen den Aufwand",
      "Ce qui est lisible dans la fumée, selon l’effort"}},
    {"design.smoke_plot_note",
     {"Error bars reach from “undecided is not read” to “undecided is read”.",
      "Die Balken reichen von „Unentschiedenes ist nicht lesbar“ bis „ist lesbar“.",
      "Les barres vont de « l’indécis n’est pas lu » à « l’indécis est lu »."}},
    {"design.smoke_axis",
     {"routes from which a sign is read [%]", "Wege, von denen ein Zeichen lesbar ist [%]",
      "itinéraires d’où un panneau est lisible [%]"}},
    {"design.smoke_front",
     {"none is read more for no more", "keine ist lesbarer bei gleichem Aufwand",
      "aucune n’est plus lisible pour autant"}},
    {"design.smoke_others", {"other layouts", "andere Anordnungen", "autres implantations"}},
    {"design.smoke_bright", {"brighter signs", "hellere Zeichen", "panneaux plus lumineux"}},
    {"design.smoke_low", {"low-level signs", "bodennahe Zeichen", "panneaux bas"}},
    {"design.smoke_low_row",
     {"{0}, low-level signs too", "{0}, auch bodennahe Zeichen", "{0}, aussi des panneaux bas"}},
    {"design.smoke_bright_row",
     {"{0}, brighter signs", "{0}, hellere Zeichen", "{0}, panneaux plus lumineux"}},
    {"design.smoke_layout", {"Layout", "Anordnung", "Implantation"}},
    {"design.smoke_read",
     {"A sign ahead is read from", "Ein Zeichen voraus ist lesbar von",
      "Un panneau est lisible depuis"}},
    {"design.smoke_cost", {"Cost", "Kosten", "Coût"}},
    {"design.smoke_watts", {"Power", "Leistung", "Puissance"}},
    {"design.smoke_beyond_first", {"Beside A", "Gegen A", "Face à A"}},
    {"design.smoke_file", {"File", "Datei", "Fichier"}},
    {"design.smoke_note",
     {"Of the length of all routes, at all eye heights of the scene. A sign is ahead within {0} "
      "degrees of the way. ● marks layouts than which no other is read from more for no more. All "
      "pass the rules that luminaires decide, at their planned places; off these alone A was "
      "looked at. “Beside A” is by how much more is read than with A, within two standard errors. "
      "Where the same paths show both layouts they err alike, and it is known better than either "
      "share.",
      "Von der Länge aller Wege, in allen Augenhöhen der Szene. Ein Zeichen ist voraus innerhalb "
      "von {0} Grad vom Weg. ● bezeichnet Anordnungen, zu denen keine mit gleichem Aufwand "
      "lesbarer ist. Alle erfüllen die Regeln, über die Leuchten entscheiden, an ihren geplanten "
      "Orten; daneben wurde nur A betrachtet. „Gegen A“ ist, um wie viel mehr als mit A lesbar "
      "ist, "
      "innerhalb von zwei Standardfehlern. Wo dieselben Strahlen beide Anordnungen "
      "zeigen, irren sie gleich, und es ist genauer bekannt als jeder Anteil.",
      "De la longueur de tous les itinéraires, à toutes les hauteurs d’œil de la scène. Un panneau "
      "est devant à {0} degrés du chemin au plus. ● marque les implantations dont aucune autre "
      "n’est plus lisible pour autant. Toutes respectent les règles que les luminaires "
      "décident, aux places prévues ; à côté de celles-ci, seule A a été examinée. « Face à A » "
      "est "
      "de combien on lit plus qu’avec A, à deux erreurs types près. Où les mêmes chemins montrent "
      "les deux implantations, ils se trompent autant, et c’est mieux connu que chaque part."}},
    {"design.left_no_wall",
     {"{0} where no wall is flat", "{0}, wo keine Wand eben ist", "{0} où aucun mur n’est plan"}},
    {"design.left_glaring", {"{0} glaring (E8)", "{0} blendend (E8)", "{0} éblouissants (E8)"}},
};

}  // namespace

std::span<const ReportText> design_texts() {
  return design_rows;
}

}  // namespace luxodus
