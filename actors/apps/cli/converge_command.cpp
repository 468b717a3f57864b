// luxodus converge: measures how the error falls with particles and with seconds.
#include <cmath>
#include <filesystem>
#include <limits>

#include "actors/apps/cli/command.hpp"
#include "actors/apps/cli/commands.hpp"
#include "actors/apps/cli/load_scene.hpp"
#include "actors/apps/cli/nodes_option.hpp"
#include "actors/apps/cli/progress_line.hpp"
#include "actors/apps/cli/quantities.hpp"
#include "actors/apps/cli/signals.hpp"
#include "actors/results/formats/csv.hpp"
#include "actors/results/formats/file_names.hpp"
#include "actors/results/formats/json_out.hpp"
#include "actors/results/formats/output_folder.hpp"
#include "actors/results/formats/svg_plot.hpp"
#include "actors/results/run/local_run.hpp"
#include "runtime/core/log.hpp"
#include "scenes/light/transport/compile.hpp"

namespace luxodus::cli {

namespace {

namespace fs = std::filesystem;

struct ConvergeOptions {
  std::string scene, scenario, out;
  std::string particles = "8M";
  std::vector<std::string> error_of;
  int threads = default_threads();
  std::optional<uint64_t> seed;
  bool json = false;
};

struct Point {
  double particles, seconds, error, figure_of_merit;
};

/// Least-squares slope of log y over log x.
double slope(const std::vector<Point>& points, double Point::*x) {
  double n = 0, sx = 0, sy = 0, sxx = 0, sxy = 0;
  for (const Point& p : points) {
    const double lx = std::log(p.*x);
    const double ly = std::log(p.error);
    n += 1;
    sx += lx;
    sy += ly;
    sxx += lx * lx;
    sxy += lx * ly;
  }
  return (n * sxy - sx * sy) / (n * sxx - sx * sx);
}

struct Course {
  std::vector<Point> points;  // those with an error above 0
  double last_error = std::numeric_limits<double>::infinity();
  int looks = 0;
  bool interrupted = false;
};

/// One run whose length doubles, measured after each doubling: every point is what a run of that
/// length would give.
Course trace_course(LocalRun& run, int64_t most) {
  Course course;
  ProgressLine line("converge");
  for (int64_t n = 8 * run.scene().batch_particles;; n *= 2) {
    StopRule rule;
    rule.particles = std::min(n, most);
    const StopReason reason =
        run.run(rule, interrupt_flag(), [&](const Progress& p) { line.show(p); });
    course.interrupted = reason == StopReason::interrupted;
    if (course.interrupted) return course;
    const double error = Readout(run.scene(), run.totals()).worst_relative_error();
    course.last_error = error;
    ++course.looks;
    if (std::isfinite(error) && error > 0)
      course.points.push_back({static_cast<double>(run.particles()), run.seconds(), error,
                               1 / (error * error * run.seconds())});
    if (n >= most) return course;
  }
}

/// Why a completed course has fewer than two points.
std::string why_no_slope(const Course& course) {
  if (course.last_error == 0)
    return "the error is exactly 0: all that this scene measures is computed without chance, and "
           "nothing is left to converge";
  if (course.looks >= 2 && course.points.empty())
    return "no light reached what this scene measures, so there is no error: ask for more with "
           "--particles, or look at the scene with `luxodus check`";
  return "too few particles for a slope: an error needs two batches, and a slope two errors; ask "
         "for "
         "more with --particles";
}

SvgPlot plot_of(const std::vector<Point>& points, double Point::*x, const std::string& scene,
                const std::string& x_label) {
  SvgPlot plot;
  plot.title = "Error of " + scene;
  plot.label_x = x_label;
  plot.label_y = "worst relative standard error";
  plot.log_x = plot.log_y = true;
  plot.reference = PlotReference{};
  PlotSeries series;
  series.name = "measured";
  for (const Point& p : points) {
    series.x.push_back(p.*x);
    series.y.push_back(p.error);
  }
  plot.series.push_back(std::move(series));
  return plot;
}

Result<void> write_points(const fs::path& out, const std::vector<Point>& points,
                          const std::string& name) {
  CsvTable table({"particles", "seconds", "relative_error", "figure_of_merit_per_s"});
  for (const Point& p : points) {
    table.cell(p.particles).cell(p.seconds).cell(p.error).cell(p.figure_of_merit);
    table.end_row();
  }
  if (auto ok = write_csv(out / "converge.csv", table); !ok) return ok.problem();
  if (auto ok = write_svg_plot(out / "error_particles.svg",
                               plot_of(points, &Point::particles, name, "particles"));
      !ok)
    return ok.problem();
  return write_svg_plot(out / "error_seconds.svg",
                        plot_of(points, &Point::seconds, name, "time [s]"));
}

/// The table and slopes on standard output, as text or JSON.
void print_points(const std::vector<Point>& points, bool json, const fs::path& out) {
  const double by_particles = slope(points, &Point::particles);
  const double by_seconds = slope(points, &Point::seconds);
  if (json) {
    Json rows = Json::array();
    for (const Point& p : points)
      rows.push_back({{"particles", p.particles},
                      {"seconds", p.seconds},
                      {"relative_error", p.error},
                      {"figure_of_merit", p.figure_of_merit}});
    std::fputs(
        json_text(
            {{"points", rows}, {"slope_particles", by_particles}, {"slope_seconds", by_seconds}})
            .c_str(),
        stdout);
    return;
  }
  std::printf("%14s %10s %12s %16s\n", "particles", "seconds", "error", "merit 1/(e2 s)");
  for (const Point& p : points)
    std::printf("%14.0f %10.2f %11.4f%% %16.4g\n", p.particles, p.seconds, 100 * p.error,
                p.figure_of_merit);
  std::printf(
      "slope of error: %.3f over particles, %.3f over seconds (Monte Carlo: -0.5)\nwritten to %s\n",
      by_particles, by_seconds, out.string().c_str());
}

Result<ExitCode> converge(const ConvergeOptions& options) {
  auto most = parse_count(options.particles);
  if (!most) return most.problem();
  const auto [description, told] = load_scene(options.scene);
  if (!description) return problem_in(options.scene, "the scene has problems, told above", told);
  auto scenario = find_scenario(*description, options.scenario);
  if (!scenario) return scenario.problem();
  auto scene = compile_scene(description, scenario.value(), {1, options.error_of});
  if (!scene) return scene.problem();
  const fs::path folder =
      options.out.empty()
          ? fs::path("out") / file_name_of(fs::path(options.scene).stem().string() + "_converge")
          : fs::path(options.out);
  const auto out = OutputFolder::claim(
      folder, {{"converge.csv", "error_particles.svg", "error_seconds.svg"}, {}});
  if (!out) return out.problem();
  install_interrupt_handler();
  LocalRun run(scene.value(), options.seed.value_or(description->run.seed), options.threads);
  const Course course = trace_course(run, most.value());
  const bool enough = course.points.size() >= 2;
  if (!enough && !course.interrupted) return problem_in(options.scene, why_no_slope(course));
  if (enough) {
    if (auto ok = write_points(out->path(), course.points, description->name); !ok)
      return ok.problem();
    print_points(course.points, options.json, folder);
  }
  if (!course.interrupted) return ExitCode::success;
  log_warning("{}", enough ? "interrupted; the points measured until then were written"
                           : "interrupted before there were two points; nothing was written");
  return ExitCode::interrupted;
}

}  // namespace

Command converge_command() {
  const auto o = std::make_shared<ConvergeOptions>();
  return {.name = "converge",
          .summary = "Measure how the error falls: table, CSV, plots, slope",
          .heading = "Results",
          .options = {{"scene", &o->scene, "Scene file", {.form = Form::scene, .required = true}},
                      {"--scenario",
                       &o->scenario,
                       "Name of a scenario",
                       {.form = Form::name, .otherwise = "the first"}},
                      {"--particles",
                       &o->particles,
                       "Number of particles of the last point",
                       {.form = Form::count}},
                      {"--error-of",
                       &o->error_of,
                       "Quantities whose error is measured, as of luxodus run",
                       {.otherwise = "those of the scene"}},
                      {"--out",
                       &o->out,
                       "Folder for converge.csv and the plots",
                       {.form = Form::folder, .otherwise = "out/NAME_converge"}},
                      {"--seed",
                       &o->seed,
                       "Seed of the random number generator",
                       {.otherwise = "the scene's"}},
                      threads_option(o->threads),
                      {"--json", &o->json, "Output as JSON"}},
          .notes =
              "Doubles the particles of one run until --particles, and records the error that "
              "`luxodus run` stops at. The slope is -0.5 for Monte Carlo: half the error costs "
              "four times the particles. The figure of merit 1 / (error^2 x seconds) stays level "
              "and compares machines and methods.",
          .run = [o] { return exit_code_of(converge(*o)); }};
}

}  // namespace luxodus::cli
