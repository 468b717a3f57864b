// luxodus spacing: the spacing table of an emergency luminaire, as manufacturers print it.
#include <fmt/format.h>

#include <cmath>
#include <filesystem>

#include "actors/apps/cli/command.hpp"
#include "actors/apps/cli/commands.hpp"
#include "actors/results/formats/csv.hpp"
#include "actors/results/formats/json_out.hpp"
#include "runtime/core/output_text.hpp"
#include "runtime/core/printable.hpp"
#include "scenes/emergency/spacing.hpp"
#include "scenes/formats/photometry/gldf.hpp"

namespace luxodus::cli {

namespace {

struct SpacingOptions {
  std::string file;
  std::vector<double> heights, levels;  // empty: the usual ones
  double plane = 0.02;
  double maintenance_factor = 1, end_of_duration_factor = 1;
  double emergency_flux = 0;  // [lm]; 0: that of the file
  int lamp_set = 0;           // 0: not chosen
  std::string variant, emitter;
  double duration_h = 0;  // 0: not chosen
  bool json = false, csv = false;

  /// Rounded to twelve decimals: 0.8 x 0.7 is 0.56.
  double end_of_life() const {
    return std::round(maintenance_factor * end_of_duration_factor * 1e12) / 1e12;
  }
};

/// A luminaire whose intensities belong to a flux.
struct SpacedLuminaire {
  PhotometricFile photometry;
  glm::dmat3 turn{1};  // from the file's frame to the luminaire's
  double flux_lm = 0;

  Intensity intensity() const {
    return [this, back = glm::transpose(turn)](const glm::dvec3& direction) {
      return photometry.web->intensity(back * direction) * flux_lm / photometry.web->flux_lm();
    };
  }
};

Result<SpacedLuminaire> read_contained(const SpacingOptions& o, std::optional<int> lamp_set) {
  auto product = read_gldf(o.file);
  if (!product) return product.problem();
  GldfChoice choice{o.variant, o.emitter, {}, lamp_set};
  if (o.duration_h > 0) choice.duration_h = o.duration_h;
  auto chosen = luminaire_of(product.value(), choice);
  if (!chosen) return chosen.problem();
  SpacedLuminaire out{std::move(chosen->photometry), chosen->turn, o.emergency_flux};
  if (out.flux_lm > 0) return out;
  if (!chosen->emergency_lm)
    return problem_in(o.file, chosen->emergency_lm.problem().what +
                                  "; --emergency-flux states it for this table");
  out.flux_lm = chosen->emergency_lm.value();
  return out;
}

Result<SpacedLuminaire> read_luminaire(const SpacingOptions& o) {
  std::error_code failed;
  if (!std::filesystem::exists(o.file, failed))
    return problem_in(o.file, "there is no such file", ProblemKind::not_found);
  std::optional<int> lamp_set;
  if (o.lamp_set > 0) lamp_set = o.lamp_set;
  if (std::string_view(o.file).ends_with(".gldf")) return read_contained(o, lamp_set);
  if (!o.variant.empty() || !o.emitter.empty() || o.duration_h > 0)
    return problem_in(o.file,
                      "--variant, --emitter and --duration-h belong to a GLDF container (.gldf)");
  auto read = read_photometric_file(o.file, lamp_set);
  if (!read) return read.problem();
  SpacedLuminaire out{std::move(read).value(), glm::dmat3(1), o.emergency_flux};
  if (!(out.flux_lm > 0)) out.flux_lm = out.photometry.flux_lm;
  return out;
}

Result<SpacingRequest> request_of(const SpacingOptions& o) {
  SpacingRequest out{o.heights, o.levels, {1}, o.plane};
  if (out.heights_m.empty()) out.heights_m = {2.5, 2.8, 3, 3.5, 4, 5};
  if (out.levels_lx.empty())
    out.levels_lx.assign(std::begin(usual_spacing_levels), std::end(usual_spacing_levels));
  if (o.end_of_life() < 1) out.factors.push_back(o.end_of_life());
  if (out.heights_m.size() > limits::spacing_heights ||
      out.levels_lx.size() > limits::spacing_levels)
    return problem(fmt::format("a table has at most {} heights and {} levels",
                               limits::spacing_heights, limits::spacing_levels));
  for (const double height : out.heights_m)
    if (!(height > o.plane))
      return problem(
          fmt::format("--height {:g}: the luminaire hangs above the lit plane, which is "
                      "{:g} m above the floor (--plane)",
                      height, o.plane));
  for (const double level : out.levels_lx)
    if (!(level > 0)) return problem(fmt::format("--level {:g}: a level is above 0 lx", level));
  return out;
}

const char* life_of(const SpacingRow& row) {
  return row.factor < 1 ? "end" : "initial";
}

std::string name_of(const SpacedLuminaire& luminaire) {
  const PhotometricFile& file = luminaire.photometry;
  std::string out = file.luminaire.empty() ? file.file : printable(file.luminaire);
  if (!file.manufacturer.empty()) out += " (" + printable(file.manufacturer) + ")";
  return out;
}

std::string metres(const std::optional<RowSpacing>& spacing) {
  if (!spacing) return fmt::format("{:>11}{:>10}", "-", "-");
  return fmt::format("{:>11.2f}{:>10.2f}", spacing->to_wall_m, spacing->between_m);
}

void print_table(const SpacingOptions& o, const SpacedLuminaire& luminaire,
                 const std::vector<SpacingRow>& rows) {
  std::string out =
      name_of(luminaire) + "\n" +
      fmt::format("{:.6g} lm, {}\n", luminaire.flux_lm,
                  o.emergency_flux > 0 ? "as --emergency-flux states" : "of the file");
  if (o.end_of_life() < 1)
    out += fmt::format("end of life: factor {:.4g} = maintenance {:.4g} x end of duration {:.4g}\n",
                       o.end_of_life(), o.maintenance_factor, o.end_of_duration_factor);
  else
    out +=
        "new luminaires only: --maintenance-factor and --end-of-duration-factor add the end of "
        "life\n";
  out += fmt::format(
      "direct light on the line below the row, {:g} m above the floor; distances in m, \"-\": less "
      "than the level even below the luminaire\n\n"
      "{:26}{:>21}{:>21}\n{:>8}{:>9}{:>9}{:>11}{:>10}{:>11}{:>10}\n",
      o.plane, "", "C0 along the row", "C0 across the row", "height", "life", "level", "wall-first",
      "between", "wall-first", "between");
  for (const SpacingRow& row : rows)
    out += fmt::format("{:>6.4g} m{:>9}{:>6.4g} lx{}{}\n", row.height_m, life_of(row), row.level_lx,
                       metres(row.along), metres(row.across));
  std::fputs(out.c_str(), stdout);
}

Json spacing_json(const std::optional<RowSpacing>& spacing) {
  if (!spacing) return nullptr;
  return {{"to_wall_m", spacing->to_wall_m}, {"between_m", spacing->between_m}};
}

void print_json(const SpacingOptions& o, const SpacedLuminaire& luminaire,
                const std::vector<SpacingRow>& rows) {
  Json table = Json::array();
  for (const SpacingRow& row : rows)
    table.push_back({{"height_m", row.height_m},
                     {"life", life_of(row)},
                     {"factor", row.factor},
                     {"level_lx", row.level_lx},
                     {"c0_along", spacing_json(row.along)},
                     {"c0_across", spacing_json(row.across)}});
  const Json document = {{"format", "luxodus spacing 1"},
                         {"file", o.file},
                         {"luminaire", luminaire.photometry.luminaire},
                         {"manufacturer", luminaire.photometry.manufacturer},
                         {"flux_lm", luminaire.flux_lm},
                         {"maintenance_factor", o.maintenance_factor},
                         {"end_of_duration_factor", o.end_of_duration_factor},
                         {"plane_m", o.plane},
                         {"rows", table}};
  std::fputs(json_text(document).c_str(), stdout);
}

void print_csv(const std::vector<SpacingRow>& rows) {
  CsvTable table({"height [m]", "life", "factor", "level [lx]", "C0 along: wall to first [m]",
                  "C0 along: between [m]", "C0 across: wall to first [m]",
                  "C0 across: between [m]"});
  const auto cells = [&](const std::optional<RowSpacing>& spacing) {
    if (spacing)
      table.cells(spacing->to_wall_m, spacing->between_m);
    else
      table.empty_cell().empty_cell();
  };
  for (const SpacingRow& row : rows) {
    table.cells(row.height_m, life_of(row), row.factor, row.level_lx);
    cells(row.along);
    cells(row.across);
    table.end_row();
  }
  std::fputs(table.text().c_str(), stdout);
}

Result<ExitCode> print_spacing(const SpacingOptions& o) {
  const auto request = request_of(o);
  if (!request) return request.problem();
  const auto luminaire = read_luminaire(o);
  if (!luminaire) return luminaire.problem();
  for (const Problem& warning : luminaire->photometry.warnings) warn(warning);
  const auto rows = spacing_table(luminaire->intensity(), request.value());
  if (o.json)
    print_json(o, luminaire.value(), rows);
  else if (o.csv)
    print_csv(rows);
  else
    print_table(o, luminaire.value(), rows);
  return ExitCode::success;
}

std::vector<Option> spacing_options(const std::shared_ptr<SpacingOptions>& o) {
  constexpr Range shares{1e-6, 1};
  return {{"file",
           &o->file,
           "Photometric file: LDT, IES or GLDF",
           {.form = Form::file, .required = true}},
          {"--height",
           &o->heights,
           "Mounting heights above the floor [m]",
           {.otherwise = "2.5,2.8,3,3.5,4,5", .range = Range{0, 1000}, .comma_separated = true}},
          {"--level",
           &o->levels,
           "Levels of illuminance [lx]",
           {.otherwise = "0.5,1,5", .range = Range{0, 1e6}, .comma_separated = true}},
          {"--plane",
           &o->plane,
           "Height of the lit plane above the floor [m]",
           {.range = Range{0, 100}}},
          {"--maintenance-factor",
           &o->maintenance_factor,
           "Share of the flux that ageing and dirt leave",
           {.range = shares}},
          {"--end-of-duration-factor",
           &o->end_of_duration_factor,
           "Share of the flux that the supply gives at the end of its duration",
           {.range = shares}},
          {"--emergency-flux",
           &o->emergency_flux,
           "Flux of the new luminaire on emergency supply [lm]",
           {.otherwise = "that of the file", .range = Range{0, 1e6}}},
          {"--lamp-set",
           &o->lamp_set,
           "Number of the lamp set of an LDT file with several",
           {.otherwise = "the only one", .range = Range{0, 1000}}},
          {"--variant", &o->variant, "Variant of a GLDF container", {.otherwise = "the only one"}},
          {"--emitter", &o->emitter, "Emitter of a GLDF container", {.otherwise = "the only one"}},
          {"--duration-h",
           &o->duration_h,
           "Duration whose flux a GLDF container states [h]",
           {.otherwise = "none", .range = Range{0, 1000}}},
          {"--json", &o->json, "Output as JSON", {.excludes = "--csv"}},
          {"--csv", &o->csv, "Output as CSV"}};
}

}  // namespace

Command spacing_command() {
  const auto o = std::make_shared<SpacingOptions>();
  return {.name = "spacing",
          .summary = "Print how far apart an emergency luminaire may hang",
          .heading = "Assess",
          .options = spacing_options(o),
          .notes =
              "The table that manufacturers print: the largest distance from the end of a row "
              "(a wall) to its first luminaire, and between two neighbours, so that each point of "
              "the line below the row gets the level by their direct light. Luminaires are points "
              "that hang level. Two neighbours are counted, and no reflected light. Every smaller "
              "distance meets the level, too.\n"
              "\"C0 along\" is a row in the plane C0-C180, \"C0 across\" one in C90-C270. Where "
              "the sides of a luminaire differ, the distance to the wall is that of the weaker "
              "side.\n"
              "Initial rows are those of the new luminaire. Rows of the end of life have both "
              "factors, and are the ones to plan by. An LDT or IES file states one flux; where it "
              "is that on mains, --emergency-flux scales it.\n"
              "  luxodus spacing corridor.ldt --maintenance-factor 0.8 --end-of-duration-factor "
              "0.7\n"
              "  luxodus spacing corridor.ldt --height 2.5,2.8 --level 1 --csv > spacing.csv\n"
              "  luxodus spacing safety.gldf --variant v-3h --duration-h 3",
          .run = [o] { return exit_code_of(print_spacing(*o)); }};
}

}  // namespace luxodus::cli
