#include "actors/apps/cli/topology_report.hpp"

#include <fmt/format.h>

#include "topology/records.hpp"

namespace luxodus::cli {
namespace {

const char* name_of(ControllerRole role) {
  switch (role) {
    case ControllerRole::none:
      return "none";
    case ControllerRole::endpoint:
      return "endpoint";
    default:
      return "forwards";
  }
}

std::string hex(uint64_t hash) {
  return fmt::format("{:016x}", hash);
}

/// How an average compares: equal to the bound, or relative to the best known for the size.
std::string standing(const Graph& graph, const PartMeasures& all) {
  if (all.paths.hops == all.bound.hops) return "meets the bound: no wiring is shorter";
  if (graph.has_controller()) return "";
  const auto known = known_best(graph.workers(), graph.max_links());
  if (!known) return "";
  // Published to six digits.
  constexpr double equal = 1e-6;
  const double longer = all.paths.average() - known->average;
  if (longer < -equal)
    return fmt::format("a record: the shortest known was {:.6f}", known->average);
  return fmt::format("{} {:.6f}",
                     longer <= equal ? "as short as the shortest known," : "the shortest known has",
                     known->average);
}

std::string harm_text(const FailureHarm& harm) {
  if (harm.falls_apart) return "falls apart";
  return fmt::format("diameter {}, average {:.4f}", harm.diameter, harm.average);
}

std::string part_text(const char* name, const PartMeasures& part, const std::string& note) {
  std::string text = fmt::format("{:<28}{:>12}{:>12}\n", name, "", "bound");
  const auto row = [&](const char* what, const std::string& value, const std::string& bound,
                       const std::string& remark) {
    text += fmt::format("  {:<26}{:>12}{:>12}  {}", what, value, bound, remark);
    text.erase(text.find_last_not_of(' ') + 1);
    text += "\n";
  };
  row("diameter", fmt::to_string(part.paths.diameter), fmt::to_string(part.bound.diameter), "hops");
  row("average path", fmt::format("{:.6f}", part.paths.average()),
      fmt::format("{:.6f}", part.bound.average()),
      fmt::format("= {} hops / {} pairs", part.paths.hops, part.paths.pairs));
  if (!note.empty()) row("", "", "", note);
  row("edge connectivity", fmt::to_string(part.edge_connectivity), "", "links");
  row("vertex connectivity", fmt::to_string(part.vertex_connectivity), "", "vertices");
  row("girth", part.girth ? fmt::to_string(*part.girth) : "none", "", "links of the least cycle");
  row("bisection, at most", fmt::to_string(part.bisection_upper_bound), "",
      "links between halves, by a heuristic");
  text += fmt::format("  {:<26}{}\n", "any link failed", harm_text(part.any_link));
  text += fmt::format("  {:<26}{}\n", "any vertex failed", harm_text(part.any_vertex));
  return text;
}

std::string loads_text(const char* name, const LinkLoads& loads) {
  return fmt::format("  {:<26}{:>12}{:>12}  lightest {}\n", name, loads.heaviest, loads.bound,
                     loads.lightest);
}

}  // namespace

std::string title_of(const Graph& graph) {
  std::string title =
      fmt::format("{} nodes, {} links (at most {} a node), rotation {}", graph.workers(),
                  graph.links().size(), graph.max_links(), graph.rotation());
  if (graph.has_controller()) {
    title +=
        fmt::format("; controller {} with {} links{}", graph.controller(), graph.controller_links(),
                    graph.forwards(graph.controller()) ? "" : ", forwards nothing");
  }
  return title;
}

std::string measures_text(const Graph& graph, const Measures& m) {
  std::string text = title_of(graph) + "\n";
  text += part_text(graph.has_controller() ? "all, controller forwarding" : "all nodes", m.all,
                    standing(graph, m.all));
  if (m.workers) {
    text += part_text("nodes alone", *m.workers,
                      m.workers->paths.hops == m.workers->bound.hops
                          ? "meets the bound: no wiring is shorter"
                          : "");
    text += fmt::format("from the controller\n  {:<26}{:>12.6f}{:>12.6f}  hops, at most {}\n",
                        "average path", m.from_controller->average(),
                        m.from_controller_bound->average(), m.from_controller->diameter);
  }
  text += "messages on a link, balanced routes\n";
  text += loads_text("all nodes to all", m.all_to_all);
  if (m.gather) text += loads_text("all nodes to controller", *m.gather);
  text += fmt::format("classes of buffers {}, after one failure {}; hash {}, with routes {}\n",
                      m.hop_classes, m.hop_classes_after_failure, hex(graph.hash()),
                      hex(m.routes_hash));
  return text;
}

namespace {

Json paths_json(const PathLengths& paths) {
  return {{"diameter", paths.diameter},
          {"average", number_json(paths.average())},
          {"hops", paths.hops},
          {"pairs", paths.pairs}};
}

Json harm_json(const FailureHarm& harm) {
  return {{"falls_apart", harm.falls_apart},
          {"diameter", harm.diameter},
          {"average", number_json(harm.average)}};
}

Json part_json(const PartMeasures& part) {
  return {{"paths", paths_json(part.paths)},
          {"bound", paths_json(part.bound)},
          {"edge_connectivity", part.edge_connectivity},
          {"vertex_connectivity", part.vertex_connectivity},
          {"girth", part.girth ? Json(*part.girth) : Json(nullptr)},
          {"bisection_upper_bound", part.bisection_upper_bound},
          {"any_link_failed", harm_json(part.any_link)},
          {"any_vertex_failed", harm_json(part.any_vertex)}};
}

Json loads_json(const LinkLoads& loads) {
  return {{"heaviest", loads.heaviest}, {"lightest", loads.lightest}, {"bound", loads.bound}};
}

}  // namespace

Json measures_json(const Graph& graph, const Measures& m) {
  Json json = {
      {"nodes", graph.workers()},          {"max_links", graph.max_links()},
      {"links", graph.links().size()},     {"controller", name_of(graph.controller_role())},
      {"rotation", graph.rotation()},      {"hash", hex(graph.hash())},
      {"routes_hash", hex(m.routes_hash)}, {"all", part_json(m.all)}};
  if (m.workers) {
    json["nodes_alone"] = part_json(*m.workers);
    json["from_controller"] = paths_json(*m.from_controller);
    json["from_controller_bound"] = paths_json(*m.from_controller_bound);
    json["gather"] = loads_json(*m.gather);
  }
  json["all_to_all"] = loads_json(m.all_to_all);
  json["hop_classes"] = m.hop_classes;
  json["hop_classes_after_failure"] = m.hop_classes_after_failure;
  return json;
}

std::string comparison_text(const std::vector<Compared>& graphs) {
  std::string text = fmt::format("{:<18}{:>6}{:>7}{:>10}{:>11}{:>9}{:>11}  {}\n", "", "links",
                                 "links", "diameter", "average", "heavy", "bisection", "after any");
  text += fmt::format("{:<18}{:>6}{:>7}{:>10}{:>11}{:>9}{:>11}  {}\n", "graph", "a node", "in all",
                      "hops", "hops", "link", "links <=", "one failure");
  for (const Compared& compared : graphs) {
    if (!compared.graph) {
      text += fmt::format("{:<18} {}\n", compared.name, compared.why_not);
      continue;
    }
    const Graph& graph = *compared.graph;
    const Measures m = measure(graph);
    const FailureHarm& link = m.all.any_link;
    const FailureHarm& vertex = m.all.any_vertex;
    text += fmt::format("{:<18}{:>6}{:>7}{:>10}{:>11.6f}{:>9}{:>11}  {}\n", compared.name,
                        graph.max_links(), graph.links().size(), m.all.paths.diameter,
                        m.all.paths.average(), m.all_to_all.heaviest, m.all.bisection_upper_bound,
                        link.falls_apart || vertex.falls_apart
                            ? "falls apart"
                            : fmt::format("diameter {}", std::max(link.diameter, vertex.diameter)));
  }
  return text;
}

Json comparison_json(const std::vector<Compared>& graphs) {
  Json json = Json::array();
  for (const Compared& compared : graphs) {
    Json entry = {{"graph", compared.name}};
    if (compared.graph)
      entry["measures"] = measures_json(*compared.graph, measure(*compared.graph));
    else
      entry["why_not"] = compared.why_not;
    json.push_back(std::move(entry));
  }
  return json;
}

}  // namespace luxodus::cli
