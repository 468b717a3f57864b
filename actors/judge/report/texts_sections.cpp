// The sections of a report: schedules, routes, what people read, inputs, clauses, method.
#include "actors/judge/report/texts.hpp"

namespace luxodus {

namespace {

constexpr ReportText sections_rows[] = {
    {"state.scenario", {"Scenario", "Szenario", "Scénario"}},
    {"state.no_scenario",
     {"none named: the scene as written", "keines genannt: die Szene wie geschrieben",
      "aucun : la scène telle quelle"}},
    {"state.operation", {"Operation", "Betrieb", "Fonctionnement"}},
    {"state.seconds",
     {"Time after the failure of the mains", "Zeit nach dem Netzausfall",
      "Temps après la coupure du secteur"}},
    {"state.seconds_unsaid",
     {"not stated: luminaires are taken as fully on",
      "nicht angegeben: Leuchten gelten als ganz eingeschaltet",
      "non indiqué : luminaires supposés en pleine lumière"}},
    {"state.luminaires", {"Luminaires", "Leuchten", "Luminaires"}},
    {"state.lit", {"{0} of {1} lit", "{0} von {1} an", "{0} sur {1} allumés"}},
    {"state.smoke", {"Smoke (extinction)", "Rauch (Extinktion)", "Fumée (extinction)"}},
    {"state.no_smoke", {"none", "keiner", "aucune"}},
    {"state.at_wavelength", {" at {0} nm", " bei {0} nm", " à {0} nm"}},
    {"state.rules", {"Rule sets", "Regelwerke", "Référentiels"}},
    {"state.deviations",
     {"National deviations", "Nationale Abweichungen", "Dérogations nationales"}},
    {"state.no_deviations", {"none", "keine", "aucune"}},
    {"state.doors_open", {"Doors open", "Offene Türen", "Portes ouvertes"}},
    {"state.doors_closed", {"Doors closed", "Geschlossene Türen", "Portes fermées"}},
    {"state.remarks", {"Remarks", "Bemerkungen", "Remarques"}},
    {"column.type", {"Type", "Typ", "Type"}},
    {"column.luminaire", {"Luminaire, file", "Leuchte, Datei", "Luminaire, fichier"}},
    {"column.operation", {"Operation", "Betrieb", "Fonctionnement"}},
    {"column.mains_flux", {"Mains flux", "Lichtstrom Netz", "Flux secteur"}},
    {"column.emergency_flux", {"Emergency flux", "Lichtstrom Not", "Flux de secours"}},
    {"column.maintenance", {"Maint. factor", "Wartungs\u00adfaktor", "Facteur maint."}},
    {"column.duration", {"End of duration", "Ende der Dauer", "Fin d’auto\u00adnomie"}},
    {"column.count", {"Count", "Anzahl", "Nombre"}},
    {"column.number", {"No.", "Nr.", "N°"}},
    {"column.sign", {"Sign", "Zeichen", "Panneau"}},
    {"column.face", {"Face", "Bild", "Face"}},
    {"column.lighting", {"Lighting", "Beleuchtung", "Éclairage"}},
    {"column.size", {"Width × height [m]", "Breite × Höhe [m]", "Largeur × hauteur [m]"}},
    {"column.detail", {"Smallest detail [mm]", "Kleinstes Detail [mm]", "Plus petit détail [mm]"}},
    {"column.sign_luminance",
     {"White / green [cd/m²]", "Weiß / Grün [cd/m²]", "Blanc / vert [cd/m²]"}},
    {"column.position", {"Position [m]", "Lage [m]", "Position [m]"}},
    {"column.bearing", {"Faces", "Blick", "Vers"}},
    {"column.mark", {"Type / no.", "Typ / Nr.", "Type / n°"}},
    {"column.item", {"Item", "Artikel", "Article"}},
    {"column.kind", {"Kind", "Art", "Genre"}},
    {"column.verdict", {"Verdict", "Ergebnis", "Verdict"}},
    {"column.check", {"Check", "Prüfung", "Contrôle"}},
    {"column.value", {"Value", "Wert", "Valeur"}},
    {"column.limit", {"Limit", "Grenzwert", "Limite"}},
    {"column.margin", {"Margin", "Reserve", "Marge"}},
    {"column.worst_at", {"Worst at [m]", "Schlechteste Stelle [m]", "Au pire en [m]"}},
    {"column.remark", {"Condition, remark", "Bedingung, Bemerkung", "Condition, remarque"}},
    {"column.eye_height", {"Eye height", "Augenhöhe", "Hauteur des yeux"}},
    {"column.from", {"From", "Von", "Depuis"}},
    {"column.distance", {"Distance", "Abstand", "Distance"}},
    {"column.reading_level",
     {"Visibility level", "Sichtbarkeits\u00adniveau", "Niveau de visibilité"}},
    {"column.simulated", {"Simulated", "Simuliert", "Simulé"}},
    {"column.luminances",
     {"Legend / ground at the eye [cd/m²]", "Schrift / Grund am Auge [cd/m²]",
      "Légende / fond à l’œil [cd/m²]"}},
    {"column.transmission", {"Trans\u00admission", "Trans\u00admission", "Trans\u00admission"}},
    {"column.jin", {"Jin, V = C/K", "Jin, V = C/K", "Jin, V = C/K"}},
    {"column.viewing", {"Viewing distance", "Erkennungs\u00adweite", "Distance de reconn."}},
    {"column.material", {"Material", "Material", "Matériau"}},
    {"column.reflectance", {"Reflec\u00adtance", "Reflexions\u00adgrad", "Réflec\u00adtance"}},
    {"column.specular", {"Specular", "Spiegelnd", "Spéculaire"}},
    {"column.internal_transmittance",
     {"Internal trans\u00admittance", "Rein\u00adtransmissions\u00adgrad",
      "Trans\u00admittance interne"}},
    {"column.ior", {"Refractive index", "Brechzahl", "Indice"}},
    {"column.surfaces", {"Surfaces", "Flächen", "Surfaces"}},
    {"column.medium", {"Medium", "Medium", "Milieu"}},
    {"column.heights", {"z [m]", "z [m]", "z [m]"}},
    {"column.extinction", {"Extinction", "Extinktion", "Extinction"}},
    {"column.wavelength", {"at [nm]", "bei [nm]", "à [nm]"}},
    {"column.angstrom", {"Ångström exponent", "Ångström-Exponent", "Exposant d’Ång\u00adström"}},
    {"column.albedo", {"Albedo", "Albedo", "Albédo"}},
    {"column.asymmetry", {"g", "g", "g"}},
    {"column.flame", {"Flame", "Flamme", "Flamme"}},
    {"column.rule", {"Rule", "Regel", "Règle"}},
    {"column.edition", {"Edition", "Ausgabe", "Édition"}},
    {"column.clause", {"Clause", "Abschnitt", "Article"}},
    {"column.asks", {"What it is about", "Worum es geht", "Objet"}},
    {"column.source", {"Quoted from", "Zitiert nach", "Cité d’après"}},
    {"column.status", {"Status of the source", "Stand der Quelle", "Statut de la source"}},
    {"column.verdicts", {"Checks", "Prüfungen", "Contrôles"}},
    {"column.what", {"What", "Was", "Quoi"}},
    {"column.why", {"Why", "Warum", "Pourquoi"}},
    {"lamp.opening", {"luminous opening {0}", "leuchtende Öffnung {0}", "ouverture lumineuse {0}"}},
    {"sign.plain", {"plain", "einfarbig", "unie"}},
    {"sign.double_sided", {", double-sided", ", zweiseitig", ", double face"}},
    {"sign.height", {"{0} m above floor", "{0} m über Boden", "à {0} m du sol"}},
    {"schedule.luminaires", {"Luminaires", "Leuchten", "Luminaires"}},
    {"schedule.signs", {"Signs", "Zeichen", "Panneaux"}},
    {"schedule.materials", {"Bill of materials", "Materialliste", "Quantitatif"}},
    {"schedule.no_luminaires",
     {"The scene has no luminaires.", "Die Szene hat keine Leuchten.",
      "La scène n’a pas de luminaires."}},
    {"schedule.no_signs",
     {"The scene has no signs.", "Die Szene hat keine Zeichen.", "La scène n’a pas de panneaux."}},
    {"schedule.luminaires_note",
     {"Fluxes contain the factors beside them: both the maintenance factor, the emergency flux "
      "also "
      "what is left of it at the end of the rated duration. Coordinates in metres (x; y; z) in the "
      "scene’s axes.",
      "Die Lichtströme enthalten die Faktoren daneben: beide den Wartungsfaktor, der Notlichtstrom "
      "auch, was am Ende der Bemessungsbetriebsdauer bleibt. Koordinaten in Metern (x; y; z) in "
      "den Achsen der Szene.",
      "Les flux contiennent les facteurs indiqués : tous deux le facteur de maintenance, le flux "
      "de "
      "secours aussi ce qui en reste en fin d’autonomie. Coordonnées en mètres (x ; y ; z) dans "
      "les "
      "axes de la scène."}},
    {"schedule.signs_note",
     {"Luminances are along the normal, in emergency operation. The direction that a sign faces is "
      "counted clockwise from north.",
      "Leuchtdichten in Richtung der Normalen bei Notbetrieb. Die Blickrichtung eines Zeichens "
      "zählt von Norden im Uhrzeigersinn.",
      "Luminances selon la normale, en fonctionnement de secours. La direction vers laquelle un "
      "panneau regarde est comptée depuis le nord dans le sens horaire."}},
    {"places.lead",
     {"Direct light of the emergency luminaires at the end of the rated duration, in clear air and "
      "without reflections, as the codes ask. The margin is the distance from the limit as a share "
      "of it.",
      "Direktes Licht der Notleuchten am Ende der Bemessungsbetriebsdauer, in klarer Luft und ohne "
      "Reflexionen, wie die Normen es verlangen. Die Reserve ist der Abstand vom Grenzwert als "
      "dessen Anteil.",
      "Lumière directe des luminaires de secours en fin d’autonomie, en air clair et sans "
      "réflexions, comme les normes le demandent. La marge est l’écart à la limite, rapporté à "
      "elle."}},
    {"places.none",
     {"The scene names no route and no area.", "Die Szene nennt weder Wege noch Bereiche.",
      "La scène ne nomme ni chemin ni espace."}},
    {"sights.none",
     {"Not judged: the codes alone were asked for, or there is nobody to read a sign.",
      "Nicht bewertet: nur die Normen waren verlangt, oder niemand ist da, der ein Zeichen liest.",
      "Non évalué : seules les normes étaient demandées, ou personne n’est là pour lire un "
      "panneau."}},
    {"sights.lead",
     {"With all light and all smoke of the scenario. Lengths are of routes, areas are floors that "
      "people cross; each place counts with the best of its signs.",
      "Mit allem Licht und allem Rauch des Szenarios. Längen sind die von Wegen, Flächen die, über "
      "die Menschen gehen; jede Stelle zählt mit ihrem besten Zeichen.",
      "Avec toute la lumière et toute la fumée du scénario. Les longueurs sont celles des chemins, "
      "les surfaces celles que l’on traverse ; chaque lieu compte avec son meilleur panneau."}},
    {"sights.observers", {"Observers", "Beobachter", "Observateurs"}},
    {"sights.sweep", {"Density of the smoke", "Dichte des Rauchs", "Densité de la fumée"}},
    {"sights.sweep_lead",
     {"From how many places each sign is legible when all smoke is so many times as dense.",
      "Von wie vielen Stellen jedes Zeichen lesbar ist, wenn aller Rauch so viel dichter ist.",
      "De combien de lieux chaque panneau est lisible quand toute la fumée est autant de fois plus "
      "dense."}},
    {"column.route", {"Route", "Weg", "Chemin"}},
    {"column.guided", {"Guided", "Geführt", "Guidé"}},
    {"column.guided_jin", {"By Jin's law", "Nach Jin", "Selon Jin"}},
    {"column.guided_line", {"By lines of sight", "Nach Sichtlinien", "Selon lignes de vue"}},
    {"column.guided_fds", {"By FDS", "Nach FDS", "Selon FDS"}},
    {"guided.line_note",
     {"By lines of sight (the method of FDSVismap): a sign counts as read where nothing stands on "
      "the level line to it and C/K of the mean extinction on that line, at most 30 m, times the "
      "cosine of the angle of view, is no less than the distance on the plan.",
      "Nach Sichtlinien (das Verfahren von FDSVismap): Ein Zeichen gilt als gelesen, wo nichts auf "
      "der waagerechten Linie zu ihm steht und C/K der mittleren Extinktion auf ihr, höchstens "
      "30 m, mal dem Kosinus des Blickwinkels, nicht kleiner ist als der Abstand im Grundriss.",
      "Selon lignes de vue (la méthode de FDSVismap) : un signal compte comme lu si rien ne se "
      "trouve sur la ligne horizontale vers lui et si C/K de l’extinction moyenne sur elle, 30 m "
      "au plus, fois le cosinus de l’angle de vue, n’est pas inférieur à la distance en plan."}},
    {"guided.fds_note",
     {"By FDS: a sign counts as read from places that are no farther from it than the VISIBILITY "
      "of "
      "FDS there, which knows neither sign nor light. Without its value a place is undecided.",
      "Nach FDS: Ein Zeichen gilt als gelesen, wenn es nicht weiter entfernt ist als die "
      "VISIBILITY "
      "von FDS an diesem Ort, die weder Zeichen noch Licht kennt. Ohne ihren Wert ist ein Ort "
      "unentschieden.",
      "Selon FDS : un signal compte comme lu s’il n’est pas plus loin que la VISIBILITY de FDS en "
      "ce "
      "lieu, qui ne connaît ni signal ni lumière. Sans sa valeur, un lieu est indécis."}},
    {"column.lost_at", {"Lost at", "Verloren bei", "Perdu à"}},
    {"column.start", {"Sets out", "Geht los", "Part à"}},
    {"column.walk", {"How far", "Wie weit", "Jusqu’où"}},
    {"guided.lead",
     {"A place of a route is guided if a sign ahead, within 60° of the way, that leads to this "
      "route "
      "and points along it is legible. Undecided, hidden and not assessed count as not guided. A "
      "route is guided up to the last state up to which every place was guided. Between two states "
      "the worse holds: guidance is lost somewhere between the two times.",
      "Eine Stelle eines Weges ist geführt, wenn ein Zeichen voraus, bis 60° neben dem Weg, das zu "
      "diesem Weg gehört und ihn entlang weist, lesbar ist. Unentschieden, verdeckt und nicht "
      "beurteilt gelten als nicht geführt. Ein Weg ist geführt bis zum letzten Zustand, bis zu dem "
      "jede Stelle geführt war. Zwischen zwei Zuständen gilt der schlechtere: die Führung geht "
      "zwischen den beiden Zeiten verloren.",
      "Un lieu d’un chemin est guidé si un panneau devant, à 60° au plus du chemin, qui mène à ce "
      "chemin et indique son sens, est lisible. Indécis, caché et non évalué comptent comme non "
      "guidé. Un chemin est guidé jusqu’au dernier état jusqu’auquel chaque lieu l’était. Entre "
      "deux "
      "états le pire vaut : le guidage se perd entre les deux instants."}},
    {"guided.no_aset",
     {"This is no analysis of available and required safe egress time (ASET/RSET): heat, gases and "
      "when people set out are not in it.",
      "Das ist keine Analyse von verfügbarer und benötigter Räumungszeit (ASET/RSET): Wärme, Gase "
      "und wann Menschen losgehen, sind nicht darin.",
      "Ceci n’est pas une analyse des temps d’évacuation disponible et nécessaire (ASET/RSET) : "
      "chaleur, gaz et moment du départ n’y figurent pas."}},
    {"guided.holds_for",
     {"Guided is what holds for albedos of the smoke from {0} to {1}, and for optical depths up to "
      "{2} "
      "% larger. What holds for a part of them is undecided.",
      "Geführt ist, was für Albedos des Rauchs von {0} bis {1} gilt und für bis zu {2} % größere "
      "optische Dicken. Was nur für einen Teil davon gilt, ist unentschieden.",
      "Est guidé ce qui vaut pour des albédos de la fumée de {0} à {1} et pour des épaisseurs "
      "optiques jusqu’à {2} % plus grandes. Ce qui ne vaut que pour une partie est indécis."}},
    {"guided.never",
     {"not from the first state on", "nicht vom ersten Zustand an", "pas dès le premier état"}},
    {"guided.always",
     {"up to the last state, {0} s", "bis zum letzten Zustand, {0} s",
      "jusqu’au dernier état, {0} s"}},
    {"guided.until",
     {"up to {0} s, lost by {1} s", "bis {0} s, verloren bis {1} s",
      "jusqu’à {0} s, perdu à {1} s"}},
    {"guided.map", {"{0}, eyes at {1} m.", "{0}, Augen in {1} m Höhe.", "{0}, yeux à {1} m."}},
    {"guided.map_note",
     {"Colours from one state to the next are those of the worse. Lines are people who set out.",
      "Von einem Zustand zum nächsten gilt die Farbe des schlechteren. Linien sind Menschen, die "
      "losgehen.",
      "D’un état au suivant la couleur est celle du pire. Les lignes sont des personnes qui "
      "partent."}},
    {"guided.along", {"along the route [m]", "entlang des Weges [m]", "le long du chemin [m]"}},
    {"guided.time", {"time [s]", "Zeit [s]", "temps [s]"}},
    {"guided.guided", {"guided", "geführt", "guidé"}},
    {"guided.undecided", {"undecided", "unentschieden", "indécis"}},
    {"guided.not_guided", {"not guided", "nicht geführt", "non guidé"}},
    {"guided.walks", {"People who walk", "Menschen, die gehen", "Personnes qui marchent"}},
    {"guided.walks_lead",
     {"At {0} m/s, from the beginning of the route.", "Mit {0} m/s, vom Anfang des Weges.",
      "À {0} m/s, du début du chemin."}},
    {"walk.arrives",
     {"guided to the end, at {0} s", "geführt bis zum Ende, um {0} s",
      "guidé jusqu’au bout, à {0} s"}},
    {"walk.lost",
     {"guidance is lost at {0} m, at {1} s", "die Führung geht bei {0} m verloren, um {1} s",
      "le guidage se perd à {0} m, à {1} s"}},
    {"walk.unknown",
     {"still on the way after the last state, at {0} m, at {1} s",
      "nach dem letzten Zustand noch unterwegs, bei {0} m, um {1} s",
      "encore en chemin après le dernier état, à {0} m, à {1} s"}},
    {"sights.of", {"{0} of {1}", "{0} von {1}", "{0} sur {1}"}},
    {"sights.pictures", {"Pictures from the eye", "Bilder vom Auge aus", "Images depuis l’œil"}},
    {"sights.no_pictures",
     {"There are no pictures of this state yet. These commands make them:",
      "Von diesem Zustand gibt es noch keine Bilder. Diese Befehle machen sie:",
      "Il n’y a pas encore d’images de cet état. Ces commandes les font :"}},
    {"sights.no_cameras",
     {"The scene has no [[camera]] to make pictures from.",
      "Die Szene hat keine [[camera]], von der Bilder gemacht werden.",
      "La scène n’a pas de [[camera]] dont on fasse des images."}},
    {"sights.add_cameras",
     {"From these places signs are read worst; added to the scene, these cameras show them:",
      "Von diesen Stellen sind Zeichen am schlechtesten zu lesen; diese Kameras, in der Szene "
      "ergänzt, zeigen es:",
      "De ces lieux les panneaux se lisent le moins bien ; ces caméras, ajoutées à la scène, les "
      "montrent :"}},
    {"sights.other_pictures",
     {"{0} pictures in the folder are of another scene or scenario and are left out.",
      "{0} Bilder im Ordner zeigen eine andere Szene oder ein anderes Szenario und sind "
      "ausgelassen.",
      "{0} images du dossier montrent une autre scène ou un autre scénario et sont omises."}},
    {"sights.by_sign",
     {"Of how much of the routes [m] and areas [m²] that a sign faces it has which verdict.",
      "Von wie viel der Wege [m] und Bereiche [m²], denen ein Zeichen zugewandt ist, es welches "
      "Ergebnis hat.",
      "De combien des chemins [m] et espaces [m²] que regarde un panneau il a quel verdict."}},
    {"sights.eyes_at", {"Eyes at {0} m", "Augen auf {0} m", "Yeux à {0} m"}},
    {"sights.maps",
     {"Where each sign is read, eyes at {0} m", "Wo jedes Zeichen gelesen wird, Augen auf {0} m",
      "Où chaque panneau est lu, yeux à {0} m"}},
    {"thumb.none",
     {"Nowhere: the simulation and the rules of thumb agree wherever both speak.",
      "Nirgends: Simulation und Faustregeln stimmen überein, wo beide etwas sagen.",
      "Nulle part : la simulation et les règles empiriques s’accordent partout où les deux "
      "parlent."}},
    {"thumb.lead",
     {"At {0} places Jin’s law or the codes’ viewing distance says otherwise than the simulation. "
      "These {1} differ most, by how far the visibility level of the smallest detail is from 7, "
      "from which it is read. What differs is in bold.",
      "An {0} Stellen sagt das Gesetz von Jin oder die Erkennungsweite der Normen etwas anderes "
      "als "
      "die Simulation. Diese {1} weichen am stärksten ab, gemessen daran, wie weit das "
      "Sichtbarkeitsniveau des kleinsten Details von 7 entfernt ist, ab dem es gelesen wird. Was "
      "abweicht, ist fett.",
      "En {0} lieux, la loi de Jin ou la distance de reconnaissance des normes contredit la "
      "simulation. Ces {1} divergent le plus, selon l’écart du niveau de visibilité du plus petit "
      "détail à 7, à partir duquel il est lu. Ce qui diverge est en gras."}},
    {"thumb.legible", {"legible", "lesbar", "lisible"}},
    {"thumb.near", {"near enough", "nah genug", "assez près"}},
    {"thumb.too_far", {"too far", "zu weit", "trop loin"}},
    {"thumb.cut",
     {"The first {0} of {1}; all are in sights.csv.",
      "Die ersten {0} von {1}; alle stehen in "
      "sights.csv.",
      "Les {0} premiers de {1} ; tous sont dans sights.csv."}},
    {"inputs.age", {"Age of the eyes", "Alter der Augen", "Âge des yeux"}},
    {"inputs.years", {"{0} years", "{0} Jahre", "{0} ans"}},
    {"inputs.spacing",
     {"Distance between people on routes", "Abstand der Menschen auf Wegen",
      "Distance entre personnes sur les chemins"}},
    {"inputs.irritant", {"Smoke that stings", "Reizender Rauch", "Fumée irritante"}},
    {"inputs.grid", {"Grid of calculation", "Berechnungsraster", "Grille de calcul"}},
    {"inputs.grid_text",
     {"{0} m on routes, {1} m in areas, {2} m above the floor",
      "{0} m auf Wegen, {1} m in Bereichen, {2} m über dem Boden",
      "{0} m sur les chemins, {1} m dans les espaces, {2} m au-dessus du sol"}},
    {"inputs.factors", {"Factors", "Faktoren", "Facteurs"}},
    {"inputs.factors_text",
     {"maintenance and end-of-duration factors are stated for each luminaire in its schedule; none "
      "is assumed",
      "Wartungsfaktor und Faktor am Ende der Dauer sind je Leuchte in der Stückliste angegeben; "
      "keiner ist angenommen",
      "les facteurs de maintenance et de fin d’autonomie sont indiqués pour chaque luminaire dans "
      "la nomenclature ; aucun n’est supposé"}},
    {"inputs.scenario_media",
     {"Media in this scenario", "Medien in diesem Szenario", "Milieux dans ce scénario"}},
    {"inputs.scenario_circuits",
     {"Circuits in this scenario", "Stromkreise in diesem Szenario", "Circuits dans ce scénario"}},
    {"inputs.materials", {"Materials", "Materialien", "Matériaux"}},
    {"inputs.materials_note",
     {"Reflectances and transmittances are weighed by V(λ) in equal-energy light.",
      "Reflexions- und Transmissionsgrade sind mit V(λ) im energiegleichen Licht gewichtet.",
      "Réflectances et transmittances sont pondérées par V(λ) en lumière équi-énergétique."}},
    {"inputs.media", {"Smoke and flames", "Rauch und Flammen", "Fumée et flammes"}},
    {"inputs.media_note",
     {"As the scene states them; factors of the scenario are above. Extinction changes with "
      "wavelength to the power of the Ångström exponent.",
      "Wie die Szene sie angibt; Faktoren des Szenarios stehen oben. Die Extinktion ändert sich "
      "mit "
      "der Wellenlänge hoch dem Ångström-Exponenten.",
      "Comme la scène les donne ; les facteurs du scénario sont plus haut. L’extinction varie "
      "comme "
      "la longueur d’onde à la puissance de l’exposant d’Ångström."}},
    {"clauses.none",
     {"No clause was applied.", "Kein Abschnitt wurde angewandt.",
      "Aucun article n’a été appliqué."}},
    {"clauses.lead",
     {"Every rule that was applied. Secondary: the limit was read in a text that quotes the "
      "standard. Recollection: it was read nowhere, so that a check against it can neither pass "
      "nor "
      "fail.",
      "Jede angewandte Regel. Sekundär: der Grenzwert wurde in einem Text gelesen, der die Norm "
      "zitiert. Aus Erinnerung: er wurde nirgends gelesen, so dass eine Prüfung gegen ihn weder "
      "bestanden noch nicht bestanden sein kann.",
      "Chaque règle appliquée. Secondaire : la limite a été lue dans un texte qui cite la norme. "
      "De "
      "mémoire : elle n’a été lue nulle part ; un contrôle contre elle ne peut être ni satisfait "
      "ni "
      "non satisfait."}},
    {"not_assessed.lead",
     {"What the rule sets ask and this assessment could not answer, and why.",
      "Was die Regelwerke verlangen und diese Bewertung nicht beantworten konnte, und warum.",
      "Ce que les référentiels demandent et à quoi cette évaluation n’a pu répondre, et "
      "pourquoi."}},
    {"not_assessed.nothing",
     {"Nothing of what the rule sets ask was left out.",
      "Nichts von dem, was die Regelwerke verlangen, wurde ausgelassen.",
      "Rien de ce que les référentiels demandent n’a été omis."}},
    {"not_assessed.beyond",
     {"Beyond any such assessment are:", "Außerhalb jeder solchen Bewertung liegen:",
      "Hors de toute évaluation de ce genre :"}},
    {"beyond.egress",
     {"available and required safe egress time, walking speeds, crowds",
      "verfügbare und erforderliche Räumungszeit, Gehgeschwindigkeiten, Gedränge",
      "temps d’évacuation disponible et requis, vitesses de marche, foules"}},
    {"beyond.noticing",
     {"whether people notice a sign that they could read, and whether they understand it",
      "ob Menschen ein Zeichen bemerken, das sie lesen könnten, und ob sie es verstehen",
      "si les personnes remarquent un panneau qu’elles pourraient lire, et si elles le "
      "comprennent"}},
    {"beyond.toxicity",
     {"toxicity, heat and how smoke spreads: its density is an input",
      "Giftigkeit, Hitze und Ausbreitung des Rauchs: seine Dichte ist eine Eingabe",
      "toxicité, chaleur et propagation de la fumée : sa densité est une donnée"}},
    {"beyond.installation",
     {"wiring, batteries, tests and maintenance of the installation",
      "Verkabelung, Batterien, Prüfung und Wartung der Anlage",
      "câblage, batteries, essais et maintenance de l’installation"}},
    {"beyond.texts",
     {"clauses of the standards that geometry and photometry cannot decide",
      "Abschnitte der Normen, die Geometrie und Photometrie nicht entscheiden können",
      "articles des normes que ni géométrie ni photométrie ne tranchent"}},
    {"method.codes",
     {"Codes: direct light of the emergency luminaires from their photometric data, without "
      "reflections and smoke, at the end of the rated duration and with the maintenance factor; "
      "with furniture and without it. Points on routes are {0} m apart, in areas {1} m.",
      "Normen: direktes Licht der Notleuchten aus ihren photometrischen Daten, ohne Reflexionen "
      "und "
      "Rauch, am Ende der Bemessungsbetriebsdauer und mit dem Wartungsfaktor; mit Möbeln und ohne. "
      "Punkte auf Wegen liegen {0} m auseinander, in Bereichen {1} m.",
      "Normes : lumière directe des luminaires de secours d’après leurs données photométriques, "
      "sans réflexions ni fumée, en fin d’autonomie et avec le facteur de maintenance ; avec et "
      "sans mobilier. Les points des chemins sont distants de {0} m, ceux des espaces de {1} m."}},
    {"method.signs",
     {"Signs: luminances that arrive at the eye with all light and smoke of the scenario, by Monte "
      "Carlo paths traced from the eyes. Errors are standard errors; a verdict is given where it "
      "holds by two of them.",
      "Zeichen: Leuchtdichten, die mit allem Licht und Rauch des Szenarios am Auge ankommen, durch "
      "Monte-Carlo-Pfade von den Augen aus. Fehler sind Standardfehler; ein Ergebnis gilt, wo es "
      "um zwei davon feststeht.",
      "Panneaux : luminances qui arrivent à l’œil avec toute la lumière et la fumée du scénario, "
      "par des trajets de Monte-Carlo tracés depuis les yeux. Les erreurs sont des erreurs types ; "
      "un verdict est donné s’il tient à deux d’entre elles près."}},
    {"method.legible",
     {"Legible: the smallest detail of the legend at visibility level 7 or more when looked at; "
      "thresholds by Adrian (1989) for the age above, the veil of glare by CIE 146, photopic.",
      "Lesbar: das kleinste Detail der Schrift hat beim Hinsehen ein Sichtbarkeitsniveau von 7 "
      "oder "
      "mehr; Schwellen nach Adrian (1989) für das Alter oben, Schleier der Blendung nach CIE 146, "
      "photopisch.",
      "Lisible : le plus petit détail de la légende a, quand on le regarde, un niveau de "
      "visibilité "
      "de 7 ou plus ; seuils d’Adrian (1989) pour l’âge ci-dessus, voile d’éblouissement selon "
      "CIE 146, photopique."}},
    {"method.trace", {"Traceability", "Rückverfolgbarkeit", "Traçabilité"}},
    {"method.version", {"Program", "Programm", "Programme"}},
    {"method.scene", {"Scene file", "Szenendatei", "Fichier de la scène"}},
    {"method.hash",
     {"Hash of the scene and its files", "Hash der Szene und ihrer Dateien",
      "Empreinte de la scène et de ses fichiers"}},
    {"method.seed",
     {"Seed of the random numbers", "Startwert der Zufallszahlen",
      "Graine des nombres aléatoires"}},
    {"method.paths", {"Paths from eyes", "Pfade von Augen", "Trajets depuis les yeux"}},
    {"method.seconds", {"Computing time", "Rechenzeit", "Temps de calcul"}},
    {"method.files", {"Hand-over files", "Beigefügte Dateien", "Fichiers joints"}},
    {"method.files_text",
     {"plans/ (SVG, DXF in metres), schedules/ (CSV), assessment.json, checks.csv, sights.csv",
      "plans/ (SVG, DXF in Metern), schedules/ (CSV), assessment.json, checks.csv, sights.csv",
      "plans/ (SVG, DXF en mètres), schedules/ (CSV), assessment.json, checks.csv, sights.csv"}},
};

}  // namespace

std::span<const ReportText> section_texts() {
  return sections_rows;
}

}  // namespace luxodus
