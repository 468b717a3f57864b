// luxodus topology: who talks to whom. Makes, measures, compares and draws the graphs of links that
// a cluster may have.
#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <functional>

#include "actors/cli/command.hpp"
#include "actors/cli/topology_report.hpp"
#include "runtime/core/atomic_file.hpp"
#include "runtime/core/clock.hpp"
#include "runtime/core/output_path.hpp"
#include "topology/amp.hpp"
#include "topology/builders.hpp"
#include "topology/draw.hpp"
#include "topology/graph_file.hpp"
#include "topology/shipped.hpp"

namespace luxodus::cli {
namespace {

struct TopologyOptions {
  AmpRequest amp;
  std::string seconds;  // as given: "" for none
  bool search = false;
  std::string kind;
  std::string in, out;
  bool json = false;
};

int refuse(const Problem& problem) {
  tell(problem);
  return ExitCode::bad_input;
}

Result<Graph> read_graph(const std::string& file) {
  const auto bytes = read_whole_file(file, limits::graph_file_bytes);
  if (!bytes.ok()) return bytes.problem();
  return parse_graph({reinterpret_cast<const char*>(bytes->data()), bytes->size()}, file);
}

/// Writes the graph, if it was asked for, and says what it is worth.
int save_and_report(const TopologyOptions& options, const Graph& graph) {
  if (!options.out.empty()) {
    const auto written =
        write_file_atomically(behind_links(options.out), std::string_view(graph_text(graph)));
    if (!written.ok()) return refuse(written.problem());
  }
  const Measures measures = measure(graph);
  const std::string report =
      options.json ? json_text(measures_json(graph, measures)) : measures_text(graph, measures);
  std::fputs(report.c_str(), stdout);
  return ExitCode::success;
}

/// Of the shipped graphs, unless a search is asked for.
Result<Graph> amp_graph(const TopologyOptions& options) {
  AmpRequest request = options.amp;
  const ControllerRole role =
      request.controller_forwards ? ControllerRole::forwards : ControllerRole::endpoint;
  const bool search = options.search || !options.seconds.empty();
  if (!search) {
    if (auto shipped =
            shipped_graph({request.nodes, request.links, request.controller_links}, role)) {
      spdlog::info("this graph ships with the program; --search looks for another");
      return *shipped;
    }
  }
  const SystemClock clock;
  const Nanoseconds start = clock.now();
  std::optional<Nanoseconds> end;
  if (!options.seconds.empty()) {
    const auto given = parse_seconds(options.seconds);
    if (!given.ok()) return given.problem();
    end = start + static_cast<Nanoseconds>(given.value() * 1e9);
    request.runs = UINT32_MAX;
  }
  install_interrupt_handler();
  auto found = find_amp(request, [&] { return interrupt_flag() || (end && clock.now() >= *end); });
  if (!found.ok()) return found.problem();
  spdlog::info("searched {:.2f} s: {} runs, {} moves, seed {}",
               static_cast<double>(clock.now() - start) / 1e9, found->runs, found->moves,
               request.seed);
  return found->graph;
}

int amp(const TopologyOptions& options) {
  const auto graph = amp_graph(options);
  if (!graph.ok()) return refuse(graph.problem());
  return save_and_report(options, graph.value());
}

/// The graphs with a name, and how each is made from nodes, links and seed.
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

int build(const TopologyOptions& options) {
  for (const Kind& kind : kinds()) {
    if (options.kind != kind.name) continue;
    const auto graph = kind.make(options.amp);
    if (!graph.ok()) return refuse(graph.problem());
    return save_and_report(options, graph.value());
  }
  return refuse({{}, fmt::format("there is no kind \"{}\"", options.kind)});
}

int measure_file(const TopologyOptions& options) {
  const auto graph = read_graph(options.in);
  if (!graph.ok()) return refuse(graph.problem());
  return save_and_report(options, graph.value());
}

int compare(const TopologyOptions& options) {
  std::vector<Compared> compared;
  const auto add = [&](const std::string& name, const Result<Graph>& graph) {
    if (graph.ok())
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

int draw(const TopologyOptions& options) {
  const auto graph = read_graph(options.in);
  if (!graph.ok()) return refuse(graph.problem());
  const PathLengths paths = path_lengths(graph->all());
  const std::string title = fmt::format("{}: diameter {}, average path {:.6f}",
                                        title_of(graph.value()), paths.diameter, paths.average());
  std::string drawing;
  if (options.out.ends_with(".svg"))
    drawing = graph_svg(graph.value(), title);
  else if (options.out.ends_with(".dot"))
    drawing = graph_dot(graph.value(), title);
  else
    return refuse({{options.out, 0}, "a drawing is named *.svg or *.dot"});
  const auto written = write_file_atomically(behind_links(options.out), std::string_view(drawing));
  return written.ok() ? ExitCode::success : refuse(written.problem());
}

using OptionsPtr = std::shared_ptr<TopologyOptions>;

void add_sizes(CLI::App* command, const OptionsPtr& options) {
  command->add_option("--nodes", options->amp.nodes, "nodes, the controller not counted")
      ->required();
  command->add_option("--links", options->amp.links, "links a node, at most [4]");
  command->add_option("--seed", options->amp.seed, "seed of searches and random graphs [0]")
      ->transform(seed_number());
}

void add_outputs(CLI::App* command, const OptionsPtr& options) {
  command->add_option("-o,--out", options->out, "write the graph to this file (TOML)");
  command->add_flag("--json", options->json, "machine-readable");
}

void add_amp(CLI::App& topology, const OptionsPtr& options, int& exit_code) {
  CLI::App* command = topology.add_subcommand(
      "amp", "Make a minimum-path graph: least diameter, then least average path");
  add_sizes(command, options);
  command->add_option(
      "--controller", options->amp.controller_links,
      "links of a controller, a vertex more, which uses up links of nodes [0: none]");
  command->add_flag("--controller-forwards", options->amp.controller_forwards,
                    "let messages of nodes pass through the controller");
  command->add_flag("--search", options->search, "search, even if a graph of this size ships");
  command->add_option("--seconds", options->seconds,
                      "search so long (90, 5m), or until many graphs meet the bound");
  add_outputs(command, options);
  command->footer(
      "Without --seconds the same seed gives the same graph again. Beside each figure stands\n"
      "the bound that no wiring of so many nodes and links can beat.\n"
      "  luxodus topology amp --nodes 32 --links 4 -o amp32.toml\n"
      "  luxodus topology amp --nodes 32 --controller 4 -o amp32c.toml\n"
      "  luxodus topology amp --nodes 50 --seconds 60 -o amp50.toml");
  command->callback([options, &exit_code] { exit_code = amp(*options); });
}

void add_build(CLI::App& topology, const OptionsPtr& options, int& exit_code) {
  CLI::App* command = topology.add_subcommand("build", "Make a graph with a name, to compare with");
  std::vector<std::string> names;
  for (const Kind& kind : kinds()) names.emplace_back(kind.name);
  command->add_option("kind", options->kind, "what it is")->required()->check(CLI::IsMember(names));
  add_sizes(command, options);
  add_outputs(command, options);
  command->footer(
      "--links and --seed are for random-regular; the others have the links they have.");
  command->callback([options, &exit_code] { exit_code = build(*options); });
}

void add_measure(CLI::App& topology, const OptionsPtr& options, int& exit_code) {
  CLI::App* command = topology.add_subcommand("measure", "Say what a graph is worth");
  command->add_option("file", options->in, "graph (TOML)")->required();
  command->add_flag("--json", options->json, "machine-readable");
  command->footer(
      "The average path is in hops over all ordered pairs. The heaviest link is that of balanced\n"
      "shortest routes while every node sends one message to every other; its bound is the mean "
      "of\n"
      "all links, rounded up. Failures are all of one link or one vertex, the worst is shown.");
  command->callback([options, &exit_code] { exit_code = measure_file(*options); });
}

void add_compare(CLI::App& topology, const OptionsPtr& options, int& exit_code) {
  CLI::App* command = topology.add_subcommand(
      "compare", "Set a minimum-path graph beside the usual ones of as many nodes");
  add_sizes(command, options);
  command->add_flag("--json", options->json, "machine-readable");
  command->callback([options, &exit_code] { exit_code = compare(*options); });
}

void add_draw(CLI::App& topology, const OptionsPtr& options, int& exit_code) {
  CLI::App* command = topology.add_subcommand("draw", "Draw a graph so that its structure is seen");
  command->add_option("file", options->in, "graph (TOML)")->required();
  command->add_option("-o,--out", options->out, "drawing: *.svg, or *.dot for Graphviz")
      ->required();
  command->footer(
      "A graph with a rotation is drawn on a circle, links that turn into each other in one "
      "colour;\n"
      "others where distances on paper are nearest to hops.");
  command->callback([options, &exit_code] { exit_code = draw(*options); });
}

}  // namespace

void add_topology(CLI::App& app, int& exit_code) {
  CLI::App* topology =
      app.add_subcommand("topology", "Make, measure, compare and draw the links of a cluster");
  topology->require_subcommand(1);
  topology->footer(
      "  luxodus topology compare --nodes 32\n"
      "  luxodus topology amp --nodes 32 --links 4 -o amp32.toml\n"
      "  luxodus topology draw amp32.toml -o amp32.svg");
  const auto options = std::make_shared<TopologyOptions>();
  add_amp(*topology, options, exit_code);
  add_build(*topology, options, exit_code);
  add_measure(*topology, options, exit_code);
  add_compare(*topology, options, exit_code);
  add_draw(*topology, options, exit_code);
}

}  // namespace luxodus::cli
