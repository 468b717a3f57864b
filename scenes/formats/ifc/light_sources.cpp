#include "scenes/formats/ifc/light_sources.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "scenes/formats/ifc/placements.hpp"

namespace luxodus {

namespace {

/// IfcCartesianTransformationOperator3D, in the model's unit.
Transform target_of(StepGraph& graph, const StepNode& node) {
  Transform out;
  out.offset = vector_of(graph.follow(node, 2), glm::dvec3(0));
  const double scale = node.number(3).value_or(1);
  const glm::dvec3 x =
      unit_vector(vector_of(graph.follow(node, 0), {1, 0, 0})).value_or(glm::dvec3(1, 0, 0));
  glm::dvec3 y = vector_of(graph.follow(node, 1), {0, 1, 0});
  y -= glm::dot(x, y) * x;
  y = unit_vector(y).value_or(glm::dvec3(0, 1, 0));
  out.linear = scale * glm::dmat3(x, y, glm::cross(x, y));
  return out;
}

/// Degrees of angles in the model's unit. Models in radians state four to seven digits of an angle,
/// so that 90 degrees become 90.0002: converted angles are rounded to 0.01 degrees.
double degrees_of(double angle, double radian) {
  const double degrees = radian * 180 / std::numbers::pi;
  if (std::abs(degrees - 1) < 1e-6) return angle;
  return std::round(angle * degrees * 100) / 100;
}

/// The unit of the angles [rad]. Many programs state the radian for the whole model and write these
/// angles in degrees: an angle beyond a full circle is in degrees.
double unit_of_angles(const std::vector<IfcLightPlane>& planes, double stated_radian,
                      bool& by_size) {
  double largest = 0;
  for (const IfcLightPlane& plane : planes) {
    largest = std::max(largest, plane.angle_deg);
    for (const double gamma : plane.gammas_deg) largest = std::max(largest, gamma);
  }
  constexpr double full_circle = 2 * std::numbers::pi, rounding = 1e-3, largest_deg = 360;
  by_size = stated_radian == 1 && largest > full_circle + rounding && largest <= largest_deg;
  return by_size ? std::numbers::pi / 180 : stated_radian;
}

void read_planes(StepGraph& graph, const StepNode& distribution, const IfcLightUnits& units,
                 IfcLightSource& light) {
  light.type = distribution.word(0);
  light.knows_angles = units.angle_radian.has_value();
  size_t intensities = 0;
  for (const uint64_t id : distribution.references(1)) {
    const StepNode data = graph.node(id);
    IfcLightPlane plane{data.number(0).value_or(0), data.numbers(1), data.numbers(2)};
    intensities += plane.intensities.size();
    if (intensities > limits::ifc_intensities) {
      light.planes.clear();
      return;
    }
    light.planes.push_back(std::move(plane));
  }
  const double radian =
      unit_of_angles(light.planes, units.angle_radian.value_or(1), light.degrees_by_size);
  for (IfcLightPlane& plane : light.planes) {
    plane.angle_deg = degrees_of(plane.angle_deg, radian);
    for (double& gamma : plane.gammas_deg) gamma = degrees_of(gamma, radian);
  }
  std::stable_sort(
      light.planes.begin(), light.planes.end(),
      [](const IfcLightPlane& a, const IfcLightPlane& b) { return a.angle_deg < b.angle_deg; });
}

/// `place`: of the item's coordinates, in metres.
std::optional<IfcLightSource> light_at(StepGraph& graph, const StepNode& node,
                                       const Transform& place, const IfcLightUnits& units) {
  IfcLightSource out;
  if (node.is("IFCLIGHTSOURCEGONIOMETRIC")) {
    out.kind = "goniometric";
    Transform own = axis_placement(graph, graph.follow(node, 4));
    own.offset *= units.metres;
    const Transform whole = place * own;
    out.position = whole.offset;
    out.axis = whole.linear[2];
    out.zero_plane = whole.linear[0];
    out.flux_lm = node.number(7);
    const StepNode data = graph.follow(node, 9);
    if (data.is("IFCLIGHTINTENSITYDISTRIBUTION"))
      read_planes(graph, data, units, out);
    else
      out.document = data.text(0).empty() ? data.text(2) : data.text(0);
  } else if (node.is("IFCLIGHTSOURCEPOSITIONAL") || node.is("IFCLIGHTSOURCESPOT")) {
    out.kind = node.is("IFCLIGHTSOURCESPOT") ? "spot" : "positional";
    out.position = place.point(units.metres * vector_of(graph.follow(node, 4), glm::dvec3(0)));
    if (node.is("IFCLIGHTSOURCESPOT"))
      out.axis = place.vector(vector_of(graph.follow(node, 9), {0, 0, -1}));
  } else if (node.is("IFCLIGHTSOURCEDIRECTIONAL")) {
    out.kind = "directional";
    out.position = place.offset;
    out.axis = place.vector(vector_of(graph.follow(node, 4), {0, 0, -1}));
  } else {
    return std::nullopt;
  }
  const auto axis = unit_vector(out.axis);
  out.axis = axis.value_or(glm::dvec3(0, 0, -1));
  return is_finite(out.position) ? std::optional(out) : std::nullopt;
}

/// Flux [lm] of intensities [cd] over planes and angles, by the trapezoidal rule.
double flux_of(const std::vector<IfcLightPlane>& planes) {
  const auto of_plane = [](const IfcLightPlane& plane) {
    double sum = 0;
    for (size_t i = 1; i < plane.gammas_deg.size(); ++i) {
      const double a = plane.gammas_deg[i - 1] * std::numbers::pi / 180,
                   b = plane.gammas_deg[i] * std::numbers::pi / 180;
      sum += (std::cos(a) - std::cos(b)) * (plane.intensities[i - 1] + plane.intensities[i]) / 2;
    }
    return sum;
  };
  if (planes.size() == 1) return 2 * std::numbers::pi * of_plane(planes.front());
  double sum = 0;
  for (size_t i = 1; i < planes.size(); ++i)
    sum += (planes[i].angle_deg - planes[i - 1].angle_deg) *
           (of_plane(planes[i - 1]) + of_plane(planes[i])) / 2;
  const double over = planes.back().angle_deg - planes.front().angle_deg;
  return over > 0 ? 2 * std::numbers::pi * sum / over : 0;
}

/// Closes a circle that ends one step before 360 degrees, and checks what IES files can say.
Result<std::vector<IfcLightPlane>> checked_planes(const IfcLightSource& light) {
  std::vector<IfcLightPlane> planes = light.planes;
  const std::vector<double>& gammas = planes.front().gammas_deg;
  for (const IfcLightPlane& plane : planes) {
    if (plane.gammas_deg != gammas || plane.intensities.size() != gammas.size())
      return problem("its planes have different angles, or not one intensity for each");
    for (const double i : plane.intensities)
      if (!(i >= 0)) return problem("an intensity is below 0");
  }
  const double largest = gammas.empty() ? 0 : *std::max_element(gammas.begin(), gammas.end());
  if (largest > 360)
    return problem(
        fmt::format("its angles are up to {:.5g} degrees by the unit of plane angles "
                    "that the model states: they seem to be in another",
                    largest));
  if (gammas.size() < 2 || gammas.front() != 0 || (gammas.back() != 90 && gammas.back() != 180) ||
      std::adjacent_find(gammas.begin(), gammas.end(), std::greater_equal<>()) != gammas.end())
    return problem("its angles do not rise from 0 to 90 or 180 degrees");
  double largest_step = 0;
  for (size_t i = 1; i < planes.size(); ++i) {
    const double step = planes[i].angle_deg - planes[i - 1].angle_deg;
    if (!(step > 0)) return problem("two of its planes have one angle");
    largest_step = std::max(largest_step, step);
  }
  if (planes.front().angle_deg != 0) return problem("its first plane is not C0");
  const double last = planes.back().angle_deg;
  constexpr double rounding = 1e-6;
  if (last > 180 && last < 360) {
    // The circle is periodic. A wider gap than between other planes is a part that is missing.
    if (360 - last > largest_step + rounding)
      return problem(
          fmt::format("its planes end at C{:g}, and no plane covers the rest of the "
                      "circle",
                      last));
    planes.push_back(planes.front());
    planes.back().angle_deg = 360;
  } else if (last != 0 && last != 90 && last != 180 && last != 360) {
    return problem(fmt::format("its planes end at C{:g}, not at 90, 180 or 360 degrees", last));
  }
  return planes;
}

}  // namespace

std::optional<IfcLightSource> ifc_light_of(StepGraph& graph, const StepNode& shape,
                                           const Transform& placement, const IfcLightUnits& units) {
  std::optional<IfcLightSource> found;
  size_t looked_at = 0;
  const auto look_at = [&](const StepNode& item, const Transform& place) {
    if (++looked_at > limits::ifc_light_sources) return;
    auto light = light_at(graph, item, place, units);
    if (!light) return;
    if (!found || (found->kind != "goniometric" && light->kind == "goniometric"))
      found = std::move(light);
  };
  for (const uint64_t id : shape.references(2))
    for (const uint64_t item_id : graph.node(id).references(3)) {
      const StepNode item = graph.node(item_id);
      if (!item.is("IFCMAPPEDITEM")) {
        look_at(item, placement);
        continue;
      }
      Transform target = target_of(graph, graph.follow(item, 1));
      target.offset *= units.metres;
      for (const uint64_t source : graph.follow(graph.follow(item, 0), 1).references(3))
        look_at(graph.node(source), placement * target);
    }
  return found;
}

Result<std::string> ies_text_of(const IfcLightSource& light, const std::string& name) {
  if (light.planes.empty()) return problem("it has no intensities");
  if (!light.flux_lm || !(*light.flux_lm > 0)) return problem("it states no luminous flux");
  if (!light.knows_angles) return problem("the model states no unit of plane angles that is known");
  if (light.type != "TYPE_C") return problem("its distribution is not of type C");
  auto planes = checked_planes(light);
  if (!planes) return planes.problem();
  // A source emits at most its flux, and hardly ever less than a hundredth of it.
  constexpr double most = 1.05, least = 0.005;
  const double share = flux_of(planes.value());
  const double per_lm = share / 1000 <= most && share / 1000 >= least ? 1e-3
                        : share <= most && share >= least             ? 1
                                                                      : 0;
  if (per_lm == 0)
    return problem(
        fmt::format("its intensities add up to {:.4g} lm for each lumen as cd/lm, and to "
                    "{:.4g} as cd/klm: neither can be",
                    share, share / 1000));
  const auto& gammas = planes->front().gammas_deg;
  std::string text = fmt::format(
      "IESNA:LM-63-2002\n[TEST] none\n[MANUFAC] IFC model\n[LUMINAIRE] {}\nTILT=NONE\n"
      "1 -1 1 {} {} 1 2 0 0 0\n1 1 0\n",
      name.substr(0, 60), gammas.size(), planes->size());
  const auto write = [&](const auto& numbers, double factor) {
    for (size_t i = 0; i < numbers.size(); ++i)
      text += fmt::format("{:.8g}{}", factor * numbers[i],
                          i + 1 == numbers.size() || i % 10 == 9 ? '\n' : ' ');
  };
  write(gammas, 1);
  std::vector<double> angles;
  for (const IfcLightPlane& plane : planes.value()) angles.push_back(plane.angle_deg);
  write(angles, 1);
  for (const IfcLightPlane& plane : planes.value())
    write(plane.intensities, per_lm * *light.flux_lm);
  return text;
}

}  // namespace luxodus
