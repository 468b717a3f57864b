#include "actors/apps/cli/run_options.hpp"

#include <utility>

#include "actors/apps/cli/load_scene.hpp"
#include "actors/apps/cli/nodes_option.hpp"
#include "actors/apps/cli/quantities.hpp"
#include "actors/cast/process/planned_nodes.hpp"

namespace luxodus::cli {

namespace {

void append(std::vector<Option>& to, const char* group, std::vector<Option> more) {
  for (Option& option : more) {
    option.traits.group = group;
    to.push_back(std::move(option));
  }
}

std::vector<Option> scene_options(RunOptions& o) {
  return {
      {"scene", &o.scene, "Scene file, or a pack", {.form = Form::scene, .required = true}},
      {"--out", &o.out, "Folder of the results", {.form = Form::folder, .otherwise = "out/NAME"}},
      {"--scenario",
       &o.scenario,
       "Name of a scenario, or 'all'",
       {.form = Form::name, .otherwise = "the first"}},
      at_option(o.at),
      {"--seed", &o.seed, "Seed of the random number generator", {.otherwise = "the scene's"}},
      threads_option(o.threads),
      {"--cells",
       &o.cells,
       "Number of geometry cells; 1 is one merged scene",
       {.range = Range{1, 1'000'000}}},
      {"--json", &o.json,
       "Output of result.json instead of a summary; an array of them with --scenario all"},
      {"--verbose", &o.verbose, "Summary with the kernel and the energy balance"}};
}

std::vector<Option> stop_options(RunOptions& o) {
  return {{"--particles",
           &o.particles,
           "Number of particles, e.g. 1e6, 250k, 10M (whole batches)",
           {.form = Form::count}},
          {"--error", &o.error, "Relative standard error to reach, e.g. 1%", {.form = Form::share}},
          {"--error-of",
           &o.error_of,
           "Quantities that --error is of, the worst of all that are given: planes, probes, signs, "
           "surfaces, cells of planes and patches (95 % of them), \"plane NAME\", \"cells "
           "NAME\", \"probe NAME\", \"sign NAME\"",
           {.otherwise = "error_of of the scene, or planes, probes and signs"}},
          {"--time", &o.time, "Time to trace for, e.g. 60s, 5m", {.form = Form::duration}},
          {"--adaptive", &o.adaptive,
           "Adaptive allocation of particles to source groups ([run] groups: circuit or emitter), "
           "as planes, cells, surfaces or patches of --error-of need them, by a first round that "
           "is not kept"}};
}

std::vector<Option> node_options(RunOptions& o) {
  return {
      {"--nodes",
       &o.nodes,
       "Number of nodes to trace on, a thread each, linked as a minimum-path graph; 0: the "
       "plain loop",
       {.range = Range{0, limits::nodes_in_process}}},
      {"--fibers", &o.fibers, "Number of photon-threads of a node", {.range = Range{1, 16384}}},
      {"--plan", &o.plan, "Plan of what each node may take in memory; nothing is traced"},
      {"--part-cache-mib",
       &o.part_cache_mib,
       "Budget of a node for geometry cells, bricks of smoke data and tiles of pictures [MiB]; "
       "what does not fit is fetched from other nodes; 0: everything is resident",
       {.range = Range{0, 1048576}}},
      {"--prefetch",
       &o.prefetch,
       "With --part-cache-mib: number of cells that a ray enters next, requested ahead of the "
       "one that is waited for",
       {.range = Range{0, 64}}},
      {"--no-sharing", &o.no_sharing,
       "With --part-cache-mib: a copy of each scene part for every node that needs it, as if "
       "the nodes were processes"},
      {"--profile",
       &o.profile,
       "With --part-cache-mib: share of the particles that is traced beforehand, to plan which "
       "node traces, holds and keeps what; 0: none",
       {.form = Form::share}},
      {"--tally-mib",
       &o.tally_mib,
       "Budget of a node for scores, totals and flushes [MiB]; a tally that is full flushes; "
       "0: what all bins take",
       {.range = Range{0, 1048576}}},
      {"--tally-shards",
       &o.tally_shards,
       "Number of shares of the totals: one stays with the controller, nodes hold the others",
       {.range = Range{1, limits::nodes_in_process + 1}}},
      {"--fan-out",
       &o.fan_out,
       "Number of nodes that a coordinator leads at most: beyond it some nodes lead the others and "
       "trace nothing; 0: all below 64 nodes, else their square root",
       {.range = Range{0, limits::nodes_in_process}}},
      {"--link-delay",
       &o.link_delay,
       "Delay of every link, to see what a distance costs and how many fibers hide it, e.g. 1ms",
       {.form = Form::duration, .otherwise = "none"}},
      {"--metrics", &o.metrics_port,
       "Port of 127.0.0.1 where the nodes' metrics are served during the run, for `luxodus "
       "status` and Prometheus; 0: any that is free"},
      {"--trace-every",
       &o.trace_every,
       "Interval of the particles whose histories on the nodes are written into trace.json, "
       "for ui.perfetto.dev; 0: none",
       {.range = Range{0, 1e12}}}};
}

std::vector<Option> picture_options(RunOptions& o) {
  std::vector<Option> all = options_of(o.picture, "--picture-paths");
  const std::vector<Option> more{
      {"--preview",
       &o.preview,
       "Interval of pictures during the run, in DIR/preview, e.g. 60s; one more whenever the "
       "process gets SIGUSR1",
       {.form = Form::duration, .otherwise = "none"}},
      {"--raw", &o.raw,
       "PNG files of the light as traced, with its noise; as many paths for all pixels"},
      {"--no-views", &o.no_views, "No pictures"}};
  all.insert(all.end(), more.begin(), more.end());
  return all;
}

std::vector<Option> folder_options(RunOptions& o) {
  return {{"--checkpoint",
           &o.checkpoint,
           "Interval at which flux.lux is saved during the run: one that is killed continues from "
           "there with --resume; 0: at the end only",
           {.form = Form::duration}},
          {"--resume", &o.resume,
           "Continuation of the flux file in DIR; with --scenario all those not begun start"},
          {"--overwrite",
           &o.overwrite,
           "Replacement of files in DIR that no run has written, and of a longer run of the same "
           "scene",
           {.excludes = "--resume"}}};
}

}  // namespace

std::vector<Option> options_of(RunOptions& options) {
  std::vector<Option> all = scene_options(options);
  append(all, "When it stops", stop_options(options));
  append(all, "Folder of the results", folder_options(options));
  append(all, "Pictures", picture_options(options));
  append(all, "Nodes", node_options(options));
  return all;
}

const char* run_notes() {
  return "Examples:\n"
         "  luxodus run scenes/library/empty_room.toml --out out/room --particles 10M\n"
         "  luxodus run scenes/library/office_floor.toml --scenario all --particles 4M\n"
         "  luxodus run scenes/library/empty_room.toml --error 1%\n"
         "  luxodus run scenes/library/office_floor.toml --error 2% \\\n"
         "    --error-of \"plane corridor floor\"\n"
         "  luxodus run scene.toml --out out/x --time 60s     then: ... --time 60s --resume\n\n"
         "Stops at the first of --particles, --error and --time that holds (4M particles if none "
         "is given). The error is the worst relative standard error of plane means, probes and "
         "signs at the eye, or of what --error-of names, and paths go there: a sign that thick "
         "smoke hides from a far observer takes very long. Ctrl-C stops at the end of a batch and "
         "writes what there is. Equal scene, seed, particles and cells give the same flux file, "
         "bit for bit, for any number of threads.\n\n"
         "DIR then holds result.json, flux.lux, planes/, views/, patches.vtp and volume.vti. A run "
         "there of the same scene is replaced by one that is as long or longer; by a shorter one, "
         "and files that no run has written, with --overwrite only. One process at a time writes "
         "into DIR.";
}

Result<void> fit_together(const RunOptions& options) {
  const std::pair<const char*, bool> about_nodes[] = {
      {"--plan", options.plan},
      {"--metrics", options.metrics_port.has_value()},
      {"--trace-every", options.trace_every != 0},
      {"--tally-mib", options.tally_mib > 0},
      {"--tally-shards", options.tally_shards > 1},
      {"--fan-out", options.fan_out > 0},
      {"--link-delay", !options.link_delay.empty()}};
  for (const auto& [name, given] : about_nodes)
    if (given && options.nodes == 0)
      return problem(std::string(name) + " requires --nodes: say how many");
  if (options.adaptive && (options.part_cache_mib > 0 || options.plan))
    return problem(
        "--adaptive excludes --part-cache-mib and --plan: its first round needs all "
        "geometry resident");
  return {};
}

Result<StopRule> stop_rule(const RunOptions& o) {
  StopRule rule;
  if (!o.particles.empty()) {
    auto n = parse_count(o.particles);
    if (!n) return n.problem();
    rule.particles = n.value();
  }
  if (!o.error.empty()) {
    auto e = parse_share(o.error);
    if (!e) return e.problem();
    rule.relative_error = e.value();
  }
  if (!o.time.empty()) {
    auto t = parse_seconds(o.time);
    if (!t) return t.problem();
    rule.seconds = t.value();
  }
  if (!rule.particles && !rule.relative_error && !rule.seconds) rule.particles = usual_particles;
  return rule;
}

Result<Nanoseconds> link_delay_of(const RunOptions& options) {
  if (options.link_delay.empty()) return Nanoseconds{0};
  auto delay_s = parse_seconds(options.link_delay);
  if (!delay_s) return delay_s.problem();
  const double max_s = static_cast<double>(limits::link_delay) * 1e-9;
  if (delay_s.value() > max_s)
    return problem("a link's delay must not be longer than 100 ms: beats count time");
  return static_cast<Nanoseconds>(delay_s.value() * 1e9);
}

}  // namespace luxodus::cli
