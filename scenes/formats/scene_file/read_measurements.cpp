// Reads planes, probes, groups, observers and cameras.
#include <algorithm>
#include <cmath>

#include "scenes/formats/scene_file/scene_readers.hpp"

namespace luxodus {

namespace {

/// Cells of one plane: 4096 x 4096 tallies are 400 MB; more is probably a wrong cell size.
constexpr int64_t max_plane_cells = int64_t{1} << 24;

/// More cells cause a warning: a hall of 250 x 250 m in cells of half a metre has this many.
constexpr int64_t many_plane_cells = 250000;

/// Reports a problem unless two edges span an area.
void check_span(KeyReader& keys, const glm::dvec3& u, const glm::dvec3& v) {
  if (!keys.clean()) return;
  const double area = glm::length(glm::cross(u, v));
  if (!(area > 1e-9 * glm::length(u) * glm::length(v)) || area < 1e-12) {
    keys.problem("edge_u", "'edge_u' and 'edge_v' span no area");
  }
}

int cells_along(double length, double cell_m) {
  // Tolerates a relative 1e-9, so that 0.9 m in cells of 0.3 m is 3 and not 4.
  return static_cast<int>(std::min(1e6, std::max(1.0, std::ceil(length / cell_m * (1 - 1e-9)))));
}

}  // namespace

void read_plane(const toml::Table& table, SceneReading& reading) {
  KeyReader keys(table, {"plane"}, reading);
  PlaneMeasure p;
  p.name = read_name(keys, "plane");
  p.place = keys.place();
  p.corner = keys.point("corner");
  p.edge_u = keys.point("edge_u");
  p.edge_v = keys.point("edge_v");
  check_span(keys, p.edge_u, p.edge_v);
  const std::string given = keys.exactly_one({"cells", "cell_m"}, true);
  if (given == "cells") {
    const glm::dvec2 cells = keys.pair("cells");
    if (keys.clean() && cells != glm::floor(cells)) {
      keys.problem("cells", "'cells' must be two whole numbers");
    }
    p.cells_u = static_cast<int>(cells.x);
    p.cells_v = static_cast<int>(cells.y);
  } else if (given == "cell_m") {
    const double cell = keys.number("cell_m");
    p.cells_u = cells_along(glm::length(p.edge_u), cell);
    p.cells_v = cells_along(glm::length(p.edge_v), cell);
    const double longer = std::max(glm::length(p.edge_u), glm::length(p.edge_v));
    if (keys.clean() && cell > longer)
      keys.reading().warning(keys.place("cell_m"),
                             "plane '" + p.name +
                                 "' is smaller than one cell of 'cell_m', and has one value: no "
                                 "minimum, no uniformity; make the cells smaller");
    if (keys.clean() && int64_t{p.cells_u} * p.cells_v > many_plane_cells)
      keys.reading().warning(
          keys.place("cell_m"),
          "plane '" + p.name + "' has " + std::to_string(p.cells_u) + " x " +
              std::to_string(p.cells_v) +
              " cells, each of which few particles meet; is 'cell_m' in metres?");
  }
  if (keys.clean() && int64_t{p.cells_u} * p.cells_v > max_plane_cells) {
    keys.problem(given, "this plane would have " + std::to_string(p.cells_u) + " x " +
                            std::to_string(p.cells_v) + " cells; at most " +
                            std::to_string(max_plane_cells) + " are allowed");
  }
  reading.scene.planes.push_back(std::move(p));
}

void read_probe(const toml::Table& table, SceneReading& reading) {
  KeyReader keys(table, {"probe"}, reading);
  ProbeMeasure p;
  p.name = read_name(keys, "probe");
  p.place = keys.place();
  p.position = keys.point("position");
  p.normal = keys.direction("normal");
  reading.scene.probes.push_back(std::move(p));
}

void read_surface_group(const toml::Table& table, SceneReading& reading) {
  KeyReader keys(table, {"surface_group"}, reading);
  SurfaceGroupMeasure g;
  g.name = read_name(keys, "surface_group");
  g.place = keys.place();
  g.objects = keys.texts("objects");
  if (keys.clean() && g.objects.empty()) keys.problem("objects", "'objects' names nothing");
  for (const std::string& name : g.objects) {
    reading.require("object or tag", name, keys.place("objects"));
  }
  reading.scene.surface_groups.push_back(std::move(g));
}

void read_volume_group(const toml::Table& table, SceneReading& reading) {
  using VolumeShape = VolumeGroupMeasure::Shape;
  VolumeGroupMeasure g;
  std::string shape;
  KeyReader keys = kind_reader(table, "volume_group", "shape", reading, shape);
  g.name = read_name(keys, "volume_group");
  g.place = keys.place();
  if (shape.empty()) {
    reading.scene.volume_groups.push_back(std::move(g));
    return;
  }
  if (shape == "box") {
    g.shape = VolumeShape::box;
    g.low = keys.point("low");
    g.high = keys.point("high");
    if (keys.clean() && !glm::all(glm::lessThan(g.low, g.high))) {
      keys.problem("high", "'high' must lie above 'low' in x, y and z");
    }
  } else if (shape == "layer") {
    g.shape = VolumeShape::layer;
    g.low.z = keys.number("z_low");
    g.high.z = keys.number("z_high");
    if (keys.clean() && !(g.low.z < g.high.z)) {
      keys.problem("z_high", "'z_high' must lie above 'z_low'");
    }
  } else {
    g.shape = shape == "sphere" ? VolumeShape::sphere : VolumeShape::shell;
    g.centre = keys.point("centre");
    g.radius = keys.number("radius");
    if (shape == "shell") {
      g.inner_radius = keys.number("inner_radius");
      if (keys.clean() && !(g.inner_radius < g.radius)) {
        keys.problem("inner_radius", "'inner_radius' must be less than 'radius'");
      }
    }
  }
  reading.scene.volume_groups.push_back(std::move(g));
}

void read_counting_plane(const toml::Table& table, SceneReading& reading) {
  KeyReader keys(table, {"counting_plane"}, reading);
  CountingPlaneMeasure p;
  p.name = read_name(keys, "counting_plane");
  p.place = keys.place();
  p.corner = keys.point("corner");
  p.edge_u = keys.point("edge_u");
  p.edge_v = keys.point("edge_v");
  check_span(keys, p.edge_u, p.edge_v);
  reading.scene.counting_planes.push_back(std::move(p));
}

void read_observer(const toml::Table& table, SceneReading& reading) {
  KeyReader keys(table, {"observer"}, reading);
  Observer o;
  o.name = read_name(keys, "observer");
  o.place = keys.place();
  o.eye = keys.point("eye");
  const std::string given = keys.exactly_one({"gaze", "target"}, true);
  if (given == "gaze") o.gaze = keys.direction("gaze");
  if (given == "target") {
    const glm::dvec3 way = keys.maybe_point("target").value_or(o.eye + o.gaze) - o.eye;
    if (glm::length(way) < 1e-6) {
      keys.problem("target", "'target' must not be where the eye is");
    } else {
      o.gaze = glm::normalize(way);
    }
  }
  reading.scene.observers.push_back(std::move(o));
}

void read_camera(const toml::Table& table, SceneReading& reading) {
  KeyReader keys(table, {"camera"}, reading);
  Camera c;
  c.name = read_name(keys, "camera");
  c.place = keys.place();
  c.eye = keys.point("eye");
  c.target = keys.point("target");
  c.up = keys.direction("up");
  c.vertical_fov_deg = keys.number("vertical_fov_deg");
  c.width = static_cast<int>(keys.integer("width"));
  c.height = static_cast<int>(keys.integer("height"));
  if (keys.has("cut")) c.cut_m = keys.number("cut");
  if (keys.clean()) {
    const glm::dvec3 way = c.target - c.eye;
    if (c.cut_m && *c.cut_m >= c.eye.z) keys.problem("cut", "'cut' must be below the camera's eye");
    if (glm::length(way) < 1e-6) {
      keys.problem("target", "'target' must not be where the camera stands");
    } else if (glm::length(glm::cross(glm::normalize(way), c.up)) < 1e-6) {
      keys.problem("up", "'up' must not be the direction in which the camera looks");
    }
  }
  reading.scene.cameras.push_back(std::move(c));
}

}  // namespace luxodus
