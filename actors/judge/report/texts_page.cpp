// The frame of a report: cover, notices, headings, plans.
#include "actors/judge/report/texts.hpp"

namespace luxodus {

namespace {

constexpr ReportText page_rows[] = {
    {"page.kind",
     {"Emergency lighting and exit signs: calculation report",
      "Notbeleuchtung und Rettungszeichen: Berechnungsbericht",
      "Éclairage de secours et signalisation : rapport de calcul"}},
    {"page.contents", {"Contents", "Inhalt", "Sommaire"}},
    {"page.of", {"Page {0} of {1}", "Seite {0} von {1}", "Page {0} sur {1}"}},
    {"project.client", {"Client", "Auftraggeber", "Client"}},
    {"project.address", {"Address", "Adresse", "Adresse"}},
    {"project.document", {"Document", "Dokument", "Document"}},
    {"project.revision", {"Revision", "Revision", "Révision"}},
    {"project.date", {"Date", "Datum", "Date"}},
    {"project.author", {"Author", "Bearbeitet", "Auteur"}},
    {"project.checker", {"Checked by", "Geprüft", "Vérifié par"}},
    {"project.scene", {"Scene", "Szene", "Scène"}},
    {"project.none",
     {"not stated: add [project] to the scene", "nicht angegeben: [project] in der Szene ergänzen",
      "non indiqué : ajouter [project] à la scène"}},
    {"notice.heading",
     {"What this document is, and what it is not", "Was dieses Dokument ist und was nicht",
      "Ce que ce document est, et ce qu’il n’est pas"}},
    {"notice.calculation",
     {"It is a calculation under the assumptions stated in it. It certifies compliance with no law "
      "and no code.",
      "Es ist eine Berechnung unter den darin genannten Annahmen. Es bescheinigt die Einhaltung "
      "keines Gesetzes und keiner Norm.",
      "C’est un calcul sous les hypothèses qu’il énonce. Il ne certifie la conformité à aucune loi "
      "ni à aucune norme."}},
    {"notice.secondary",
     {"Limits marked “secondary” were not read in the standard itself, but in texts that quote it.",
      "Als „sekundär“ bezeichnete Grenzwerte wurden nicht in der Norm selbst gelesen, sondern in "
      "Texten, die sie zitieren.",
      "Les limites dites « secondaires » n’ont pas été lues dans la norme même, mais dans des "
      "textes qui la citent."}},
    {"notice.legibility",
     {"Legibility is a model’s prediction. It is no analysis of available and required safe egress "
      "time (ASET/RSET).",
      "Die Lesbarkeit ist die Vorhersage eines Modells. Sie ist keine Analyse der verfügbaren und "
      "der erforderlichen Räumungszeit (ASET/RSET).",
      "La lisibilité est la prédiction d’un modèle. Ce n’est pas une analyse des temps "
      "d’évacuation disponible et requis (ASET/RSET)."}},
    {"notice.authority",
     {"The authority having jurisdiction decides.", "Die zuständige Behörde entscheidet.",
      "L’autorité compétente décide."}},
    {"notice.measure",
     {"Verify by measurement in the finished building.",
      "Die Werte sind im fertigen Gebäude durch Messung zu prüfen.",
      "À vérifier par des mesures dans le bâtiment achevé."}},
    {"notice.footer",
     {"Calculation under stated assumptions; certifies compliance with no law or code. Limits "
      "marked "
      "secondary were not read in the standard. Legibility is a model’s prediction, no ASET/RSET "
      "analysis. The authority having jurisdiction decides. Verify by measurement.",
      "Berechnung unter genannten Annahmen; bescheinigt die Einhaltung keines Gesetzes und keiner "
      "Norm. Sekundäre Grenzwerte wurden nicht in der Norm gelesen. Lesbarkeit ist Vorhersage "
      "eines "
      "Modells, keine ASET/RSET-Analyse. Die zuständige Behörde entscheidet. Durch Messung prüfen.",
      "Calcul sous hypothèses énoncées ; ne certifie la conformité à aucune loi ni norme. Les "
      "limites secondaires n’ont pas été lues dans la norme. La lisibilité est la prédiction d’un "
      "modèle, sans analyse ASET/RSET. L’autorité compétente décide. À vérifier par des mesures."}},
    {"heading.verdict", {"Verdict", "Ergebnis", "Verdict"}},
    {"heading.state", {"State judged", "Bewerteter Zustand", "État évalué"}},
    {"heading.plans", {"Plans", "Pläne", "Plans"}},
    {"heading.schedules", {"Schedules", "Stücklisten", "Nomenclatures"}},
    {"heading.places", {"Routes and areas", "Wege und Bereiche", "Chemins et espaces"}},
    {"heading.sights", {"What people read", "Was Menschen lesen", "Ce que les personnes lisent"}},
    {"heading.over_time",
     {"Guided routes over time", "Geführte Wege im Lauf der Zeit",
      "Chemins guidés au cours du temps"}},
    {"heading.thumb",
     {"Where rules of thumb disagree most", "Wo Faustregeln am stärksten abweichen",
      "Où les règles empiriques divergent le plus"}},
    {"heading.inputs",
     {"Inputs and assumptions", "Eingaben und Annahmen", "Données et hypothèses"}},
    {"heading.clauses",
     {"Register of clauses", "Verzeichnis der Abschnitte", "Registre des articles"}},
    {"heading.not_assessed",
     {"What was not assessed", "Was nicht bewertet wurde", "Ce qui n’a pas été évalué"}},
    {"heading.method",
     {"Method and traceability", "Verfahren und Rückverfolgbarkeit", "Méthode et traçabilité"}},
    {"heading.appendix_checks",
     {"Appendix A: all other checks", "Anhang A: alle übrigen Prüfungen",
      "Annexe A : tous les autres contrôles"}},
    {"heading.appendix_signs",
     {"Appendix B: legibility, sign by sign", "Anhang B: Lesbarkeit, Zeichen für Zeichen",
      "Annexe B : lisibilité, panneau par panneau"}},
    {"heading.appendix_thumb",
     {"Appendix C: all places where rules of thumb disagree",
      "Anhang C: alle Stellen, an denen Faustregeln abweichen",
      "Annexe C : tous les lieux où les règles empiriques divergent"}},
    {"headline.state", {"\"{0}\", {1}", "„{0}“, {1}", "« {0} », {1}"}},
    {"headline.seconds",
     {", {0} s after the failure", ", {0} s nach dem Netzausfall", ", {0} s après la coupure"}},
    {"headline.clear", {", in clear air", ", in klarer Luft", ", en air clair"}},
    {"headline.smoke", {", in smoke of {0}", ", in Rauch von {0}", ", dans une fumée de {0}"}},
    {"headline.extinction", {"{0}/m", "{0}/m", "{0}/m"}},
    {"headline.extinctions", {"{0}/m to {1}/m", "{0}/m bis {1}/m", "{0}/m à {1}/m"}},
    {"headline.by", {"{0}, by {1}: {2}", "{0}, nach {1}: {2}", "{0}, selon {1} : {2}"}},
    {"headline.and", {" and ", " und ", " et "}},
    {"headline.views",
     {"; {0} of {1} views of signs are legible", "; {0} von {1} Sichten auf Zeichen sind lesbar",
      " ; {0} vues de panneaux sur {1} sont lisibles"}},
    {"headline.no_views",
     {"; no view of a sign was judged", "; keine Sicht auf ein Zeichen wurde bewertet",
      " ; aucune vue de panneau n’a été évaluée"}},
    {"verdict.none_made",
     {"no check could be made", "keine Prüfung war möglich", "aucun contrôle n’a pu être fait"}},
    {"verdict.none_fails",
     {"no check made fails", "keine der durchgeführten Prüfungen schlägt fehl",
      "aucun contrôle effectué n’échoue"}},
    {"verdict.one_fails",
     {"1 check fails", "1 Prüfung nicht bestanden", "1 contrôle non satisfait"}},
    {"verdict.some_fail",
     {"{0} checks fail", "{0} Prüfungen nicht bestanden", "{0} contrôles non satisfaits"}},
    {"verdict.unassessed_one", {"{0} not assessed", "{0} nicht bewertet", "{0} non évalué"}},
    {"verdict.unassessed", {"{0} not assessed", "{0} nicht bewertet", "{0} non évalués"}},
    {"verdict.unverified_one", {"{0} not verified", "{0} nicht belegt", "{0} non vérifié"}},
    {"verdict.unverified", {"{0} not verified", "{0} nicht belegt", "{0} non vérifiés"}},
    {"verdict.counts",
     {"Of {0} checks, {1} pass.", "Von {0} Prüfungen sind {1} bestanden.",
      "Sur {0} contrôles, {1} sont satisfaits."}},
    {"verdict.sights",
     {"Signs, from all places on routes and in areas:",
      "Zeichen, von allen Stellen auf Wegen und in Bereichen:",
      "Panneaux, depuis tous les lieux des chemins et espaces :"}},
    {"verdict.fails", {"What fails", "Was nicht bestanden ist", "Ce qui n’est pas satisfait"}},
    {"verdict.nothing_fails",
     {"No check that was made fails.", "Keine durchgeführte Prüfung ist nicht bestanden.",
      "Aucun contrôle effectué n’est non satisfait."}},
    {"verdict.unverified_checks",
     {"Held against limits that are not verified", "Gegen nicht belegte Grenzwerte gehalten",
      "Confrontés à des limites non vérifiées"}},
    {"verdict.warnings", {"Warnings", "Warnungen", "Avertissements"}},
    {"verdict.remarks_english",
     {"Remarks and warnings in italics are those of the program.",
      "Kursive Bemerkungen und Warnungen stammen vom Programm; Warnungen sind englisch.",
      "Les remarques et avertissements en italique sont ceux du programme ; les avertissements "
      "sont en anglais."}},
    {"plan.level", {"Floor at {0} m", "Boden auf {0} m", "Niveau à {0} m"}},
    {"plan.installation",
     {"Luminaires, signs and routes", "Leuchten, Zeichen und Wege",
      "Luminaires, panneaux et chemins"}},
    {"plan.installation_note",
     {"Letters and numbers are those of the schedules. Walls are cut 1.2 m above the floor.",
      "Buchstaben und Nummern sind die der Stücklisten. Wände sind 1,2 m über dem Boden "
      "geschnitten.",
      "Lettres et numéros sont ceux des nomenclatures. Les murs sont coupés à 1,2 m du sol."}},
    {"plan.isolux",
     {"Lines of equal illuminance on the floor", "Linien gleicher Beleuchtungsstärke am Boden",
      "Courbes isolux au sol"}},
    {"plan.isolux_note",
     {"Direct light of all emergency luminaires at the end of the rated duration, in clear air, "
      "without furniture and reflections: 0.5, 1, 5 and 10 lx. Drawn on a grid of {0} m; squares "
      "that a wall crosses are left out. Closed doors block light.",
      "Direktes Licht aller Notleuchten am Ende der Bemessungsbetriebsdauer, in klarer Luft, ohne "
      "Möbel und Reflexionen: 0,5, 1, 5 und 10 lx. Auf einem Raster von {0} m gezeichnet; "
      "Quadrate, "
      "die eine Wand schneidet, sind ausgelassen. Geschlossene Türen halten Licht ab.",
      "Lumière directe de tous les luminaires de secours en fin d’autonomie, en air clair, sans "
      "mobilier ni réflexions : 0,5, 1, 5 et 10 lx. Tracé sur une grille de {0} m ; les carrés que "
      "coupe un mur sont omis. Les portes fermées arrêtent la lumière."}},
    {"plan.isolux_none",
     {"No line of 0.5, 1, 5 or 10 lx crosses this floor.",
      "Keine Linie von 0,5, 1, 5 oder 10 lx verläuft auf diesem Boden.",
      "Aucune courbe de 0,5, 1, 5 ou 10 lx ne traverse ce niveau."}},
    {"plan.values_note",
     {"Numbers: illuminance at points of calculation [lx].",
      "Zahlen: Beleuchtungsstärke an Berechnungspunkten [lx].",
      "Nombres : éclairement aux points de calcul [lx]."}},
    {"plan.sights",
     {"Where a sign is legible, eyes at {0} m", "Wo ein Zeichen lesbar ist, Augen auf {0} m",
      "Où un panneau est lisible, yeux à {0} m"}},
    {"plan.sights_note",
     {"The best of all signs, place by place.", "Das beste aller Zeichen, Stelle für Stelle.",
      "Le meilleur de tous les panneaux, lieu par lieu."}},
    {"legend.emergency", {"emergency luminaire", "Notleuchte", "luminaire de secours"}},
    {"legend.mains", {"luminaire on mains only", "Leuchte, nur Netz", "luminaire, secteur seul"}},
    {"legend.letters",
     {"type, height above the floor [m]", "Typ, Höhe über dem Boden [m]",
      "type, hauteur au-dessus du sol [m]"}},
    {"legend.sign",
     {"sign, and where it faces", "Zeichen und wohin es blickt", "panneau et son orientation"}},
    {"legend.double_sided", {"double-sided sign", "zweiseitiges Zeichen", "panneau double face"}},
    {"legend.emphasis", {"point of emphasis", "hervorzuhebende Stelle", "point à signaler"}},
    {"legend.route",
     {"route, direction of escape", "Weg in Fluchtrichtung", "chemin, sens de l’évacuation"}},
    {"legend.area", {"area", "Bereich", "espace"}},
    {"legend.walls", {"walls, closed doors", "Wände, geschlossene Türen", "murs, portes fermées"}},
    {"legend.furniture", {"furniture", "Möbel", "mobilier"}},
    {"plan.north", {"N", "N", "N"}},
    {"plan.scale", {"1:{0} on {1}", "1:{0} auf {1}", "1:{0} en {1}"}},
};

}  // namespace

std::span<const ReportText> page_texts() {
  return page_rows;
}

}  // namespace luxodus
