// Section with the rooms of a building and what is in them.
#include "actors/judge/report/page.hpp"

namespace luxodus {

std::string rooms_section(const PageParts& parts) {
  const Texts& t = parts.texts;
  std::string rows;
  const bool levels = parts.schedule.levels() > 1;
  for (size_t i = 0; i < parts.a.rooms.size(); ++i) {
    const RoomRecord& room = parts.a.rooms[i];
    rows += "<tr>" + html_cell("<b>" + std::to_string(i + 1) + "</b>", "n") + cell(room.name) +
            html_cell(levels ? escaped(t.say("plan.level", t.fixed(parts.schedule.floor(
                                                               parts.schedule.level_of(room.z_m)))))
                             : "–") +
            html_cell(escaped(t.fixed(room.area_m2, 1)) + "\u00a0m²", "n") +
            number_cell(t, room.emergency) + number_cell(t, room.mains) +
            number_cell(t, room.signs) + "</tr>\n";
  }
  if (rows.empty()) return paragraph(t("rooms.none"));
  return paragraph(t("rooms.lead")) +
         table(t,
               {"column.number", "column.room", "column.level", "column.area", "column.emergency",
                "column.mains", "column.signs"},
               {6, 32, 18, 12, 12, 10, 10}, rows);
}

}  // namespace luxodus
