// What a report is handed over with, for other programs: tables as CSV and plans as DXF, from the
// JSON of an assessment. Headers of columns have units, rows have places; numbers have points in
// every language. Requires everywhere: a JSON that check_assessment (actors/judge/assess) has
// passed. Any thread.
#pragma once

#include <filesystem>

#include "actors/judge/report/schedule.hpp"
#include "actors/results/formats/csv.hpp"

namespace luxodus {

/// Every luminaire by itself.
CsvTable luminaires_csv(const Json& assessment, const Schedule& schedule);
CsvTable signs_csv(const Json& assessment, const Schedule& schedule);
/// Types and how many there are of each, luminaires and signs.
CsvTable materials_csv(const Json& assessment, const Schedule& schedule);
/// Every check of a route or an area, with its worst place.
CsvTable places_csv(const Json& assessment);
/// Illuminance at each point of calculation on routes and in areas.
CsvTable points_csv(const Json& assessment, const Schedule& schedule);

/// A plan of one level in metres: layers WALLS, FURNITURE, LUMINAIRES, SIGNS, ROUTES, AREAS,
/// ISOLUX_0.5, ISOLUX_1, ISOLUX_5, ISOLUX_10, TEXT and SCALE. Luminaires and signs are blocks with
/// attributes NAME and TYPE (of signs NUMBER and FACE).
/// Errors: as write_file_atomically.
Result<void> write_plan_dxf(const std::filesystem::path& path, const Json& assessment,
                            const Schedule& schedule, size_t level);

}  // namespace luxodus
