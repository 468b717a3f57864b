#include "actors/import/write_plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <set>

#include "actors/import/import_files.hpp"
#include "actors/import/join_lines.hpp"
#include "actors/import/own_tables.hpp"
#include "runtime/core/atomic_file.hpp"
#include "runtime/toml/document.hpp"
#include "runtime/toml/table_reader.hpp"
#include "scenes/formats/dxf/dxf_contents.hpp"
#include "scenes/light/geometry/mesh.hpp"

namespace luxodus {
namespace {

namespace fs = std::filesystem;

constexpr size_t max_plan_bytes = size_t{16} << 20;
/// Larger plans are in another unit [m].
constexpr double largest_plan_m = 10'000;

struct LayerRule {
  std::string as = "nothing", material;
  double height_m = 3, thickness_m = 0.1;
};
struct BlockRule {
  std::string as = "nothing", type;
  double height_m = 2.5;
};
struct PlanRules {
  double floor_m = 0;
  std::optional<double> ceiling_m;
  std::map<std::string, LayerRule> layers;
  std::map<std::string, BlockRule> blocks;
};

/// The future plan.toml: the user's text, and what was added.
Result<PlanRules> rules_of(const OwnTables& tables) {
  PlanRules rules;
  const std::string text = tables.text + tables.added;
  const auto document = toml::parse(text, tables.file.string(), max_plan_bytes);
  if (!document) return document.problem();
  toml::Findings findings;
  toml::TableReader top(document->top, plan_schema(), {"plan"}, findings);
  rules.floor_m = top.number("floor_m");
  rules.ceiling_m = top.maybe_number("ceiling_m");
  for (const toml::Table* table : top.tables("layer")) {
    toml::TableReader keys(*table, plan_schema(), {"layer"}, findings);
    LayerRule rule;
    const std::string name = keys.text("name");
    rule.as = keys.choice("as");
    rule.height_m = keys.number("height_m");
    rule.thickness_m = keys.number("thickness_m");
    rule.material = keys.text("material");
    rules.layers[name] = rule;
  }
  for (const toml::Table* table : top.tables("block")) {
    toml::TableReader keys(*table, plan_schema(), {"block"}, findings);
    BlockRule rule;
    const std::string name = keys.text("name");
    rule.as = keys.choice("as");
    rule.type = keys.maybe_text("type").value_or(name);
    rule.height_m = keys.number("height_m");
    rules.blocks[name] = rule;
  }
  const Problems problems = findings.take_problems();
  if (!problems.empty()) return problems.list().front();
  return rules;
}

/// Number of occurrences of each name, in their order.
template <class Things, class Name>
std::map<std::string, size_t> counted(const Things& things, const Name& name) {
  std::map<std::string, size_t> out;
  for (const auto& thing : things) ++out[name(thing)];
  return out;
}

/// Replaces references by contents where the user's table says so.
Result<DxfPlan> with_opened_blocks(const DxfPlan& plan, const PlanRules& rules) {
  return with_contents_of(plan, [&rules](const std::string& block) {
    const auto rule = rules.blocks.find(block);
    return rule != rules.blocks.end() && rule->second.as == "contents";
  });
}

/// "1 line", "12 lines".
std::string several(size_t count, const char* one) {
  return fmt::format("{} {}{}", count, one, count == 1 ? "" : "s");
}

/// "; holds 31 lines, 2 blocks"; nothing for a block that holds neither.
std::string held_by(const DxfPlan& plan, const std::string& block) {
  const auto it = plan.blocks.find(block);
  if (it == plan.blocks.end()) return {};
  std::string out;
  if (!it->second.segments.empty()) out = several(it->second.segments.size(), "line");
  if (!it->second.inserts.empty())
    out += (out.empty() ? "" : ", ") + several(it->second.inserts.size(), "block");
  return out.empty() ? out : "; holds " + out;
}

void add_rules(const DxfPlan& plan, OwnTables& layers, const OwnTables& blocks) {
  for (const auto& [name, count] :
       counted(plan.segments, [](const DxfSegment& s) { return s.layer; }))
    if (!layers.has("layer", name))
      layers.added += fmt::format(
          "\n[[layer]]           # {}\nname = {}\nas = \"nothing\"      # wall, sheet\n"
          "height_m = 3\nthickness_m = 0.1\nmaterial = \"wall\"\n",
          several(count, "line"), toml_text(name));
  for (const auto& [name, count] :
       counted(plan.inserts, [](const DxfInsert& i) { return i.block; }))
    if (!blocks.has("block", name))
      layers.added += fmt::format(
          "\n[[block]]           # {}{}\nname = {}\n"
          "as = \"nothing\"      # luminaire, sign, contents\ntype = {}\nheight_m = 2.5\n",
          several(count, "time"), held_by(plan, name), toml_text(name), toml_text(name));
}

constexpr const char* plan_head =
    "# What the layers and blocks of the drawing become. This file is yours: an import adds what "
    "is\n"
    "# new at its end and changes nothing else. Say \"wall\" for lines along the middle of walls,\n"
    "# \"sheet\" for lines along their faces; then import again.\nfloor_m = 0\n# ceiling_m = 3\n";

constexpr const char* plan_materials =
    "# Yours. A plan knows no reflectances: state them.\n\n[[material]]\nname = \"wall\"\n"
    "reflectance = 0.6\n\n[[material]]\nname = \"floor\"\nreflectance = 0.3\n\n[[material]]\n"
    "name = \"ceiling\"\nreflectance = 0.8\n";

constexpr const char* plan_fixtures =
    "# Yours: the types that blocks of the plan stand for. One that is not here is not placed.\n\n"
    "# [[luminaire_type]]\n# name = \"LAMP\"\n# file = \"lamp.ldt\"\n\n# [[sign_type]]\n"
    "# name = \"EXIT\"\n# width = 0.3\n# height = 0.15\n# file = \"exit.svg\"\n"
    "# smallest_detail = \n# mains_white = \n# mains_green = \n# emergency_white = \n"
    "# emergency_green = \n";

double plan_rounded(double metres) {
  return std::round(metres * 1e4) / 1e4 + 0.0;
}

std::string at_text(const glm::dvec2& p, double z) {
  return fmt::format("[{:.12g}, {:.12g}, {:.12g}]", plan_rounded(p.x), plan_rounded(p.y),
                     plan_rounded(z));
}

std::string wall_text(const std::string& name, const LayerRule& rule, glm::dvec2 from,
                      glm::dvec2 to, double floor_m) {
  const std::string head = fmt::format("\n[[object]]\nname = {}\nmaterial = {}\n", toml_text(name),
                                       toml_text(rule.material));
  if (rule.as == "sheet")
    return head + fmt::format("shape = \"quad\"\ncorner = {}\nedge_u = {}\nedge_v = [0, 0, {:g}]\n",
                              at_text(from, floor_m), at_text(to - from, 0), rule.height_m);
  // A wall stands to the left of its direction; the line is its middle.
  const glm::dvec2 way = glm::normalize(to - from);
  const glm::dvec2 right = glm::dvec2(way.y, -way.x) * (rule.thickness_m / 2);
  return head +
         fmt::format("shape = \"wall\"\nfrom = {}\nto = {}\nheight = {:g}\nthickness = {:g}\n",
                     at_text(from + right, floor_m), at_text(to + right, floor_m), rule.height_m,
                     rule.thickness_m);
}

std::string level_text(const char* name, const Bounds& bounds, double z, bool up) {
  const glm::dvec2 low(bounds.low), high(bounds.high);
  const glm::dvec2 x(high.x - low.x, 0), y(0, high.y - low.y);
  return fmt::format(
      "\n[[object]]\nname = \"{0}\"\nmaterial = \"{0}\"\nshape = \"quad\"\n"
      "corner = {1}\nedge_u = {2}\nedge_v = {3}\n",
      name, at_text(low, z), at_text(up ? x : y, 0), at_text(up ? y : x, 0));
}

std::string placed_text(const std::string& name, const DxfInsert& insert, const BlockRule& rule,
                        const glm::dvec2& at, double floor_m) {
  const double turn = insert.rotation_deg * std::numbers::pi / 180;
  if (rule.as == "sign") {  // faces along the block's own y axis
    const double side = insert.mirrored ? -1 : 1;
    return fmt::format(
        "\n[[sign]]\nname = {}\ntype = {}\nposition = {}\nfacing = [{:.6f}, {:.6f}, 0]\n",
        toml_text(name), toml_text(rule.type), at_text(at, floor_m + rule.height_m),
        -side * std::sin(turn), side * std::cos(turn));
  }
  return fmt::format(
      "\n[[luminaire]]\nname = {}\ntype = {}\nposition = {}\nrotation_deg = {:.6g}\n",
      toml_text(name), toml_text(rule.type), at_text(at, floor_m + rule.height_m),
      insert.rotation_deg);
}

class PlanText {
 public:
  PlanText(const DxfPlan& plan, double metres_per_unit, const PlanRules& rules,
           const OwnTables& fixtures)
      : plan_(plan), unit_(metres_per_unit), rules_(rules), fixtures_(fixtures) {}

  std::string make() {
    std::string text = walls();
    for (const DxfInsert& i : plan_.inserts) {
      const BlockRule& rule = rules_.blocks.at(i.block);
      extent.extend(glm::dvec3(i.at * unit_, 0));
      if (rule.as == "contents") closed_.insert(i.block);
      if (rule.as == "nothing") note_blocks_within(i.block);
      if (rule.as == "nothing" || rule.as == "contents") continue;
      const std::string table = rule.as + "_type";
      if (!fixtures_.has(table, rule.type)) {
        missing_.insert("[[" + table + "]] \"" + rule.type + "\"");
        continue;
      }
      ++(rule.as == "sign" ? written.signs : written.luminaires);
      mirrored_ += i.mirrored && rule.as == "luminaire" ? 1 : 0;
      text += placed_text(numbered(i.block), i, rule, i.at * unit_, rules_.floor_m);
    }
    const Bounds& around = walls_.empty() ? extent : walls_;
    text += level_text("floor", around, rules_.floor_m, true);
    if (rules_.ceiling_m) text += level_text("ceiling", around, *rules_.ceiling_m, false);
    for (const std::string& type : missing_)
      written.asked.push_back("fixtures.toml has no " + type);
    for (const std::string& block : closed_)
      written.asked.push_back("the drawing holds no contents of the block \"" + block + "\"");
    if (mirrored_ > 0)
      written.notes.push_back(several(mirrored_, "luminaire") +
                              " of mirrored blocks: turned as their blocks are, with light that is "
                              "not mirrored");
    if (written.walls == 0) written.asked.push_back("plan.toml makes no layer a wall or a sheet");
    return text;
  }

  WrittenPlan written;
  Bounds extent;

 private:
  /// The lines of each layer that is to be walls.
  std::string walls() {
    std::map<std::string, std::vector<DrawnLine>> of_layer;
    for (const DxfSegment& s : plan_.segments) {
      const DrawnLine line{s.from * unit_, s.to * unit_};
      extent.extend(glm::dvec3(line.from, 0));
      extent.extend(glm::dvec3(line.to, 0));
      if (rules_.layers.at(s.layer).as != "nothing") of_layer[s.layer].push_back(line);
    }
    std::string text;
    for (const auto& [layer, lines] : of_layer) {
      const LayerRule& rule = rules_.layers.at(layer);
      const JoinedLines joined = join_short_lines(lines);
      for (const DrawnLine& line : joined.lines) {
        ++written.walls;
        walls_.extend(glm::dvec3(line.from, 0));
        walls_.extend(glm::dvec3(line.to, 0));
        text += wall_text(numbered(layer), rule, line.from, line.to, rules_.floor_m);
      }
      if (joined.dropped > 0)
        written.notes.push_back(
            fmt::format("{} of the layer \"{}\" left out: joined to those that they meet, they "
                        "span less than a millimetre",
                        several(joined.dropped, "line"), layer));
    }
    return text;
  }

  void note_blocks_within(const std::string& block) {
    const auto it = plan_.blocks.find(block);
    if (it == plan_.blocks.end() || it->second.inserts.empty() || !noted_.insert(block).second)
      return;
    written.notes.push_back(
        fmt::format("the block \"{}\" holds {}, which are not read: say as = \"contents\" in "
                    "plan.toml if they are luminaires or signs",
                    block, several(it->second.inserts.size(), "block")));
  }

  std::string numbered(const std::string& name) {
    return fmt::format("{} {}", name, ++numbers_[name]);
  }

  const DxfPlan& plan_;
  double unit_;
  const PlanRules& rules_;
  const OwnTables& fixtures_;
  Bounds walls_;
  size_t mirrored_ = 0;
  std::map<std::string, size_t> numbers_;
  std::set<std::string> missing_, closed_, noted_;
};

std::string plan_scene(const std::string& drawing, const PlanText& made, const PlanRules& rules) {
  std::string out = fmt::format(
      "title = {}\ninclude = [\"building.toml\"]\n\n# Yours: an import writes this file only where "
      "there is none.\n",
      toml_text(as_name(fs::path(drawing).stem().string(), "a plan")));
  if (made.written.luminaires + made.written.signs > 0) return out;
  const glm::dvec3 middle = (made.extent.low + made.extent.high) / 2.0;
  return out +
         "\n# A stand-in, so that there is light: take it out when there are luminaires.\n"
         "[[emitter]]\nname = \"stand-in\"\nshape = \"point\"\ndistribution = \"isotropic\"\n"
         "position = " +
         at_text(glm::dvec2(middle), rules.floor_m + 2) + "\nflux_lm = 1000\n";
}

}  // namespace

const toml::Schema& plan_schema() {
  static const toml::Schema schema{
      {{"plan",
        "Top of the file",
        {{"floor_m", "number", "m", "0", "[-1e5, 1e5]", "height of the floor"},
         {"ceiling_m", "number", "m", "", "[-1e5, 1e5]", "height of the ceiling; none: open above"},
         {"layer", "tables", "", "", "", "what lines become, by their layer"},
         {"block", "tables", "", "", "", "what blocks become, by their name"}}},
       {"layer",
        "`[[layer]]`: lines of a layer",
        {{"name", "text", "", "required", "", "name of the layer"},
         {"as", "choice", "", "\"nothing\"", "nothing, wall, sheet",
          "a solid wall about each line, or a sheet along it"},
         {"height_m", "number", "m", "3", "(0, 1000]", "height"},
         {"thickness_m", "number", "m", "0.1", "(0, 20]", "thickness of a wall"},
         {"material", "text", "", "\"wall\"", "", "material of the scene"}}},
       {"block",
        "`[[block]]`: a block that is placed",
        {{"name", "text", "", "required", "", "name of the block"},
         {"as", "choice", "", "\"nothing\"", "nothing, luminaire, sign, contents",
          "what it stands for; contents: its own lines and blocks"},
         {"type", "text", "", "", "",
          "`[[luminaire_type]]` or `[[sign_type]]` of the scene; the block's name unless said"},
         {"height_m", "number", "m", "2.5", "[-1000, 1000]", "above the floor"}}}}};
  return schema;
}

namespace {

/// Names that scenes accept for these names of a drawing; different ones stay different. In their
/// alphabetical order, so that a drawing whose lines are in another order gives the same names.
std::map<std::string, std::string> accepted_names(const std::set<std::string>& drawn,
                                                  const char* otherwise) {
  std::map<std::string, std::string> out;
  std::set<std::string> taken;
  for (const std::string& name : drawn) {
    const std::string wish = as_name(name, otherwise);
    std::string& accepted = out[name] = wish;
    for (int i = 2; !taken.insert(accepted).second; ++i) accepted = fmt::format("{}#{}", wish, i);
  }
  return out;
}

/// Calls `work` with the segments and the references of the plan, and of each of its blocks.
template <class Plan, class Work>
void for_each_part(Plan& plan, const Work& work) {
  work(plan.segments, plan.inserts);
  for (auto& [name, block] : plan.blocks) work(block.segments, block.inserts);
}

/// Renames layers and blocks to names that scenes accept.
DxfPlan named(DxfPlan plan) {
  std::set<std::string> layers, blocks;
  for_each_part(plan, [&](const auto& segments, const auto& inserts) {
    for (const DxfSegment& s : segments) layers.insert(s.layer);
    for (const DxfInsert& i : inserts) layers.insert(i.layer), blocks.insert(i.block);
  });
  for (const auto& [name, block] : plan.blocks) blocks.insert(name);
  for (const auto& [name, state] : plan.hidden_layers) layers.insert(name);
  const auto layer_names = accepted_names(layers, "0"),
             block_names = accepted_names(blocks, "block");
  for_each_part(plan, [&](auto& segments, auto& inserts) {
    for (DxfSegment& s : segments) s.layer = layer_names.at(s.layer);
    for (DxfInsert& i : inserts)
      i.layer = layer_names.at(i.layer), i.block = block_names.at(i.block);
  });
  std::map<std::string, DxfBlock> renamed;
  for (auto& [name, block] : plan.blocks) renamed[block_names.at(name)] = std::move(block);
  plan.blocks = std::move(renamed);
  std::map<std::string, const char*> hidden;
  for (const auto& [name, state] : plan.hidden_layers) hidden[layer_names.at(name)] = state;
  plan.hidden_layers = std::move(hidden);
  return plan;
}

}  // namespace

Result<WrittenPlan> write_plan(const DxfPlan& drawn, double metres_per_unit,
                               const std::string& drawing, const std::string& out) {
  const auto folder = import_folder(out);
  if (!folder) return folder.problem();
  const fs::path file = folder.value() / "plan.toml";
  auto tables = own_tables(file, {"layer"});
  if (!tables) return tables.problem();
  const auto blocks = own_tables(file, {"block"});
  if (!blocks) return blocks.problem();
  const auto fixtures =
      own_tables(folder.value() / "fixtures.toml", {"luminaire_type", "sign_type"});
  if (!fixtures) return fixtures.problem();
  const auto before = rules_of(tables.value());
  if (!before) return before.problem();
  const auto opened = with_opened_blocks(named(drawn), before.value());
  if (!opened) return problem_in(drawing, opened.problem().where.line, opened.problem());
  const DxfPlan& plan = opened.value();
  add_rules(plan, tables.value(), blocks.value());
  const auto rules = rules_of(tables.value());
  if (!rules) return rules.problem();
  PlanText made(plan, metres_per_unit, rules.value(), fixtures.value());
  const std::string text =
      fmt::format(
          "# The plan {}.\n# Made by `luxodus import dxf`, which writes this file anew: "
          "change plan.toml, fixtures.toml,\n# materials.toml and scene.toml instead.\n"
          "include = [\"materials.toml\", \"fixtures.toml\"]\n",
          as_name(fs::path(drawing).filename().string(), "of a drawing")) +
      made.make();
  const glm::dvec3 size = made.extent.high - made.extent.low;
  if (!(std::max(size.x, size.y) < largest_plan_m))
    return problem_in(drawing,
                      fmt::format("the plan is {:.3g} m large: is its unit right? Say it by "
                                  "--units",
                                  std::max(size.x, size.y)));
  if (auto ok = save(tables.value(), plan_head); !ok) return ok.problem();
  const std::pair<const char*, std::string> own[] = {{"materials.toml", plan_materials},
                                                     {"fixtures.toml", plan_fixtures}};
  for (const auto& [name, content] : own)
    if (const auto kept = write_unless_there(folder.value() / name, content); !kept)
      return kept.problem();
  if (auto ok = write_file_atomically(folder.value() / "building.toml", std::string_view(text));
      !ok)
    return ok.problem();
  const auto kept =
      write_unless_there(folder.value() / "scene.toml", plan_scene(drawing, made, rules.value()));
  if (!kept) return kept.problem();
  made.written.kept_scene = kept.value();
  made.written.lines = plan.segments.size();
  made.written.blocks = plan.inserts.size();
  made.written.notes.insert(made.written.notes.begin(), plan.notes.begin(), plan.notes.end());
  return made.written;
}

}  // namespace luxodus
