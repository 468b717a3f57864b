// luxodus render: makes pictures from a finished run, without tracing particles again.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "actors/apps/cli/command.hpp"
#include "actors/apps/cli/commands.hpp"
#include "actors/apps/cli/findings.hpp"
#include "actors/apps/cli/finished_run.hpp"
#include "actors/apps/cli/nodes_option.hpp"
#include "actors/apps/cli/picture_choices.hpp"
#include "actors/apps/cli/progress_line.hpp"
#include "actors/apps/cli/quantities.hpp"
#include "actors/apps/cli/signals.hpp"
#include "actors/results/files/result_files.hpp"
#include "actors/results/pictures/film.hpp"
#include "actors/results/pictures/pictures.hpp"
#include "actors/results/pictures/shared_exposure.hpp"
#include "actors/results/run/flux_store.hpp"
#include "runtime/core/log.hpp"

namespace luxodus::cli {

namespace {

namespace fs = std::filesystem;

struct RenderOptions {
  std::vector<std::string> folders;
  std::string view;
  int threads = default_threads();
  int nodes = 0;
  PictureChoices limits;
  bool full_paths = false;
  bool raw = false;
  std::string route;
  std::vector<std::string> through;
  double speed = FilmedWalk().speed_m_s, fps = FilmedWalk().frames_per_s;
  double eye_height = FilmedWalk().eye_height_m;
  bool human = false;
  std::string from, state_step = "1s";  // on the scene's clock
  double clock = 1;                     // its seconds for each second of the film
};

/// The route of this name. Errors: it does not exist; the existing ones are listed.
Result<const EscapeRoute*> route_named(const SceneDescription& scene, const std::string& name) {
  std::string known;
  for (const EscapeRoute& route : scene.routes) {
    if (route.name == name) return &route;
    known += (known.empty() ? "\"" : ", \"") + route.name + "\"";
  }
  return problem_in(scene.file,
                    "there is no route \"" + name + "\"; there " +
                        (known.empty() ? "are none: add a [[route]]" : "are: " + known));
}

/// Size and angle of view of a film: those of the named camera, or a camera's defaults.
Result<Camera> lens_of(const SceneDescription& scene, const std::string& view) {
  if (auto ok = check_views(scene, view, {}); !ok) return ok.problem();
  for (const Camera& camera : scene.cameras)
    if (!view.empty() && camera.name == view) return camera;
  return Camera();
}

/// The keyframes of TIME=CAMERA. Errors: malformed text, an unknown camera.
Result<std::vector<Keyframe>> keyframes_of(const SceneDescription& scene,
                                           const std::vector<std::string>& through) {
  std::vector<Keyframe> keys;
  for (const std::string& text : through) {
    const size_t mark = text.find('=');
    const auto time = parse_time(text.substr(0, mark));
    if (mark == std::string::npos || !time)
      return problem("--through takes TIME=CAMERA, as in --through 4s=corridor, not \"" + text +
                     "\"");
    const std::string name = text.substr(mark + 1);
    if (name.empty()) return problem("--through names no camera in \"" + text + "\"");
    if (auto ok = check_views(scene, name, {}); !ok) return ok.problem();
    for (const Camera& camera : scene.cameras)
      if (camera.name == name) keys.push_back({time.value(), camera});
  }
  return keys;
}

/// A film, its name for display, and that of its files.
struct NamedFilm {
  Film film;
  std::string name;
};

/// Nothing if no film is requested.
Result<std::optional<NamedFilm>> film_of(const SceneDescription& scene,
                                         const RenderOptions& options) {
  const bool walks = !options.route.empty(), flies = !options.through.empty();
  if (!walks && !flies) {
    if (options.human || options.fps != RenderOptions().fps || !options.from.empty())
      return problem("--human, --fps and --from are of films: say --route or --through, too");
    return std::optional<NamedFilm>();
  }
  if (walks && flies) return problem("--route excludes --through: a film is of one of them");
  if (!options.limits.time.empty() || !options.limits.error.empty())
    return problem(
        "--route and --through exclude --picture-time and --picture-error: say how many "
        "--paths");
  NamedFilm out;
  out.film.human = options.human;
  out.film.frames_per_s = options.fps;
  auto lens = lens_of(scene, options.view);
  if (!lens) return lens.problem();
  Result<std::vector<Camera>> cameras = std::vector<Camera>();
  if (walks) {
    const auto route = route_named(scene, options.route);
    if (!route) return route.problem();
    const auto number = static_cast<size_t>(route.value() - scene.routes.data());
    out.name = film_names(scene)[number];
    lens->name = options.route;
    cameras =
        cameras_of(*route.value(), {options.speed, options.fps, options.eye_height}, lens.value());
  } else {
    const auto keys = keyframes_of(scene, options.through);
    if (!keys) return keys.problem();
    if (options.view.empty()) lens.value() = keys->front().camera;
    lens->name = keys->front().camera.name + " to " + keys->back().camera.name;
    out.name = film_names(scene, lens->name).back();
    cameras = cameras_through(keys.value(), options.fps, lens.value());
  }
  if (!cameras) return cameras.problem();
  out.film.cameras = std::move(cameras).value();
  return std::optional(std::move(out));
}

/// The states of a film in which the scene's clock advances: each is traced with the seed and the
/// number of particles of the run, so that they differ only by the change.
class FilmedClock {
 public:
  FilmedClock(const FinishedRun& of, const LocalRun& run, const RenderOptions& options,
              size_t film_frames)
      : of_(of),
        options_(options),
        film_frames_(film_frames),
        particles_(run.batches() * run.scene().batch_particles),
        per_frame_s_(options.clock / options.fps),
        frames_(frames_of_state(parse_time(options.state_step).value(), per_frame_s_)) {}

  /// Errors: a last state that the scene cannot have; checked before the first is traced.
  Result<void> check() const {
    const auto last = scene_at((film_frames_ - 1) / frames_);
    if (!last) return last.problem();
    return {};
  }
  /// `show` displays the current step.
  FilmedStates states(const std::function<void(const std::string& what)>& show) const {
    return {frames_, [this, show](size_t state) { return traced(state, show); }};
  }

 private:
  using Traced = Result<std::shared_ptr<const LocalRun>>;

  /// A state is taken at the middle of the frames that show it; the film may end before the last
  /// one's.
  double time_of(size_t state) const {
    const size_t first = state * frames_;
    const size_t shown = std::min(frames_, film_frames_ - first);
    return parse_time(options_.from).value() +
           per_frame_s_ * (static_cast<double>(first) + 0.5 * static_cast<double>(shown - 1));
  }

  Result<SceneOfRun> scene_at(size_t state) const {
    FinishedRun then = of_;
    then.at_s = time_of(state);
    then.batch_shares.clear();  // they were allocated for the run's state, but lights may come and
                                // go
    return scene_of_run(then);
  }

  Traced traced(size_t state, const std::function<void(const std::string& what)>& show) const {
    const std::string name = fmt::format("the state at {:.4g} s", time_of(state));
    show("reading " + name);
    const auto scene = scene_at(state);
    if (!scene) return scene.problem();
    auto run = std::make_shared<LocalRun>(scene->scene, of_.seed, options_.threads);
    StopRule stop;
    stop.particles = particles_;
    const auto reason = run->run(stop, interrupt_flag(), [&](const Progress& progress) {
      show(fmt::format(
          "tracing {}, {:.0f} %", name,
          100 * static_cast<double>(progress.particles) / static_cast<double>(particles_)));
    });
    if (reason == StopReason::interrupted) return Traced(nullptr);
    return Traced(std::move(run));
  }

  const FinishedRun& of_;
  const RenderOptions& options_;
  const size_t film_frames_;
  const int64_t particles_;
  const double per_frame_s_;
  const size_t frames_;
};

/// Frames in a folder, and the film that is made of them.
struct MadeFrames {
  fs::path folder, file;
  size_t frames = 0;
};

/// What the runs of a call make together.
struct Together {
  std::optional<SharedExposure> exposure;  // nothing: each picture has its own, or the stated one
  std::vector<OutputFolder> folders;       // held until all is written
  std::vector<MadeFrames> films;           // with all their frames
};

/// Renders frames into DIR/films/NAME. `clock`: null if it stands still.
Result<ExitCode> render_frames(const fs::path& folder, const LocalRun& run, const NamedFilm& named,
                               const PictureOptions& picture, const FilmedClock* clock,
                               Together& together) {
  const auto& [film, name] = named;
  const fs::path frames = folder / "films" / name;
  const fs::path file = folder / "films" / (name + ".mp4");
  const size_t count = film.cameras.size();
  std::error_code failed;
  fs::remove(file, failed);  // of an earlier film with other frames
  if (failed) return system_problem(file, "cannot remove an earlier film", failed.value());
  std::optional<ProgressLine> line("film");
  double done = 0;
  const auto show = [&](const std::string& more) {
    line->show_share(
        done / static_cast<double>(count),
        fmt::format(", frame {:.0f} of {}{}",
                    std::min(std::floor(done) + 1, static_cast<double>(count)), count, more));
  };
  const auto progress = [&](double now_done) {
    done = now_done;
    show("");
  };
  const auto made =
      clock != nullptr
          ? render_film(frames, clock->states([&](const std::string& what) { show(", " + what); }),
                        film, picture, progress)
          : render_film(frames, run, film, picture, progress);
  line.reset();
  if (!made) return made.problem();
  if (made.value() < count) {
    log_warning("interrupted; {} of {} frames are there", made.value(), count);
    return ExitCode::interrupted;
  }
  tell_flames(run.scene(), picture);
  together.films.push_back({frames, file, count});
  return ExitCode::success;
}

/// Exposes the pictures that share an exposure.
Result<void> expose(Together& together, int threads) {
  if (!together.exposure || together.exposure->pictures() == 0) return {};
  const auto exposure = together.exposure->write(threads);
  if (!exposure) return exposure.problem();
  log_info("exposure of {} pictures together: {}", together.exposure->pictures(),
           text_of(exposure.value()));
  return {};
}

/// Makes the films of frames.
Result<ExitCode> make_videos(const std::vector<MadeFrames>& films, double fps,
                             const PictureOptions& picture) {
  for (const auto& [frames, file, count] : films) {
    const auto video = write_video(file, frames, count, fps);
    if (picture.interrupted()) {
      log_warning("interrupted; {} frames are in {}", count, frames.string());
      return ExitCode::interrupted;
    }
    if (!video) return video.problem();
    if (video.value())
      log_info("film: {} frames, and {}", count, file.string());
    else
      log_info("film: {} frames in {}; there is no ffmpeg on the path to make an MP4 file of them",
               count, frames.string());
  }
  return ExitCode::success;
}

OutputPlan plan_of_film(const std::string& name) {
  return {{"films/" + name + ".mp4"}, {"films", "films/" + name}};
}

/// Renders one run.
Result<ExitCode> render_run(const fs::path& folder, const RenderOptions& options,
                            PictureOptions picture, Together& together) {
  const auto finished = read_finished_run(folder);
  if (!finished) return finished.problem();
  const auto of_run = scene_of_run(finished.value());
  if (!of_run) return of_run.problem();
  const auto& [scenario, scene] = of_run.value();
  const auto& description = scene->description;
  if (auto ok = check_views(*description, options.view, picture); !ok) return ok.problem();
  const auto film = film_of(*description, options);
  if (!film) return film.problem();
  const std::optional<NamedFilm>& filmed = film.value();
  if (!filmed && description->cameras.empty())
    return problem_in(finished->scene_file, "the scene has no [[camera]] to render");
  if (const auto refused = refused_by_inspection(description, {scenario}, options.threads))
    return problem_in(finished->scene_file, "the scene has errors, told above", *refused);
  auto out = OutputFolder::claim(folder,
                                 filmed ? plan_of_film(filmed->name) : plan_of_views(*description));
  if (!out) return out.problem();
  const fs::path into = together.folders.emplace_back(std::move(out).value()).path();
  LocalRun run(scene, finished->seed, options.threads);
  if (auto ok = load_flux(into / "flux.lux", run); !ok) return ok.problem();
  std::unique_ptr<PictureNodes> nodes;
  if (options.nodes > 0) {
    auto started = PictureNodes::start(run, options.nodes);
    if (!started) return started.problem();
    nodes = std::move(started).value();
    picture.executor = &nodes->executor();
  }
  if (picture.exposed_with == nullptr && picture.share_exposure)
    picture.exposed_with = &together.exposure.emplace(into);
  if (filmed && !options.from.empty()) {
    const FilmedClock clock(finished.value(), run, options, filmed->film.cameras.size());
    if (auto ok = clock.check(); !ok) return ok.problem();
    return render_frames(into, run, *filmed, picture, &clock, together);
  }
  if (filmed) return render_frames(into, run, *filmed, picture, nullptr, together);
  return render_aloud(into, run, options.view, picture);
}

Result<ExitCode> render(const RenderOptions& options) {
  PictureOptions picture;
  if (auto ok = read_choices(options.limits, picture); !ok) return ok.problem();
  // Frames of a film flicker if each has its own.
  const bool films = !options.route.empty() || !options.through.empty();
  if (films && options.limits.exposure.empty()) picture.share_exposure = true;
  install_interrupt_handler();
  picture.progressive = true;
  picture.gather = !options.full_paths;
  picture.raw = options.raw;
  picture.interrupt = &interrupt_flag();
  Together together;
  ExitCode code = ExitCode::success;
  for (const std::string& folder : options.folders) {
    if (together.exposure) picture.exposed_with = &*together.exposure;
    const auto rendered = render_run(folder, options, picture, together);
    if (!rendered) return rendered.problem();
    code = rendered.value();
    if (code != ExitCode::success) break;
  }
  if (auto ok = expose(together, options.threads); !ok) return ok.problem();
  if (code != ExitCode::success) return code;
  return make_videos(together.films, options.fps, picture);
}

}  // namespace

namespace {

std::vector<Option> render_options(RenderOptions& o) {
  std::vector<Option> all{
      {"dir",
       &o.folders,
       "Folder of a finished run, or several",
       {.form = Form::folder, .required = true}},
      {"--view", &o.view, "Name of one camera", {.form = Form::name, .otherwise = "all cameras"}}};
  for (Option& option : options_of(o.limits, "--paths")) all.push_back(std::move(option));
  const std::vector<Option> more{
      {"--full-paths", &o.full_paths,
       "Paths traced to their end instead of to the run's flux: slower and noisier, free of the "
       "patches' size"},
      {"--raw", &o.raw,
       "PNG files of the light as traced, with its noise; as many paths for all pixels"},
      threads_option(o.threads),
      nodes_option(o.nodes)};
  all.insert(all.end(), more.begin(), more.end());
  const std::vector<Option> film{
      {"--route",
       &o.route,
       "Name of the route that a film walks, into DIR/films",
       {.form = Form::name, .otherwise = "no film", .group = "Film"}},
      {"--through",
       &o.through,
       "Camera that a film passes, and when: TIME=CAMERA, as in 4s=corridor; said of each, two at "
       "least, in their order",
       {.form = Form::name, .otherwise = "no film", .group = "Film"}},
      {"--speed",
       &o.speed,
       "Walking speed [m/s]",
       {.range = Range{0.01, 100}, .group = "Film", .needs = "--route"}},
      {"--fps", &o.fps, "Frames a second", {.range = Range{0.1, 240}, .group = "Film"}},
      {"--eye-height",
       &o.eye_height,
       "Height of the eyes above the route [m]",
       {.range = Range{0.1, 10}, .group = "Film", .needs = "--route"}},
      {"--human",
       &o.human,
       "Frames as an adapted eye sees them, instead of one exposure",
       {.group = "Film"}},
      {"--from",
       &o.from,
       "Time of the scene's clock at the first frame; the clock then goes on with the film, and "
       "each state is traced with the particles of the run",
       {.form = Form::duration,
        .otherwise = "the run's state stands",
        .group = "Film",
        .excludes = "--nodes",
        .check = check_time}},
      {"--clock",
       &o.clock,
       "Seconds of the scene's clock in a second of the film",
       {.range = Range{0.001, 100'000}, .group = "Film", .needs = "--from"}},
      {"--state-step",
       &o.state_step,
       "Time of the scene's clock between two states; no less than a frame's",
       {.form = Form::duration,
        .group = "Film",
        .needs = "--from",
        .check = [](const std::string& text) {
          const auto step = parse_seconds(text);
          return step ? Result<void>() : step.problem();
        }}}};
  all.insert(all.end(), film.begin(), film.end());
  return all;
}

}  // namespace

Command render_command() {
  const auto o = std::make_shared<RenderOptions>();
  return {
      .name = "render",
      .summary = "Make pictures from a finished run, without tracing it again",
      .heading = "Results",
      .options = render_options(*o),
      .notes =
          "Reads DIR/result.json, DIR/flux.lux and the scene file; refuses if the scene has "
          "changed. A first picture of each view is there after seconds; it is replaced by better "
          "ones. Equal paths give equal pictures, bit for bit, however they came together, and "
          "whether "
          "threads or nodes traced them. Ctrl-C "
          "keeps the pictures of the paths that all of their pixels have. The last quarter of the "
          "paths goes where the filter would leave most error; not with --raw, in films, or with "
          "fewer than 16.\n\n"
          "Clear air, smoke and the dark are runs of their own. Their pictures can be compared if "
          "they share one exposure:\n"
          "  luxodus render out/clear out/smoke out/dark --view corridor --exposure shared\n"
          "With --white adapted they then share one white, too.\n\n"
          "With --route it renders a film instead: what somebody sees who walks a route of the "
          "scene, as DIR/films/ROUTE/000000.png and so on, and where there is ffmpeg as "
          "DIR/films/ROUTE.mp4. With --through it goes through cameras of the scene instead:\n"
          "  luxodus render out/office_floor --through 0s=corridor --through \"6s=open plan\"\n"
          "A scene that changes in time is filmed while its clock goes on, here 90 s in 9 s from a "
          "place that stands:\n"
          "  luxodus render out/fire --through 0s=hall --through 9s=hall --from 0s --clock 10\n"
          "Ctrl-C keeps whole frames.",
      .run = [o] { return exit_code_of(render(*o)); }};
}

}  // namespace luxodus::cli
