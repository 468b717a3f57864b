// What the program's checks and states say in words of their own: the English sentence, as the
// assessment holds it, with {0}, {1}, ... for its names and numbers, and what it is elsewhere.
#include "actors/judge/report/texts.hpp"

namespace luxodus {

namespace {

constexpr ReportText remarks_rows[] = {
    // Conditions of checks.
    {"",
     {"{0} s after the mains have failed", "{0} s nach dem Netzausfall",
      "{0} s après la coupure du secteur"}},
    {"",
     {"{0} of {1} points lie in bodies and are left out",
      "{0} von {1} Punkten liegen in Körpern und sind ausgelassen",
      "{0} points sur {1} se trouvent dans des corps et sont omis"}},
    // Reasons of checks.
    {"",
     {"beyond all measure: there is none, or no light at all",
      "über alle Maßen: es gibt keines, oder gar kein Licht",
      "hors de toute mesure : il n’y en a pas, ou aucune lumière"}},
    {"",
     {"no value could be computed", "es ließ sich kein Wert berechnen",
      "aucune valeur n’a pu être calculée"}},
    {"",
     {"the value keeps a limit that was read nowhere: look it up",
      "der Wert hält einen Grenzwert ein, der nirgends gelesen wurde: nachschlagen",
      "la valeur respecte une limite qui n’a été lue nulle part : à vérifier"}},
    {"",
     {"the value breaks a limit that was read nowhere: look it up",
      "der Wert verletzt einen Grenzwert, der nirgends gelesen wurde: nachschlagen",
      "la valeur enfreint une limite qui n’a été lue nulle part : à vérifier"}},
    {"",
     {"there is no emergency luminaire", "es gibt keine Notleuchte",
      "il n’y a aucun luminaire de secours"}},
    {"",
     {"there is no place to assess", "es gibt keine Stelle zu bewerten",
      "il n’y a aucun lieu à évaluer"}},
    {"",
     {"the worst of {0} single failures", "der schlimmste von {0} einzelnen Ausfällen",
      "la pire de {0} pannes isolées"}},
    {"",
     {"it is narrower than its two borders of 0.5 m: it has no core",
      "er ist schmaler als seine zwei Ränder von 0,5 m und hat keine Kernfläche",
      "il est plus étroit que ses deux bordures de 0,5 m : il n’a pas de zone centrale"}},
    {"",
     {"how fast they come on ('onset') is not said of {0}",
      "wie schnell sie angehen („onset“), ist nicht angegeben von {0}",
      "la vitesse d’allumage (« onset ») n’est pas indiquée pour {0}"}},
    {"",
     {"no luminaire says how fast it comes on ('onset')",
      "von keiner Leuchte ist angegeben, wie schnell sie angeht („onset“)",
      "aucun luminaire n’indique sa vitesse d’allumage (« onset »)"}},
    {"",
     {"not all of them say how long their supply lasts (duration_h)",
      "nicht von allen ist angegeben, wie lange ihre Versorgung reicht (duration_h)",
      "la durée d’alimentation (duration_h) n’est pas indiquée pour tous"}},
    {"",
     {"a scene says nothing of how long their batteries last",
      "wie lange ihre Batterien reichen, sagt eine Szene nicht",
      "une scène ne dit rien de l’autonomie de leurs batteries"}},
    {"",
     {"a scene says how its light is spread over wavelengths only roughly",
      "eine Szene gibt das Spektrum ihres Lichts nur grob an",
      "une scène n’indique le spectre de sa lumière que grossièrement"}},
    {"",
     {"a sign says nothing of how fast it comes on",
      "wie schnell ein Zeichen angeht, ist nicht angegeben",
      "un panneau ne dit rien de la vitesse à laquelle il s’allume"}},
    {"",
     {"the boxes of the standard are not at hand", "die Farbbereiche der Norm liegen nicht vor",
      "les domaines de couleur de la norme ne sont pas disponibles"}},
    {"",
     {"one luminance for each colour is known, not how it varies over the face: give a "
      "luminance_map",
      "je Farbe ist eine Leuchtdichte bekannt, nicht ihr Verlauf über die Fläche: luminance_map "
      "angeben",
      "une seule luminance par couleur est connue, non sa variation sur la face : donner une "
      "luminance_map"}},
    {"", {"green has no luminance", "Grün hat keine Leuchtdichte", "le vert n’a pas de luminance"}},
    {"",
     {"no route or open area lies below it: its height is not known",
      "darunter liegt kein Weg oder Bereich: die Höhe ist nicht bekannt",
      "aucun chemin ni espace ne se trouve au-dessous : sa hauteur est inconnue"}},
    {"",
     {"it is a low one, which may stand beside those above (ISO 16069)",
      "es ist ein bodennahes, das die hohen ergänzen kann (ISO 16069)",
      "c’est un panneau bas, qui peut compléter ceux du haut (ISO 16069)"}},
    {"",
     {"no sign ahead faces this place", "kein Zeichen voraus ist dieser Stelle zugewandt",
      "aucun panneau devant n’est tourné vers ce lieu"}},
    {"",
     {"a beam of parallel light has no intensity, and it points where glare counts",
      "paralleles Licht hat keine Lichtstärke, und es zielt dorthin, wo Blendung zählt",
      "un faisceau parallèle n’a pas d’intensité, et il pointe où l’éblouissement compte"}},
    {"",
     {"as if no part of the mesh hid another",
      "als ob kein Teil des Netzes einen anderen verdeckte",
      "comme si aucune partie du maillage n’en cachait une autre"}},
    {"",
     {"{0}; {1} is {2} m away, but on another storey",
      "{0}; {1} ist {2} m entfernt, aber auf einem anderen Geschoss",
      "{0} ; {1} est à {2} m, mais à un autre étage"}},
    {"",
     {"the nearest is {0}; {1} is {2} m away, but behind something solid, or shining elsewhere",
      "die nächste ist {0}; {1} ist {2} m entfernt, aber hinter etwas Festem oder anderswohin "
      "strahlend",
      "le plus proche est {0} ; {1} est à {2} m, mais derrière un obstacle ou éclairant ailleurs"}},
    {"", {"the nearest is {0}", "die nächste ist {0}", "le plus proche est {0}"}},
    {"",
     {"no emergency luminaire is in sight; {0} is {1} m away, but behind something solid, or "
      "shining elsewhere",
      "keine Notleuchte ist in Sicht; {0} ist {1} m entfernt, aber hinter etwas Festem oder "
      "anderswohin strahlend",
      "aucun luminaire de secours n’est en vue ; {0} est à {1} m, mais derrière un obstacle ou "
      "éclairant ailleurs"}},
    {"",
     {"no emergency luminaire above it is in sight; {0} is {1} m away, but behind something "
      "solid, or shining elsewhere",
      "keine Notleuchte darüber ist in Sicht; {0} ist {1} m entfernt, aber hinter etwas Festem "
      "oder anderswohin strahlend",
      "aucun luminaire de secours au-dessus n’est en vue ; {0} est à {1} m, mais derrière un "
      "obstacle ou éclairant ailleurs"}},
    {"",
     {"no emergency luminaire is above it", "keine Notleuchte ist darüber",
      "aucun luminaire de secours n’est au-dessus"}},
    {"",
     {"no emergency luminaire is there", "keine Notleuchte ist da",
      "il n’y a là aucun luminaire de secours"}},
    {"", {"'facing' is not given", "„facing“ ist nicht angegeben", "« facing » n’est pas indiqué"}},
    // Reasons of views.
    {"", {"views of signs", "Sichten auf Zeichen", "vues de panneaux"}},
    {"",
     {"only the codes were asked for", "nur die Prüfung nach den Codes war verlangt",
      "seules les vérifications selon les codes étaient demandées"}},
    {"", {"undecided: {0}", "unentschieden: {0}", "indécis : {0}"}},
    {"",
     {"visible or invisible: more paths tell (--rounds)",
      "sichtbar oder unsichtbar: mehr Pfade zeigen es (--rounds)",
      "visible ou invisible : plus de chemins le diront (--rounds)"}},
    {"",
     {"legible or not: more paths tell (--rounds)",
      "lesbar oder nicht: mehr Pfade zeigen es (--rounds)",
      "lisible ou non : plus de chemins le diront (--rounds)"}},
    {"",
     {"legible or even invisible: more paths tell (--rounds)",
      "lesbar oder gar unsichtbar: mehr Pfade zeigen es (--rounds)",
      "lisible ou même invisible : plus de chemins le diront (--rounds)"}},
    {"",
     {"the building hides a part of it: what is left may be read or not",
      "das Bauwerk verdeckt einen Teil davon: ob der Rest lesbar ist, ist offen",
      "le bâtiment en cache une partie : le reste est lisible ou non"}},
    {"",
     {"the eye is in a solid thing", "das Auge steckt in etwas Festem",
      "l’œil se trouve dans un corps solide"}},
    {"", {"it is seen edge-on", "es wird von der Kante gesehen", "il est vu par la tranche"}},
    {"",
     {"its face has one colour: there is nothing to read",
      "seine Fläche hat eine Farbe: es gibt nichts zu lesen",
      "sa face n’a qu’une couleur : il n’y a rien à lire"}},
    {"",
     {"irritant smoke: too far for eyes that sting (Jin and Yamada 1985)",
      "Reizrauch: zu weit für brennende Augen (Jin und Yamada 1985)",
      "fumée irritante : trop loin pour des yeux qui piquent (Jin et Yamada 1985)"}},
    // The judged state.
    {"", {"no luminaire is lit", "keine Leuchte brennt", "aucun luminaire n’est allumé"}},
    {"",
     {"no check could be made", "keine Prüfung war möglich",
      "aucune vérification n’a pu être faite"}},
    {"",
     {"a photoluminescent face is classed by its glow (ISO 16069, ISO 17398), which are not at "
      "hand",
      "eine nachleuchtende Fläche wird nach ihrem Nachleuchten eingestuft (ISO 16069, ISO 17398), "
      "das hier nicht vorliegt",
      "une face photoluminescente est classée par sa rémanence (ISO 16069, ISO 17398), qui ne sont "
      "pas disponibles"}},
    {"",
     {"from {0} of {1} places signs are seen through glass alone, where reflections may hide them",
      "von {0} der {1} Stellen sind Zeichen nur durch Glas zu sehen, wo Spiegelungen sie verdecken "
      "können",
      "depuis {0} des {1} lieux, les panneaux ne sont vus qu’à travers une vitre, où des reflets "
      "peuvent les cacher"}},
    {"",
     {"this state has {0} of the extinction that the scene states of {1}",
      "dieser Zustand hat {0} der Extinktion, die die Szene für {1} angibt",
      "cet état a {0} de l’extinction que la scène indique pour {1}"}},
    {"",
     {"{0} emergency luminaires are emitters of simple shape, without a photometric file: nobody "
      "has measured their intensities",
      "{0} Notleuchten sind Strahler einfacher Form ohne photometrische Datei: ihre Lichtstärken "
      "hat niemand gemessen",
      "{0} luminaires de secours sont des émetteurs de forme simple, sans fichier photométrique : "
      "personne n’a mesuré leurs intensités"}},
    {"", {"it has no letters", "es hat keine Buchstaben", "il n’a pas de lettres"}},
    {"",
     {"this code judges paths of egress: name them as [[route]]",
      "dieser Code beurteilt Fluchtwege: als [[route]] angeben",
      "ce code juge les chemins d’évacuation : les indiquer par [[route]]"}},
    {"",
     {"the scene names no escape route ([[route]])",
      "die Szene nennt keinen Rettungsweg ([[route]])",
      "la scène n’indique aucun chemin d’évacuation ([[route]])"}},
    {"",
     {"the scene names no place that a luminaire must be near to ([[emphasis]]): exits, stairs, "
      "equipment",
      "die Szene nennt keine hervorzuhebende Stelle ([[emphasis]]): Ausgänge, Treppen, "
      "Einrichtungen",
      "la scène n’indique aucun point à signaler ([[emphasis]]) : sorties, escaliers, "
      "équipements"}},
    {"",
     {"{0} emergency luminaire is not lit in this state",
      "{0} Notleuchte brennt in diesem Zustand nicht",
      "{0} luminaire de secours n’est pas allumé dans cet état"}},
    {"",
     {"{0} emergency luminaires are not lit in this state",
      "{0} Notleuchten brennen in diesem Zustand nicht",
      "{0} luminaires de secours ne sont pas allumés dans cet état"}},
    {"",
     {"the circuits of this state switch off {0} emergency luminaires and dim {1}: checks by the "
      "codes take them so, too",
      "die Stromkreise dieses Zustands schalten {0} Notleuchten aus und dimmen {1}: die Prüfungen "
      "nach den Codes nehmen sie ebenso",
      "les circuits de cet état éteignent {0} luminaires de secours et en réduisent {1} : les "
      "vérifications selon les codes les prennent ainsi"}},
    {"",
     {"the circuits of this state raise the flux of {0} emergency luminaires above what is stated: "
      "views are judged so, checks by the codes are not",
      "die Stromkreise dieses Zustands heben den Lichtstrom von {0} Notleuchten über den "
      "angegebenen: Sichten werden so beurteilt, Prüfungen nach den Codes nicht",
      "les circuits de cet état élèvent le flux de {0} luminaires de secours au-dessus de "
      "l’indiqué : les vues sont jugées ainsi, pas les vérifications"}},
    {"",
     {"the circuits of this state switch off {0} signs: checks by the codes take them as dark",
      "die Stromkreise dieses Zustands schalten {0} Zeichen aus: die Prüfungen nach den Codes "
      "nehmen "
      "sie als dunkel",
      "les circuits de cet état éteignent {0} panneaux : les vérifications selon les codes les "
      "prennent comme éteints"}},
    {"",
     {"{0} s after the failure of the mains is later than the rated duration of {1} h that the "
      "rules ask for: batteries may be empty, and luminaires are taken as lit",
      "{0} s nach dem Netzausfall ist später als die verlangte Betriebsdauer von {1} h: Batterien "
      "können leer sein, und Leuchten gelten als leuchtend",
      "{0} s après la coupure du secteur dépassent l’autonomie de {1} h exigée : les batteries "
      "peuvent être vides, et les luminaires sont pris comme allumés"}},
    {"",
     {"{0} emergency luminaires do not say how fast they come on (onset): they are taken as fully "
      "on {1} s after the failure",
      "von {0} Notleuchten ist nicht angegeben, wie schnell sie angehen (onset): sie gelten {1} s "
      "nach dem Ausfall als voll leuchtend",
      "{0} luminaires de secours n’indiquent pas leur vitesse d’allumage (onset) : ils sont pris "
      "comme pleinement allumés {1} s après la coupure"}},
    {"",
     {"the glow of sign {0} is known up to {1} s after the failure, and is extrapolated",
      "das Nachleuchten des Zeichens {0} ist bis {1} s nach dem Ausfall bekannt und wird "
      "fortgesetzt",
      "la rémanence du panneau {0} est connue jusqu’à {1} s après la coupure, et extrapolée"}},
    {"",
     {"signs are judged by eyes of {0} years: older people see less",
      "Zeichen werden mit Augen von {0} Jahren beurteilt: ältere Menschen sehen weniger",
      "les panneaux sont jugés par des yeux de {0} ans : les personnes plus âgées voient moins"}},
    {"",
     {"the highest eyes on routes are {0} m above the floor: nobody who walks upright is judged",
      "die höchsten Augen auf Wegen liegen {0} m über dem Boden: niemand geht aufrecht",
      "les yeux les plus hauts sur les chemins sont à {0} m du sol : personne ne marche debout"}},
    {"",
     {"people on routes stand {0} m apart: what is read between them is not judged",
      "Personen auf Wegen stehen {0} m auseinander: dazwischen wird nicht beurteilt",
      "les personnes sur les chemins sont espacées de {0} m : entre elles rien n’est jugé"}},
    {"",
     {"the scene has no sign: nothing is judged of what people read",
      "die Szene hat kein Zeichen: nichts ist beurteilt, was Menschen lesen",
      "la scène n’a pas de panneau : rien n’est jugé de ce que l’on lit"}},
    {"",
     {"two editions of EN 1838 are judged: their limits differ, and the one in force decides",
      "zwei Ausgaben von EN 1838 sind beurteilt: ihre Grenzwerte unterscheiden sich, die geltende "
      "entscheidet",
      "deux éditions de l’EN 1838 sont jugées : leurs limites diffèrent, celle en vigueur décide"}},
    {"",
     {"rules of Europe and of the United States are judged beside each other",
      "Regeln Europas und der Vereinigten Staaten stehen nebeneinander",
      "des règles d’Europe et des États-Unis sont jugées côte à côte"}},
    {"",
     {"as stated: no lit luminaire says that its light falls with age",
      "wie angegeben: keine brennende Leuchte nennt einen Rückgang mit dem Alter",
      "comme indiqué : aucun luminaire allumé ne dit que sa lumière baisse avec l’âge"}},
    {"",
     {"aged light (maintenance factor times end-of-duration factor down to {0} of new light) "
      "and new light of the luminaires; the worse verdict counts. Signs and flames as stated",
      "gealtertes Licht (Wartungsfaktor mal Faktor am Ende der Dauer, bis hinab zum {0}fachen "
      "des neuen) und neues Licht der Leuchten; das schlechtere Ergebnis zählt. Zeichen und "
      "Flammen wie angegeben",
      "lumière vieillie (facteur de maintenance fois facteur de fin d’autonomie, jusqu’à {0} "
      "de la neuve) et lumière neuve des luminaires ; le pire verdict compte. Panneaux et "
      "flammes comme indiqué"}},
    {"",
     {"aged light (maintenance factor down to {0} of new light) and new light of the "
      "luminaires; the worse verdict counts. Signs and flames as stated",
      "gealtertes Licht (Wartungsfaktor bis hinab zum {0}fachen des neuen) und neues Licht der "
      "Leuchten; das schlechtere Ergebnis zählt. Zeichen und Flammen wie angegeben",
      "lumière vieillie (facteur de maintenance jusqu’à {0} de la neuve) et lumière neuve des "
      "luminaires ; le pire verdict compte. Panneaux et flammes comme indiqué"}},
    {"",
     {"luminances of signs are taken as stated, in new and in aged light",
      "Leuchtdichten der Zeichen gelten wie angegeben, in neuem und in gealtertem Licht",
      "les luminances des panneaux sont prises comme indiqué, en lumière neuve et vieillie"}},
    {"",
     {"MAINS OPERATION: views of signs are judged with the mains on, not in an emergency. "
      "Checks by the codes are for emergency operation all the same",
      "NETZBETRIEB: Sichten auf Zeichen sind bei Netz bewertet, nicht im Notfall. Die Prüfungen "
      "nach den Normen gelten gleichwohl für den Notbetrieb",
      "SECTEUR : les vues de panneaux sont jugées sur secteur, non en urgence. Les contrôles "
      "selon les normes valent néanmoins pour le fonctionnement de secours"}},
    {"",
     {"neither mains nor emergency luminaires are lit in this state. Checks by the codes are "
      "for emergency operation all the same",
      "in diesem Zustand brennen weder Netz- noch Notleuchten. Die Prüfungen nach den Normen "
      "gelten gleichwohl für den Notbetrieb",
      "dans cet état aucun luminaire, de secteur ou de secours, n’est allumé. Les contrôles "
      "selon les normes valent néanmoins pour le fonctionnement de secours"}},
    {"",
     {"the scenario does not say how long after the failure of the mains it is "
      "(seconds_after_failure): luminaires are fully on, photoluminescent signs as at the "
      "failure, and eyes adapted to this light",
      "das Szenario nennt die Zeit nach dem Netzausfall nicht (seconds_after_failure): Leuchten "
      "sind ganz an, langnachleuchtende Zeichen wie beim Ausfall, Augen an dieses Licht "
      "angepasst",
      "le scénario n’indique pas le temps après la coupure (seconds_after_failure) : luminaires "
      "pleinement allumés, panneaux photoluminescents comme à la coupure, yeux adaptés à cette "
      "lumière"}},
    {"",
     {"{0} s after the failure of the mains eyes are not yet adapted: verdicts are those of "
      "adapted eyes, and people see less within the first {1} s",
      "{0} s nach dem Netzausfall sind Augen noch nicht angepasst: die Ergebnisse gelten für "
      "angepasste Augen, und in den ersten {1} s sehen Menschen weniger",
      "{0} s après la coupure les yeux ne sont pas encore adaptés : les verdicts sont ceux "
      "d’yeux adaptés, et l’on voit moins pendant les {1} premières secondes"}},
    {"",
     {"flames burn in this state, but there is no smoke around them",
      "in diesem Zustand brennen Flammen, aber ohne Rauch um sie",
      "des flammes brûlent dans cet état, mais sans fumée autour"}},
    {"",
     {"CLEAR AIR: the scene has smoke, but not in this scenario",
      "KLARE LUFT: die Szene hat Rauch, aber nicht in diesem Szenario",
      "AIR CLAIR : la scène a de la fumée, mais pas dans ce scénario"}},
    {"",
     {"{0}, times {1} in this scenario", "{0}, mal {1} in diesem Szenario",
      "{0}, fois {1} dans ce scénario"}},
    {"",
     {"{0}, a fire simulation at {1} s ({2})", "{0}, eine Brandsimulation bei {1} s ({2})",
      "{0}, une simulation d’incendie à {1} s ({2})"}},
    {"",
     {"{0}, {1} x {2} x {3} cells", "{0}, {1} x {2} x {3} Zellen",
      "{0}, {1} x {2} x {3} cellules"}},
    {"",
     {"FLAME GLARE IS MISSING: {0} is the smoke of a fire without the light of its flames, which "
      "dazzles and veils signs",
      "DIE BLENDUNG DER FLAMMEN FEHLT: {0} ist der Rauch eines Feuers ohne das Licht seiner "
      "Flammen, das blendet und Zeichen verschleiert",
      "L’ÉBLOUISSEMENT DES FLAMMES MANQUE : {0} est la fumée d’un feu sans la lumière de ses "
      "flammes, qui éblouit et voile les panneaux"}},
    {"", {"{0}, {1} layer", "{0}, {1} Schicht", "{0}, {1} couche"}},
    {"", {"{0}, {1} layers", "{0}, {1} Schichten", "{0}, {1} couches"}},
    // Rule sets and deviations.
    {"",
     {"{0}: not verified against the text of 2024", "{0}: nicht am Text von 2024 geprüft",
      "{0} : non vérifié dans le texte de 2024"}},
    {"",
     {"not verified against the text of 2024", "nicht am Text von 2024 geprüft",
      "non vérifié dans le texte de 2024"}},
    {"",
     {"{0}: superseded by EN 1838:2024", "{0}: ersetzt durch EN 1838:2024",
      "{0} : remplacée par EN 1838:2024"}},
    {"",
     {"superseded by EN 1838:2024", "ersetzt durch EN 1838:2024", "remplacée par EN 1838:2024"}},
    {"",
     {"emergency lighting, European", "Notbeleuchtung, europäisch",
      "éclairage de secours, européenne"}},
    {"",
     {"emergency lighting for buildings, European",
      "Notbeleuchtung für bauliche Anlagen, europäisch",
      "éclairage de secours des bâtiments, européenne"}},
    {"",
     {"life safety code, United States", "Vorschrift zum Personenschutz, USA",
      "code de sécurité des personnes, États-Unis"}},
    {"",
     {"three hours of rated duration instead of one",
      "drei Stunden Bemessungsbetriebsdauer statt einer",
      "trois heures d’autonomie au lieu d’une"}},
    {"",
     {"all of the light asked for within 15 s, beside the onset of EN 1838",
      "das ganze geforderte Licht binnen 15 s, neben der Einschaltzeit der EN 1838",
      "toute la lumière exigée en 15 s, outre le délai de l’EN 1838"}},
    {"",
     {"signs lit from within have 500 cd/m2 of white in mains operation",
      "hinterleuchtete Zeichen haben bei Netzbetrieb 500 cd/m2 in Weiß",
      "les panneaux à éclairage interne ont 500 cd/m2 de blanc sur secteur"}},
    {"",
     {"1 lx on the core of open areas instead of 0.5 lx, and three hours of duration",
      "1 lx auf der Kernfläche offener Bereiche statt 0,5 lx, und drei Stunden Dauer",
      "1 lx au centre des espaces ouverts au lieu de 0,5 lx, et trois heures d’autonomie"}},
    {"", {"1 lx is not verified", "1 lx ist nicht belegt", "1 lx n’est pas vérifié"}},
    {"",
     {"11 lx and 1 lx at first, 6 lx and 0.6 lx at the end",
      "anfangs 11 lx und 1 lx, am Ende 6 lx und 0,6 lx",
      "11 lx et 1 lx au début, 6 lx et 0,6 lx à la fin"}},
    {"",
     {"2.2 lx with any one luminaire failed (hospitals)",
      "2,2 lx bei Ausfall einer beliebigen Leuchte (Krankenhäuser)",
      "2,2 lx avec un luminaire quelconque en panne (hôpitaux)"}},
    // What rules are quoted from.
    {"", {"of no code", "aus keiner Norm", "d’aucune norme"}},
    {"", {"{0} of 2013", "{0} von 2013", "{0} de 2013"}},
    {"", {"secondary texts", "Sekundärtexte", "textes secondaires"}},
    {"", {"recollection, not a source", "Erinnerung, keine Quelle", "de mémoire, sans source"}},
    {"", {"makers' guides", "Leitfäden von Herstellern", "guides de fabricants"}},
    {"", {"makers' guides ({0})", "Leitfäden von Herstellern ({0})", "guides de fabricants ({0})"}},
    {"", {"BSI excerpt", "Auszug des BSI", "extrait du BSI"}},
    {"", {"national practice", "nationale Praxis", "pratique nationale"}},
    {"",
     {"liteplan.com on the draft FprEN 1838 of June 2024",
      "liteplan.com zum Entwurf FprEN 1838 vom Juni 2024",
      "liteplan.com sur le projet FprEN 1838 de juin 2024"}},
    {"",
     {"fernkorn, table of durations", "fernkorn, Tabelle der Betriebsdauern",
      "fernkorn, tableau des autonomies"}},
    // Units that are words.
    {"",
     {"of the viewing distance", "der Erkennungs\u00adweite",
      "de la distance de reconnais\u00adsance"}},
};

}  // namespace

std::span<const ReportText> remark_texts() {
  return remarks_rows;
}

}  // namespace luxodus
