#include "scenes/formats/ifc/shape_input.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <set>

#include "runtime/core/printable.hpp"
#include "scenes/formats/ifc/near_points.hpp"
#include "scenes/formats/ifc/placements.hpp"
#include "scenes/formats/ifc/profiles.hpp"
#include "scenes/formats/ifc/representations.hpp"
#include "scenes/formats/ifc/step_draft.hpp"
#include "scenes/formats/ifc/step_solids.hpp"

namespace luxodus {

namespace {

/// Items of which the library makes no shape, and which have none here either.
constexpr std::array<std::string_view, 5> shapeless{
    "IFCREVOLVEDAREASOLIDTAPERED", "IFCSECTIONEDSPINE", "IFCSECTIONEDSOLIDHORIZONTAL",
    "IFCSECTIONEDSURFACE", "IFCINCLINEDREFERENCESWEPTAREASOLID"};

class ShapeInput {
 public:
  ShapeInput(const StepFile& file, const IfcModel& model)
      : graph_(file), draft_(file), model_(model) {}

  Result<IfcShapeInput> make() {
    for (const StepFile::Instance& instance : graph_.file().instances())
      grids_.add(instance.type == "IFCGRID" ? graph_.node(instance) : StepNode());
    for (const StepFile::Instance& instance : graph_.file().instances()) rewrite(instance);
    std::set<uint64_t> shapes;
    for (const IfcProduct& product : model_.products) {
      const StepNode shape = graph_.follow(graph_.node(product.id), 6);
      if (shape && shapes.insert(shape.id()).second) keep_body(shape);
      tell_shapeless(product, shape);
    }
    if (fillets_ > 0)
      note(fmt::format("{} swept discs have rounded corners, which are left sharp", fillets_));
    if (draft_.is_full())
      note("some items are too large to be rewritten for the library, and have no shape");
    auto file = StepFile::of(draft_.text(), model_.file);
    if (!file) return file.problem();
    const NearPointsText near = with_near_points(file.value(), model_);
    if (near.file) {
      file = StepFile::of(*near.file, model_.file);
      if (!file) return file.problem();
    }
    if (near.left_far > 0)
      note(
          fmt::format("{} shapes far from the origin of their product are too large to be moved "
                      "near it, and are rounded",
                      near.left_far));
    return IfcShapeInput{std::move(file).value(), std::move(notes_)};
  }

 private:
  void note(std::string words) {
    if (notes_.size() < limits::ifc_shape_notes) notes_.push_back(std::move(words));
  }

  void rewrite(const StepFile::Instance& instance) {
    using Way = void (ShapeInput::*)(const StepNode&);
    static const std::map<std::string_view, Way> ways{
        {"IFCTRIANGULATEDFACESET", &ShapeInput::resolve_indices},
        {"IFCTRIANGULATEDIRREGULARNETWORK", &ShapeInput::resolve_indices},
        {"IFCPOLYGONALFACESET", &ShapeInput::resolve_indices},
        {"IFCTRAPEZIUMPROFILEDEF", &ShapeInput::outline_profile},
        {"IFCELLIPSEPROFILEDEF", &ShapeInput::outline_profile},
        {"IFCCENTERLINEPROFILEDEF", &ShapeInput::outline_profile},
        {"IFCRIGHTCIRCULARCYLINDER", &ShapeInput::extrude_cylinder},
        {"IFCRIGHTCIRCULARCONE", &ShapeInput::facet},
        {"IFCRECTANGULARPYRAMID", &ShapeInput::facet},
        {"IFCCSGSOLID", &ShapeInput::unwrap},
        {"IFCFACETEDBREPWITHVOIDS", &ShapeInput::join_shells},
        {"IFCADVANCEDBREPWITHVOIDS", &ShapeInput::join_shells},
        {"IFCSWEPTDISKSOLIDPOLYGONAL", &ShapeInput::sharpen_disc},
        {"IFCGRIDPLACEMENT", &ShapeInput::place_locally}};
    if (const auto way = ways.find(instance.type); way != ways.end())
      (this->*way->second)(graph_.node(instance));
  }

  /// Face sets whose indices lead to points over PnIndex: the points in the order of PnIndex.
  void resolve_indices(const StepNode& node) {
    const size_t place = node.is("IFCPOLYGONALFACESET") ? 3 : 4;
    const std::vector<double> index = node.numbers(place);
    const StepNode list = graph_.follow(node, 0);
    const auto& rows = list.at(0).items;
    if (index.empty() || !list.is("IFCCARTESIANPOINTLIST3D")) return;
    const auto texts = split_parameters(list_content(draft_.parameters(list.id())));
    std::string points;
    for (const double i : index) {
      if (!(i >= 1 && i <= static_cast<double>(std::min(rows.size(), texts.size())))) {
        note(fmt::format("#{} ({}) has an index of no point, and was left out", node.id(),
                         node.type()));
        draft_.replace(node.id(), "IFCPOINT", "");
        return;
      }
      points += (points.empty() ? "" : ",") + std::string(texts[static_cast<size_t>(i) - 1]);
    }
    auto words = draft_.copied_parameters(node.id());
    if (words.size() <= place) return;
    words[0] = fmt::format("#{}", draft_.add("IFCCARTESIANPOINTLIST3D", "(" + points + ")"));
    words[place] = "$";
    draft_.replace(node.id(), std::string(node.type()), joined_parameters(words));
  }

  static std::string_view list_content(const std::vector<std::string_view>& parameters) {
    if (parameters.empty() || parameters[0].size() < 2) return {};
    return parameters[0].substr(1, parameters[0].size() - 2);
  }

  void outline_profile(const StepNode& node) {
    const auto profile = ifc_profile(graph_, node);
    if (!profile) return note(fmt::format("#{} ({}) gives no outline", node.id(), node.type()));
    std::string points;
    Outline closed = profile->outline;
    closed.push_back(closed.front());
    for (const glm::dvec2& p : closed)
      points += fmt::format("{}#{}", points.empty() ? "" : ",",
                            draft_.add("IFCCARTESIANPOINT", step_point({p, 0}, 2)));
    const auto words = draft_.copied_parameters(node.id());
    if (words.size() < 2) return;
    draft_.replace(node.id(), "IFCARBITRARYCLOSEDPROFILEDEF",
                   fmt::format("{},{},#{}", words[0], words[1],
                               draft_.add("IFCPOLYLINE", "(" + points + ")")));
  }

  /// A CSG solid of one primitive that is rewritten: the primitive itself, since the library knows
  /// only its own ones within.
  void unwrap(const StepNode& node) {
    const StepNode root = graph_.follow(node, 0);
    if (!root.is("IFCRIGHTCIRCULARCYLINDER") && !root.is("IFCRIGHTCIRCULARCONE") &&
        !root.is("IFCRECTANGULARPYRAMID"))
      return;
    const auto mesh = step_solid(graph_, root);
    if (mesh) draft_.replace(node.id(), "IFCFACETEDBREP", brep_body(draft_, *mesh));
  }

  void extrude_cylinder(const StepNode& node) {
    const auto words = draft_.copied_parameters(node.id());
    if (words.size() < 3) return;
    const uint64_t origin = draft_.add("IFCCARTESIANPOINT", "(0.,0.)");
    const uint64_t axes = draft_.add("IFCAXIS2PLACEMENT2D", fmt::format("#{},$", origin));
    const uint64_t circle =
        draft_.add("IFCCIRCLEPROFILEDEF", fmt::format(".AREA.,$,#{},{}", axes, words[2]));
    const uint64_t up = draft_.add("IFCDIRECTION", "(0.,0.,1.)");
    draft_.replace(node.id(), "IFCEXTRUDEDAREASOLID",
                   fmt::format("#{},{},#{},{}", circle, words[0], up, words[1]));
  }

  void facet(const StepNode& node) {
    const auto mesh = step_solid(graph_, node);
    if (!mesh) return note(fmt::format("#{} ({}) has no shape", node.id(), node.type()));
    draft_.replace(node.id(), "IFCFACETEDBREP", brep_body(draft_, *mesh));
  }

  /// One shell of the faces of all: the cavities are closed surfaces within it.
  void join_shells(const StepNode& node) {
    std::string faces;
    std::vector<uint64_t> shells = node.references(1);
    shells.insert(shells.begin(), node.reference(0));
    for (const uint64_t shell : shells) {
      const std::string_view own = list_content(draft_.parameters(shell));
      if (!own.empty()) faces += (faces.empty() ? "" : ",") + std::string(own);
    }
    const uint64_t shell = draft_.add("IFCCLOSEDSHELL", "(" + faces + ")");
    draft_.replace(node.id(),
                   node.is("IFCFACETEDBREPWITHVOIDS") ? "IFCFACETEDBREP" : "IFCADVANCEDBREP",
                   fmt::format("#{}", shell));
  }

  void sharpen_disc(const StepNode& node) {
    auto words = draft_.copied_parameters(node.id());
    if (node.number(5).value_or(0) > 0) ++fillets_;
    words.resize(std::min<size_t>(words.size(), 5));
    draft_.replace(node.id(), "IFCSWEPTDISKSOLID", joined_parameters(words));
  }

  void place_locally(const StepNode& node) {
    const auto place = grids_.placement(graph_, node);
    if (!place) return;  // a fault of the model, which its products report
    const uint64_t at = draft_.add("IFCCARTESIANPOINT", step_point(place->local.offset, 3));
    const uint64_t z = draft_.add("IFCDIRECTION", "(0.,0.,1.)");
    const uint64_t x = draft_.add("IFCDIRECTION", step_point(place->local.linear[0], 3));
    const uint64_t axes = draft_.add("IFCAXIS2PLACEMENT3D", fmt::format("#{},#{},#{}", at, z, x));
    const std::string above = place->grid == 0 ? "$" : fmt::format("#{}", place->grid);
    draft_.replace(node.id(), "IFCLOCALPLACEMENT", fmt::format("{},#{}", above, axes));
  }

  void keep_body(const StepNode& shape) {
    const IfcBody body = ifc_body(graph_, shape);
    if (body.others.empty() && shape.is("IFCPRODUCTDEFINITIONSHAPE")) return;
    std::string list;
    for (const uint64_t id : body.representations)
      list += fmt::format("{}#{}", list.empty() ? "" : ",", id);
    draft_.replace(shape.id(), "IFCPRODUCTDEFINITIONSHAPE", "$,$,(" + list + ")");
  }

  void tell_shapeless(const IfcProduct& product, const StepNode& shape) {
    std::set<std::string_view> types;
    for (const uint64_t id : ifc_body(graph_, shape).representations)
      for (const uint64_t item : graph_.node(id).references(3)) {
        const StepNode node = graph_.node(item);
        if (std::find(shapeless.begin(), shapeless.end(), node.type()) != shapeless.end())
          types.insert(node.type());
      }
    for (const std::string_view type : types)
      note(fmt::format("#{} (\"{}\", {}) has an {}, of which no shape is made", product.id,
                       excerpt(product.name, 60), excerpt(product.guid, 30), type));
  }

  StepGraph graph_;
  StepDraft draft_;
  const IfcModel& model_;
  IfcGrids grids_;
  size_t fillets_ = 0;
  std::vector<std::string> notes_;
};

}  // namespace

Result<IfcShapeInput> ifc_shape_input(const StepFile& file, const IfcModel& model) {
  return ShapeInput(file, model).make();
}

}  // namespace luxodus
