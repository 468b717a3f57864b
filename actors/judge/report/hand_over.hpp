// Files of a report for other programs: tables as CSV and plans as DXF, from the record of
// an assessment. Column headers have units, rows have places, and numbers have decimal points in
// every language. Nothing is calculated. Any thread.
#pragma once

#include <filesystem>

#include "actors/judge/report/schedule.hpp"
#include "actors/results/formats/csv.hpp"

namespace luxodus {

/// One row for each luminaire.
CsvTable luminaires_csv(const AssessmentRecord& assessment, const Schedule& schedule);
CsvTable signs_csv(const AssessmentRecord& assessment, const Schedule& schedule);
/// Types of luminaires and signs, with the number of each.
CsvTable materials_csv(const AssessmentRecord& assessment, const Schedule& schedule);
/// Every check of a route or an area with its worst place.
CsvTable places_csv(const AssessmentRecord& assessment);
/// Illuminance at each point of calculation on routes and in areas, as their charts have it.
CsvTable points_csv(const AssessmentRecord& assessment, const Schedule& schedule);

/// A plan of one level in metres: layers WALLS, FURNITURE, LUMINAIRES, SIGNS, ROUTES, AREAS,
/// ISOLUX_0.5, ISOLUX_1, ISOLUX_5, ISOLUX_10, TEXT and SCALE. Luminaires and signs are blocks with
/// attributes NAME and TYPE (signs: NUMBER and FACE).
/// Errors: as write_file_atomically.
Result<void> write_plan_dxf(const std::filesystem::path& path, const AssessmentRecord& assessment,
                            const Schedule& schedule, size_t level);

}  // namespace luxodus
