// A shape is copied, each point of its own space moved. What is placed within it (the profile of a
// sweep, the outline of a bounded half space) has a space of its own, which the placement moves.
#include "scenes/formats/ifc/near_points.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <map>

#include "scenes/formats/ifc/placements.hpp"
#include "scenes/formats/ifc/shape_input.hpp"
#include "scenes/formats/ifc/step_draft.hpp"
#include "scenes/formats/ifc/step_solids.hpp"

namespace luxodus {

namespace {

/// Depth of an instance below an item: the schema needs about ten.
constexpr int max_depth = 24;

/// A sweep: a profile, and the placement of its plane.
bool is_swept(const StepNode& node) {
  return node.type().find("SWEPTAREASOLID") != std::string_view::npos ||
         node.is("IFCEXTRUDEDAREASOLID") || node.is("IFCEXTRUDEDAREASOLIDTAPERED") ||
         node.is("IFCREVOLVEDAREASOLID") || node.is("IFCREVOLVEDAREASOLIDTAPERED") ||
         node.is("IFCSURFACEOFLINEAREXTRUSION") || node.is("IFCSURFACEOFREVOLUTION");
}

class NearPoints {
 public:
  NearPoints(const StepFile& file, double far) : graph_(file), draft_(file), far_(far) {}

  /// Moves the shape of a product if it is far.
  void move(uint64_t id) {
    const StepNode product = graph_.node(id), shape = graph_.follow(product, 6);
    std::optional<glm::dvec3> by;
    for (const uint64_t representation : shape.references(2))
      for (const uint64_t item : graph_.node(representation).references(3))
        if (!by) by = far_point(graph_.node(item));
    if (!by) return;
    std::string representations;
    for (const uint64_t representation : shape.references(2)) {
      auto words = draft_.copied_parameters(representation);
      if (words.size() < 4) return;
      words[3] = moved_text(words[3], *by, 0);
      representations += fmt::format(
          "{}#{}", representations.empty() ? "" : ",",
          draft_.add(std::string(graph_.node(representation).type()), joined_parameters(words)));
    }
    auto words = draft_.copied_parameters(id);
    if (words.size() < 7) return;
    const std::string above = words[5];
    words[5] = fmt::format(
        "#{}", draft_.add("IFCLOCALPLACEMENT", fmt::format("{},#{}", above, placement_at(*by))));
    words[6] = fmt::format(
        "#{}", draft_.add("IFCPRODUCTDEFINITIONSHAPE", fmt::format("$,$,({})", representations)));
    draft_.replace(id, std::string(product.type()), joined_parameters(words));
    ++moved_;
  }

  /// Copies of items look like their originals.
  void copy_styles() {
    std::multimap<uint64_t, uint64_t> copies;
    for (const auto& [key, copy] : copies_)
      if (copy != key.first) copies.emplace(key.first, copy);
    for (const StepFile::Instance& instance : graph_.file().instances()) {
      if (instance.type != "IFCSTYLEDITEM") continue;
      auto words = draft_.copied_parameters(instance.id);
      const auto [from, to] = copies.equal_range(graph_.node(instance).reference(0));
      for (auto at = from; at != to; ++at) {
        words[0] = fmt::format("#{}", at->second);
        draft_.add("IFCSTYLEDITEM", joined_parameters(words));
      }
    }
  }

  size_t moved_shapes() const { return moved_; }
  const StepDraft& draft() const { return draft_; }

 private:
  /// A point of an item, rounded, if it is far from the origin.
  std::optional<glm::dvec3> far_point(const StepNode& node) {
    const auto point = point_of(node, 0);
    if (!point || !is_finite(*point) || !is_far(*point)) return std::nullopt;
    return glm::round(*point);
  }

  /// The first point of a shape, in the space of the node that refers to it. Remembered, since
  /// nodes may form a graph with exponentially many ways through it; that there is none is known
  /// only as deep as was searched.
  std::optional<glm::dvec3> point_of(const StepNode& node, int depth) {
    if (!node || depth > max_depth) return std::nullopt;
    const auto [known, fresh] = first_points_.try_emplace(node.id());
    FirstPoint& first = known->second;
    if (!fresh && (first.point || depth >= first.depth)) return first.point;
    first.depth = depth;
    first.point = found_point(node, depth);
    return first.point;
  }

  std::optional<glm::dvec3> found_point(const StepNode& node, int depth) {
    if (node.is("IFCCARTESIANPOINT")) return vector_of(node, glm::dvec3(0));
    if (node.type().starts_with("IFCCARTESIANPOINTLIST")) {
      const auto& rows = node.at(0).items;
      if (rows.empty() || rows[0].items.size() < 2) return std::nullopt;
      const auto& row = rows[0].items;
      return glm::dvec3(row[0].number, row[1].number, row.size() > 2 ? row[2].number : 0);
    }
    if (is_swept(node)) {
      const Transform place = axis_placement(graph_, graph_.follow(node, 1));
      return place.point(point_of(graph_.follow(node, 0), depth + 1).value_or(glm::dvec3(0)));
    }
    if (node.is("IFCMAPPEDITEM")) {
      const glm::dvec3 at = vector_of(graph_.follow(graph_.follow(node, 1), 2), glm::dvec3(0));
      const auto source = source_point(node, depth);
      return source ? at + *source : at;
    }
    for (size_t place = 0; place < node.size(); ++place)
      for (const uint64_t id : node.references(place))
        if (const auto point = point_of(graph_.node(id), depth + 1)) return point;
    return std::nullopt;
  }

  /// A point of what a mapped item maps.
  std::optional<glm::dvec3> source_point(const StepNode& node, int depth) {
    for (const uint64_t id : graph_.follow(graph_.follow(node, 0), 1).references(3))
      if (const auto point = point_of(graph_.node(id), depth + 1)) return point;
    return std::nullopt;
  }

  uint64_t placement_at(const glm::dvec3& p) {
    const uint64_t point = draft_.add("IFCCARTESIANPOINT", step_point(p, 3));
    return draft_.add("IFCAXIS2PLACEMENT3D", fmt::format("#{},$,$", point));
  }

  /// A copy whose points are moved by -`by`; the instance itself if it has none.
  uint64_t moved(uint64_t id, const glm::dvec3& by, int depth) {
    const StepNode node = graph_.node(id);
    if (!node || depth > max_depth || draft_.is_full()) return id;
    const auto key = std::pair(id, std::array<double, 3>{by.x, by.y, by.z});
    if (const auto known = copies_.find(key); known != copies_.end()) return known->second;
    copies_[key] = id;
    const std::string body = moved_body(node, by, depth);
    if (body == draft_.body(id)) return id;
    const uint64_t copy = draft_.add(std::string(node.type()), body);
    copies_[key] = copy;
    return copy;
  }

  std::string moved_body(const StepNode& node, const glm::dvec3& by, int depth) {
    auto words = draft_.copied_parameters(node.id());
    if (words.empty()) return std::string(draft_.body(node.id()));
    if (node.is("IFCCARTESIANPOINT")) {
      words[0] = moved_row(node.at(0), by);
    } else if (node.type().starts_with("IFCCARTESIANPOINTLIST")) {
      std::string rows;
      for (const StepValue& row : node.at(0).items)
        rows += (rows.empty() ? "" : ",") + moved_row(row, by);
      words[0] = "(" + rows + ")";
    } else if (is_swept(node) && words.size() > 1) {
      move_swept(node, by, depth, words);
    } else if (node.is("IFCPOLYGONALBOUNDEDHALFSPACE") && words.size() > 2) {
      words[0] = moved_text(words[0], by, depth + 1);
      words[2] = moved_text(words[2], by, depth + 1);
    } else if (node.is("IFCMAPPEDITEM") && words.size() > 1) {
      move_mapped(node, by, depth, words);
    } else {
      for (std::string& word : words) word = moved_text(word, by, depth + 1);
    }
    return joined_parameters(words);
  }

  static std::string moved_row(const StepValue& row, const glm::dvec3& by) {
    std::string out;
    for (size_t i = 0; i < row.items.size(); ++i)
      out += (i > 0 ? "," : "") +
             step_number(row.items[i].number - (i < 3 ? by[static_cast<glm::length_t>(i)] : 0));
    return "(" + out + ")";
  }

  /// The placement of a sweep moves it; a far profile is moved, too, and the placement back.
  void move_swept(const StepNode& node, const glm::dvec3& by, int depth,
                  std::vector<std::string>& words) {
    const StepNode axis = graph_.follow(node, 1);
    Transform place = axis_placement(graph_, axis);
    const auto profile = far_point(graph_.follow(node, 0));
    // The axis of a revolution lies in the space of the profile.
    if (profile &&
        (node.type().starts_with("IFCEXTRUDED") || node.is("IFCSURFACEOFLINEAREXTRUSION"))) {
      words[0] = fmt::format("#{}", moved(node.reference(0), *profile, depth + 1));
      if (node.is("IFCEXTRUDEDAREASOLIDTAPERED") && words.size() > 4)
        words[4] = fmt::format("#{}", moved(node.reference(4), *profile, depth + 1));
      place.offset += place.linear * *profile;
    }
    const glm::dvec3 at = place.offset - by;
    const uint64_t point = draft_.add("IFCCARTESIANPOINT", step_point(at, 3));
    auto own = axis ? draft_.copied_parameters(axis.id()) : std::vector<std::string>{"", "$", "$"};
    if (own.empty()) return;
    own[0] = fmt::format("#{}", point);
    words[1] = fmt::format("#{}", draft_.add("IFCAXIS2PLACEMENT3D", joined_parameters(own)));
  }

  /// The target of a mapped item moves it; a far source is moved, too, and the target back.
  void move_mapped(const StepNode& node, const glm::dvec3& by, int depth,
                   std::vector<std::string>& words) {
    const StepNode map = graph_.follow(node, 0), target = graph_.follow(node, 1);
    if (!target) return;
    glm::dvec3 at = vector_of(graph_.follow(target, 2), glm::dvec3(0)) - by;
    const Transform origin = axis_placement(graph_, graph_.follow(map, 0));
    const bool plain = origin.offset == glm::dvec3(0) && origin.linear == glm::dmat3(1);
    std::optional<glm::dvec3> source = source_point(node, depth);
    if (source && plain && is_far(*source) && !target.reference(0) && !target.reference(1) &&
        target.number(3).value_or(1) == 1) {
      const glm::dvec3 shift = glm::round(*source);
      auto representation = draft_.copied_parameters(map.reference(1));
      auto own = draft_.copied_parameters(map.id());
      if (representation.size() > 3 && own.size() > 1) {
        representation[3] = moved_text(representation[3], shift, depth + 1);
        own[1] = fmt::format(
            "#{}", draft_.add("IFCSHAPEREPRESENTATION", joined_parameters(representation)));
        words[0] = fmt::format("#{}", draft_.add("IFCREPRESENTATIONMAP", joined_parameters(own)));
        at += shift;
      }
    }
    auto own = draft_.copied_parameters(target.id());
    if (own.size() < 3) return;
    own[2] = fmt::format("#{}", draft_.add("IFCCARTESIANPOINT", step_point(at, 3)));
    words[1] = fmt::format("#{}", draft_.add(std::string(target.type()), joined_parameters(own)));
  }

  bool is_far(const glm::dvec3& p) const {
    return std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}) >= far_;
  }

  /// A text of parameters, with moved copies of what it refers to.
  std::string moved_text(std::string_view text, const glm::dvec3& by, int depth) {
    std::string out;
    for (size_t at = 0; at < text.size();) {
      if (text[at] == '\'') {
        const size_t end = std::min(text.find('\'', at + 1), text.size() - 1);
        out += text.substr(at, end + 1 - at);
        at = end + 1;
        continue;
      }
      out += text[at++];
      if (out.back() != '#') continue;
      uint64_t id = 0;
      size_t end = at;
      while (end < text.size() && text[end] >= '0' && text[end] <= '9' && end - at < 18)
        id = 10 * id + static_cast<uint64_t>(text[end++] - '0');
      out += fmt::format("{}", end > at ? moved(id, by, depth) : 0);
      at = end;
    }
    return out;
  }

  struct FirstPoint {
    int depth = 0;  // of the search that found it, or nothing
    std::optional<glm::dvec3> point;
  };

  StepGraph graph_;
  StepDraft draft_;
  double far_;
  size_t moved_ = 0;
  std::map<uint64_t, FirstPoint> first_points_;  // by instance
  std::map<std::pair<uint64_t, std::array<double, 3>>, uint64_t> copies_;
};

}  // namespace

NearPointsText with_near_points(const StepFile& file, const IfcModel& model) {
  NearPoints near(file, limits::ifc_far_m / model.metres_per_unit);
  for (const IfcProduct& product : model.products)
    if (product.has_shape) near.move(product.id);
  near.copy_styles();
  if (near.draft().is_full()) return {std::nullopt, near.moved_shapes()};
  if (near.moved_shapes() == 0) return {};
  return {near.draft().text(), 0};
}

}  // namespace luxodus
