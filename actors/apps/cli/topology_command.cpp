// luxodus topology: makes, measures, compares and draws graphs of a cluster's links.
#include <fmt/format.h>

#include <functional>

#include "actors/apps/cli/command.hpp"
#include "actors/apps/cli/commands.hpp"
#include "actors/apps/cli/quantities.hpp"
#include "actors/apps/cli/signals.hpp"
#include "actors/apps/cli/topology_report.hpp"
#include "runtime/core/atomic_file.hpp"
#include "runtime/core/clock.hpp"
#include "runtime/core/log.hpp"
#include "runtime/core/output_path.hpp"
#include "runtime/core/regular_file.hpp"
#include "topology/amp.hpp"
#include "topology/builders.hpp"
#include "topology/draw.hpp"
#include "topology/graph_file.hpp"
#include "topology/shipped.hpp"

namespace luxodus::cli {
namespace {

struct TopologyOptions {
  AmpRequest amp;
  std::string seconds;  // as given; "" if none
  bool search = false;
  std::string kind;
  std::string in, out;
  bool json = false;
};

Result<Graph> read_graph(const std::string& file) {
  const auto bytes = read_whole_file(file, limits::graph_file_bytes);
  if (!bytes) return bytes.problem();
  return parse_graph({reinterpret_cast<const char*>(bytes->data()), bytes->size()}, file);
}

/// Writes the graph, if requested, and prints its measures.
Result<ExitCode> save_and_report(const TopologyOptions& options, const Graph& graph) {
  if (!options.out.empty()) {
    const auto written =
        write_file_atomically(behind_links(options.out), std::string_view(graph_text(graph)));
    if (!written) return written.problem();
  }
  const Measures measures = measure(graph);
  const std::string report =
      options.json ? json_text(measures_json(graph, measures)) : measures_text(graph, measures);
  std::fputs(report.c_str(), stdout);
  return ExitCode::success;
}

/// One of the shipped graphs, unless a search is requested.
Result<Graph> amp_graph(const TopologyOptions& options) {
  AmpRequest request = options.amp;
  const ControllerRole role =
      request.controller_forwards ? ControllerRole::forwards : ControllerRole::endpoint;
  const bool search = options.search || !options.seconds.empty();
  if (!search) {
    if (auto shipped =
            shipped_graph({request.nodes, request.links, request.controller_links}, role)) {
      log_info("this graph ships with the program; --search looks for another");
      return *shipped;
    }
  }
  const SystemClock clock;
  const Nanoseconds start = clock.now();
  std::optional<Nanoseconds> end;
  if (!options.seconds.empty()) {
    const auto given = parse_seconds(options.seconds);
    if (!given) return given.problem();
    end = start + static_cast<Nanoseconds>(given.value() * 1e9);
    request.runs = UINT32_MAX;
  }
  install_interrupt_handler();
  auto found = find_amp(request, [&] { return interrupt_flag() || (end && clock.now() >= *end); });
  if (!found) return found.problem();
  log_info("searched {:.2f} s: {} runs, {} moves, seed {}",
           static_cast<double>(clock.now() - start) / 1e9, found->runs, found->moves, request.seed);
  return found->graph;
}

Result<ExitCode> amp(const TopologyOptions& options) {
  const auto graph = amp_graph(options);
  if (!graph) return graph.problem();
  return save_and_report(options, graph.value());
}

/// The named graphs, and how each is made from nodes, links and seed.
struct Kind {
  const char* name;
  std::function<Result<Graph>(const AmpRequest&)> make;
};
std::vector<Kind> kinds() {
  return {
      {"ring", [](const AmpRequest& r) { return make_ring(r.nodes); }},
      {"mesh", [](const AmpRequest& r) { return make_mesh(r.nodes); }},
      {"torus", [](const AmpRequest& r) { return make_torus(r.nodes); }},
      {"hypercube", [](const AmpRequest& r) { return make_hypercube(r.nodes); }},
      {"ternary-tree", [](const AmpRequest& r) { return make_ternary_tree(r.nodes); }},
      {"chordal-ring", [](const AmpRequest& r) { return make_chordal_ring(r.nodes); }},
      {"random-regular",
       [](const AmpRequest& r) { return make_random_regular(r.nodes, r.links, r.seed); }},
  };
}

Result<ExitCode> build(const TopologyOptions& options) {
  for (const Kind& kind : kinds()) {
    if (options.kind != kind.name) continue;
    const auto graph = kind.make(options.amp);
    if (!graph) return graph.problem();
    return save_and_report(options, graph.value());
  }
  return problem(fmt::format("there is no kind \"{}\"", options.kind));
}

Result<ExitCode> measure_file(const TopologyOptions& options) {
  const auto graph = read_graph(options.in);
  if (!graph) return graph.problem();
  return save_and_report(options, graph.value());
}

Result<ExitCode> compare(const TopologyOptions& options) {
  std::vector<Compared> compared;
  const auto add = [&](const std::string& name, const Result<Graph>& graph) {
    if (graph)
      compared.push_back({name, graph.value(), ""});
    else
      compared.push_back({name, std::nullopt, graph.problem().what});
  };
  for (const Kind& kind : kinds()) add(kind.name, kind.make(options.amp));
  add("minimum-path", amp_graph(options));
  const std::string report =
      options.json ? json_text(comparison_json(compared)) : comparison_text(compared);
  std::fputs(report.c_str(), stdout);
  return ExitCode::success;
}

Result<ExitCode> draw(const TopologyOptions& options) {
  const auto graph = read_graph(options.in);
  if (!graph) return graph.problem();
  const PathLengths paths = path_lengths(graph->all());
  const std::string title = fmt::format("{}: diameter {}, average path {:.6f}",
                                        title_of(graph.value()), paths.diameter, paths.average());
  std::string drawing;
  if (options.out.ends_with(".svg"))
    drawing = graph_svg(graph.value(), title);
  else if (options.out.ends_with(".dot"))
    drawing = graph_dot(graph.value(), title);
  else
    return problem_in(options.out, "a drawing is named *.svg or *.dot");
  const auto written = write_file_atomically(behind_links(options.out), std::string_view(drawing));
  if (!written) return written.problem();
  return ExitCode::success;
}

using OptionsPtr = std::shared_ptr<TopologyOptions>;

void add(std::vector<Option>& to, const std::vector<Option>& more) {
  to.insert(to.end(), more.begin(), more.end());
}

std::vector<Option> sizes(const OptionsPtr& o) {
  return {
      {"--nodes", &o->amp.nodes, "Number of nodes, the controller not counted", {.required = true}},
      {"--links", &o->amp.links, "Largest number of links of a node"},
      {"--seed", &o->amp.seed, "Seed of searches and random graphs"}};
}

Option json(const OptionsPtr& o) {
  return {"--json", &o->json, "Output as JSON"};
}

std::vector<Option> outputs(const OptionsPtr& o) {
  return {{"-o,--out", &o->out, "File for the graph (TOML)", {.form = Form::file}}, json(o)};
}

Option graph_argument(const OptionsPtr& o) {
  return {"file", &o->in, "Graph (TOML)", {.form = Form::file, .required = true}};
}

Command amp_command(const OptionsPtr& o) {
  Command command{
      .name = "amp",
      .summary = "Make a minimum-path graph: least diameter, then least average path",
      .options = sizes(o),
      .notes =
          "Without --seconds the same seed gives the same graph again. Beside each figure "
          "stands the bound that no wiring of so many nodes and links can beat.\n"
          "  luxodus topology amp --nodes 32 --links 4 -o amp32.toml\n"
          "  luxodus topology amp --nodes 32 --controller 4 -o amp32c.toml\n"
          "  luxodus topology amp --nodes 50 --seconds 60 -o amp50.toml",
      .run = [o] { return exit_code_of(amp(*o)); }};
  add(command.options,
      {{"--controller", &o->amp.controller_links,
        "Number of links of a controller, a vertex more, which uses up links of nodes; 0: no "
        "controller"},
       {"--controller-forwards", &o->amp.controller_forwards,
        "Messages of nodes may pass through the controller"},
       {"--search", &o->search, "Search for a graph, even if one of this size ships"},
       {"--seconds",
        &o->seconds,
        "Time of the search (90, 5m), or until many graphs meet the bound",
        {.form = Form::duration}}});
  add(command.options, outputs(o));
  return command;
}

Command build_command(const OptionsPtr& o) {
  std::vector<std::string> names;
  for (const Kind& kind : kinds()) names.emplace_back(kind.name);
  Command command{
      .name = "build",
      .summary = "Make a graph of a named kind, to compare with",
      .options = {{"kind", &o->kind, "Kind of the graph", {.choices = names, .required = true}}},
      .notes = "--links and --seed are for random-regular; the others have the links they have.",
      .run = [o] { return exit_code_of(build(*o)); }};
  add(command.options, sizes(o));
  add(command.options, outputs(o));
  return command;
}

Command measure_command(const OptionsPtr& o) {
  return {.name = "measure",
          .summary = "Measure a graph: diameter, average path, bisection, failures",
          .options = {graph_argument(o), json(o)},
          .notes =
              "The average path is in hops over all ordered pairs. The heaviest link is that "
              "of balanced shortest routes while every node sends one message to every other; "
              "its bound is the mean of all links, rounded up. Failures are all of one link "
              "or one vertex, the worst is shown.",
          .run = [o] { return exit_code_of(measure_file(*o)); }};
}

Command compare_graphs_command(const OptionsPtr& o) {
  Command command{.name = "compare",
                  .summary = "Compare a minimum-path graph with the usual ones of as many nodes",
                  .options = sizes(o),
                  .run = [o] { return exit_code_of(compare(*o)); }};
  command.options.push_back(json(o));
  return command;
}

Command draw_command(const OptionsPtr& o) {
  return {.name = "draw",
          .summary = "Draw a graph so that its structure is seen",
          .options = {graph_argument(o),
                      {"-o,--out",
                       &o->out,
                       "Drawing: *.svg, or *.dot for Graphviz",
                       {.form = Form::file, .required = true}}},
          .notes =
              "A graph with a rotation is drawn on a circle, links that turn into each other "
              "in one colour; others where distances on paper are nearest to hops.",
          .run = [o] { return exit_code_of(draw(*o)); }};
}

}  // namespace

Command topology_command() {
  const auto o = std::make_shared<TopologyOptions>();
  return {.name = "topology",
          .summary = "Make, measure, compare and draw the links of a cluster",
          .heading = "Cluster",
          .notes =
              "  luxodus topology compare --nodes 32\n"
              "  luxodus topology amp --nodes 32 --links 4 -o amp32.toml\n"
              "  luxodus topology draw amp32.toml -o amp32.svg",
          .commands = {amp_command(o), build_command(o), measure_command(o),
                       compare_graphs_command(o), draw_command(o)}};
}

}  // namespace luxodus::cli
