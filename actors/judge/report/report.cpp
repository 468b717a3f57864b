#include "actors/judge/report/report.hpp"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <set>

#include "actors/judge/report/guidance_map.hpp"
#include "actors/judge/report/hand_over.hpp"
#include "actors/judge/report/pdf.hpp"
#include "actors/judge/report/plan_svg.hpp"
#include "actors/results/formats/file_names.hpp"
#include "runtime/core/regular_file.hpp"

namespace luxodus {

namespace {

namespace fs = std::filesystem;

constexpr uint64_t pdf_bytes = uint64_t{512} << 20;

std::string bytes_text(const std::vector<std::byte>& bytes) {
  return std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size());
}

Result<void> make_folder(const fs::path& folder) {
  std::error_code failed;
  fs::create_directories(folder, failed);
  if (failed) return system_problem(folder, "cannot make this folder", failed.value());
  return {};
}

/// "1.65m", for file names.
std::string height_name(double metres) {
  return fmt::format("{:.2f}m", metres);
}

Result<void> write_plans(const fs::path& folder, const AssessmentRecord& a,
                         const Schedule& schedule, const Texts& texts, bool values) {
  if (auto ok = make_folder(folder); !ok) return ok.problem();
  const Plans plans(a, schedule, texts, {});
  std::set<double> heights;
  for (const SightRecord& sight : a.sights)
    if (!sight.by_observer()) heights.insert(sight.eye_height_m);
  for (size_t i = 0; i < schedule.levels(); ++i) {
    const std::string level =
        schedule.levels() > 1 ? "level_" + std::to_string(i + 1) + "_" : std::string();
    std::vector<std::pair<std::string, std::string>> drawings{
        {"installation", plans.installation(i).svg}, {"isolux", plans.isolux(i, values).svg}};
    for (const double height : heights)
      drawings.emplace_back("legibility_" + height_name(height), plans.sights(i, height, "").svg);
    for (const auto& [name, svg] : drawings)
      if (auto ok = write_file_atomically(folder / (level + name + ".svg"), svg); !ok)
        return ok.problem();
    if (auto ok = write_plan_dxf(folder / (level + "plan.dxf"), a, schedule, i); !ok)
      return ok.problem();
  }
  return {};
}

/// Writes one map of place and time for each route and eye height.
Result<void> write_guidance(const fs::path& folder, const AssessmentRecord& a, const Texts& texts) {
  if (!a.over_time) return {};
  constexpr double sheet_mm = 180;
  std::vector<std::string> names;
  for (const RouteOverTime& route : a.over_time->routes)
    names.push_back("guided_" + route.route + "_" + height_name(route.eye_height_m));
  names = file_names_of(names, std::array{".svg"});
  for (size_t i = 0; i < names.size(); ++i)
    if (auto ok = write_file_atomically(
            folder / (names[i] + ".svg"),
            guidance_map(*a.over_time, a.over_time->routes[i], texts, sheet_mm));
        !ok)
      return ok.problem();
  return {};
}

Result<void> write_schedules(const fs::path& folder, const AssessmentRecord& a,
                             const Schedule& schedule) {
  if (auto ok = make_folder(folder); !ok) return ok.problem();
  for (const auto& [name, table] : {std::pair{"luminaires.csv", luminaires_csv(a, schedule)},
                                    std::pair{"signs.csv", signs_csv(a, schedule)},
                                    std::pair{"bill_of_materials.csv", materials_csv(a, schedule)},
                                    std::pair{"checks_with_places.csv", places_csv(a)},
                                    std::pair{"illuminance_points.csv", points_csv(a, schedule)}})
    if (auto ok = write_csv(folder / name, table); !ok) return ok.problem();
  return {};
}

/// The page of each heading in a printed report; none where there is no such file.
std::map<std::string, int> printed_pages(const fs::path& pdf) {
  const auto bytes = read_whole_file(pdf, pdf_bytes);
  return bytes ? pages_of_destinations(bytes_text(bytes.value())) : std::map<std::string, int>{};
}

/// Contents name the page of each heading, which is known once a report is printed. Pages are those
/// of the report that lies there, such as one in another language, until they turn out to differ:
/// then it is printed a second time.
Result<void> print_report(const fs::path& folder, const AssessmentRecord& a,
                          const Enclosures& enclosures, const ReportOptions& options) {
  const fs::path pdf = folder / "report.pdf";
  const fs::path page = folder / fmt::format(".report.{}.html", ::getpid());
  const auto print = [&](const std::map<std::string, int>& pages) -> Result<void> {
    const auto written = write_file_atomically(page, report_html(a, enclosures, options, pages));
    return written ? print_pdf(page, pdf) : written;
  };
  const std::map<std::string, int> expected = printed_pages(pdf);
  Result<void> done = print(expected);
  if (done)
    if (const auto pages = printed_pages(pdf); pages != expected) done = print(pages);
  std::error_code ignored;
  fs::remove(page, ignored);
  return done;
}

Result<Enclosures> enclosures_in(const fs::path& folder) {
  Enclosures out{pictures_in(folder), {}};
  const fs::path people = folder / "people" / "walk.json";
  std::error_code none;
  if (!fs::exists(people, none)) return out;
  auto read = read_followed_people(people);
  if (!read) return read.problem();
  out.people = std::move(read).value();
  return out;
}

}  // namespace

std::string report_html(const AssessmentRecord& a, const Enclosures& enclosures,
                        const ReportOptions& options, const std::map<std::string, int>& pages) {
  const Schedule schedule(a);
  const Texts texts(options.language);
  // Margins: 15 mm left and right, 20 mm above and below; on a landscape sheet they are turned.
  const double width = (options.letter ? 215.9 : 210) - 30;
  const double height = (options.letter ? 279.4 : 297) - 30;
  return report_page({a, schedule, texts, enclosures.pictures, enclosures.people, width, height,
                      options.grid_values},
                     {options.letter, pages});
}

Result<void> write_report(const fs::path& folder, const AssessmentRecord& a,
                          const ReportOptions& options) {
  const Schedule schedule(a);
  const Texts texts(options.language);
  const auto enclosures = enclosures_in(folder);
  if (!enclosures) return enclosures.problem();
  if (auto ok = write_plans(folder / "plans", a, schedule, texts, options.grid_values); !ok)
    return ok.problem();
  if (auto ok = write_guidance(folder / "plans", a, texts); !ok) return ok.problem();
  if (auto ok = write_schedules(folder / "schedules", a, schedule); !ok) return ok.problem();
  if (auto ok = write_file_atomically(folder / "report.html",
                                      report_html(a, enclosures.value(), options));
      !ok)
    return ok;
  return options.pdf ? print_report(folder, a, enclosures.value(), options) : Result<void>{};
}

}  // namespace luxodus
