#include "tests/optics/posed_room.hpp"

#include <array>
#include <cmath>

namespace luxodus::light {

namespace {

glm::dmat3 turned_by(double a, double b) {
  const glm::dmat3 about_z(glm::dvec3(std::cos(a), std::sin(a), 0),
                           glm::dvec3(-std::sin(a), std::cos(a), 0), glm::dvec3(0, 0, 1));
  const glm::dmat3 about_x(glm::dvec3(1, 0, 0), glm::dvec3(0, std::cos(b), std::sin(b)),
                           glm::dvec3(0, -std::sin(b), std::cos(b)));
  return about_x * about_z;
}

const glm::dvec3 room_low(0), room_high(4, 3, 2.5);
constexpr int cells_u = 3, cells_v = 2;

/// A frame of the room after posing. Frames are right-handed: in a mirror, local x is reversed, and
/// everything here that has a frame is symmetrical along it.
Frame posed(const Pose& pose, const glm::dvec3& origin, const glm::dmat3& axes) {
  Frame frame;
  frame.origin = pose.point(origin);
  frame.axes = pose.axes * axes;
  if (pose.mirrored()) frame.axes[0] = -frame.axes[0];
  return frame;
}

/// Poses corner and edges of a parallelogram; in a mirror from its other end, so that its normal
/// stays.
template <class Plane>
void stand(Plane& plane, const Pose& pose, const glm::dvec3& corner, const glm::dvec3& u,
           const glm::dvec3& v) {
  const bool mirrored = pose.mirrored();
  plane.corner = pose.point(mirrored ? corner + u : corner);
  plane.edge_u = pose.scale * pose.way(mirrored ? -u : u);
  plane.edge_v = pose.scale * pose.way(v);
}

void add_walls(SceneDescription& scene, const Pose& pose) {
  const auto add = [&](const std::string& name, const glm::dvec3& corner, const glm::dvec3& u,
                       const glm::dvec3& v, double reflectance) {
    add_quad(scene, name, pose.point(corner), pose.scale * pose.way(u), pose.scale * pose.way(v),
             add_grey(scene, reflectance));
  };
  double reflectance = 0.2;
  for (const BoxFace& f : faces_of_box(room_low, room_high)) {
    // The opening: a third of one wall.
    add(f.name, f.corner, f.u, f.name == "x1" ? f.v * (2.0 / 3) : f.v, reflectance += 0.1);
  }
  add("screen", {2.5, 0.3, 0.2}, {0.3, 1.5, 0}, {0, 0, 1.7}, 0.4);
}

void add_lamps(SceneDescription& scene, const Pose& pose) {
  const double area = pose.scale * pose.scale;
  const glm::dmat3 along(1.0);
  add_rectangle(scene, {0, 0, 0}, {0, 0, -1}, 0.5 * pose.scale, 0.3 * pose.scale, 2 * area).frame =
      posed(pose, {1.2, 1.3, 2.4}, along);
  add_point(scene, pose.point({3.4, 2.2, 0.9}), area);
  Sign sign;
  sign.name = "sign";
  // On the wall y1, facing into the room.
  sign.frame = posed(pose, {2.6, 2.97, 1.6},
                     glm::dmat3(glm::dvec3(1, 0, 0), glm::dvec3(0, 0, 1), glm::dvec3(0, -1, 0)));
  sign.width_m = 0.6 * pose.scale;
  sign.height_m = 0.3 * pose.scale;
  sign.smallest_detail_m = 0.05 * pose.scale;
  constexpr ColourIndex w = 0, g = 1;
  sign.face.width = 4;
  sign.face.height = 2;
  sign.face.colour = {g, w, w, g, w, w, w, w};
  sign.colours = white_and_green({400, 100});
  scene.signs.push_back(sign);
  Observer observer;
  observer.name = "eye";
  observer.eye = pose.point({0.6, 0.8, 1.5});
  observer.gaze = pose.way({0.6, 0.8, 0});
  scene.observers.push_back(observer);
}

void add_smoke(SceneDescription& scene, const Pose& pose, Level level) {
  const double s = pose.scale;
  add_ball(scene, pose.point({1.5, 1.4, 1.4}), 0.9 * s, smoke(1.5 / s, 0.7, 0.6));
  const glm::dvec3 low(2.2, 0.5, 0.3), extent(1.2, 1.5, 1.8);
  const auto cells = [&](const glm::dvec3& p) {
    const glm::dvec3 q = p / s;
    return std::abs(q.x - 0.5 * extent.x) * (q.y + 0.5 * q.z) / s;
  };
  Medium& data = add_cells(scene, {0, 0, 0}, extent * s, 6, cells, 0.8, -0.3);
  data.frame =
      posed(pose, pose.mirrored() ? low + glm::dvec3(extent.x, 0, 0) : low, glm::dmat3(1.0));
  if (level == Level::without) return;
  add_layers(scene, pose.shift.z + 0.25 * s, {0.75 * s, 0.5 * s, 1.5 * s},
             {smoke(0.2 / s, 0.9), smoke(0, 0.9), smoke(0.5 / s, 0.6, 0.3)});
}

void add_measures(SceneDescription& scene, const Pose& pose, Level level) {
  PlaneMeasure plane;
  plane.name = "plane";
  stand(plane, pose, {0.5, 0.5, 0.8}, {3, 0, 0}, {0, 2, 0});
  plane.cells_u = cells_u;
  plane.cells_v = cells_v;
  scene.planes.push_back(plane);
  CountingPlaneMeasure counting;
  counting.name = "counting";
  stand(counting, pose, {2, 0.2, 0.2}, {0, 2.6, 0}, {0, 0, 2});
  scene.counting_planes.push_back(counting);
  const double s = pose.scale;
  add_shell_group(scene, pose.point({1.7, 1.5, 1.5}), 0, 0.6 * s);
  add_shell_group(scene, pose.point({2.6, 1.2, 1.1}), 0.3 * s, 0.9 * s);
  for (int i = 0; i < 2; ++i) {
    ProbeMeasure probe;
    probe.name = "probe " + std::to_string(i);
    probe.position = pose.point(i == 0 ? glm::dvec3(0.7, 2.3, 0.6) : glm::dvec3(3.1, 1.1, 1.3));
    probe.normal = pose.way(i == 0 ? glm::dvec3(0, 0, 1) : glm::dvec3(-0.6, 0, 0.8));
    scene.probes.push_back(probe);
  }
  if (level == Level::without) return;
  // Level in the reference room, which is posed by turned().
  const glm::dmat3 since = pose.axes * glm::transpose(turned());
  const glm::dvec3 a = pose.point({1, 1, 0.6}), b = a + since * (s * glm::dvec3(0.8, 0.7, 0.9));
  add_box_group(scene, glm::min(a, b), glm::max(a, b));
}

}  // namespace

const std::vector<std::string> room_things = {"x0", "x1", "y0", "y1", "z0", "z1", "screen"};

glm::dmat3 turned() {
  return turned_by(0.7, 0.4);
}
glm::dmat3 turned_again() {
  return turned_by(-1.3, 2.1);
}

void close_opening(SceneDescription& room, const Pose& pose) {
  const BoxFace f = faces_of_box(room_low, room_high)[1];
  SceneDescription whole;
  room.objects[1].mesh = add_quad(whole, f.name, pose.point(f.corner), pose.scale * pose.way(f.u),
                                  pose.scale * pose.way(f.v), 0)
                             .mesh;
}

SceneDescription posed_room(const Pose& pose, Level level) {
  SceneDescription scene;
  scene.run.max_bands = 1;
  scene.run.voxels = level == Level::with;
  scene.run.voxel_edge_m = 0.5 * pose.scale;
  scene.run.eye_path_factor = 4;
  add_walls(scene, pose);
  add_lamps(scene, pose);
  add_smoke(scene, pose, level);
  add_measures(scene, pose, level);
  return scene;
}

// ---- readings ----------------------------------------------------------------------------------

namespace {

std::vector<BinSum> sums_of(const SceneDescription& scene) {
  BinSum smoke{&TallyBlocks::media_power, {}};
  for (uint32_t m = 0; m < scene.media.size(); ++m) smoke.bins.push_back(m);
  return {every_side(), smoke};
}

}  // namespace

RoomRun::RoomRun(SceneDescription scene, const Pose& pose, Level level, const RunOptions& options)
    : Run(scene, options, sums_of(scene)), pose_(pose), level_(level) {
  read_surfaces();
  read_planes();
  read_volumes();
  read_eyes();
}

void RoomRun::add(const std::string& name, const Estimate& estimate, double scale_power,
                  Known known) {
  readings_.push_back({name, estimate * std::pow(pose_.scale, -scale_power), known});
}

void RoomRun::read_surfaces() {
  for (const std::string& thing : room_things) {
    add(thing + " in", into(thing), 2, Known::well);
    add(thing + " absorbed", absorbed_by(thing), 2, Known::well);
  }
  add("escaped", sum(0), 2, Known::well);
  add("smoke absorbed", sum(1, 0), 2, Known::well);
  add("smoke scattered", sum(1, 1), 2, Known::well);
  if (level_ == Level::without) return;
  // Because of its rotation it sends little light through the other sides.
  for (const uint32_t side : {1u, 3u, 5u}) {
    const uint32_t there = pose_.mirrored() && side < 2 ? 1 - side : side;
    add("escaped " + std::to_string(side), escaped(there), 2, Known::rather);
  }
}

void RoomRun::read_planes() {
  for (uint32_t quantity = 0; quantity < 2; ++quantity) {
    const std::string kind = quantity == 0 ? " direct" : " indirect";
    add("plane" + kind, watts(blocks().planes, 0, quantity), 2, Known::well);
    for (int j = 0; j < cells_v; ++j) {
      for (int i = 0; i < cells_u; ++i) {
        const int there = pose_.mirrored() ? cells_u - 1 - i : i;
        add("cell " + std::to_string(i) + " " + std::to_string(j) + kind,
            watts(blocks().plane_cells, static_cast<uint32_t>(j * cells_u + there), quantity), 2,
            Known::rather);
      }
    }
  }
  for (uint32_t quantity = 0; quantity < 4; ++quantity)
    add("counted " + std::to_string(quantity), watts(blocks().counting, 0, quantity), 2,
        Known::rather);
}

void RoomRun::read_volumes() {
  for (uint32_t g = 0; g < scene().volume_groups.size(); ++g) {
    const std::string name = "volume " + std::to_string(g);
    add(name + " length", track_length(g), 3, Known::well);
    add(name + " absorbed", watts(blocks().volume_power, g, 0), 2, Known::rather);
    add(name + " scattered", watts(blocks().volume_power, g, 1), 2, Known::rather);
  }
}

void RoomRun::read_eyes() {
  for (uint32_t p = 0; p < scene().description->probes.size(); ++p) {
    const std::string name = "probe " + std::to_string(p);
    add(name + " illuminance", value(blocks().probes, p, 0), 0, Known::from_eyes);
    add(name + " fluence", value(blocks().probes, p, 1), 0, Known::from_eyes);
  }
  constexpr std::array parts{"white ", "green ", "surround "};
  constexpr std::array quantities{"own", "reflected", "at eye", "path", "transmission", "visible"};
  for (uint32_t part = 0; part < 3 * scene().eye_targets.size(); ++part) {
    for (uint32_t q = 0; q < eye_quantities; ++q)
      add(std::string(parts[part % 3]) + quantities[q], value(blocks().views, part, q), 0,
          Known::from_eyes);
  }
}

// ---- comparisons -------------------------------------------------------------------------------

namespace {

/// Largest relative standard errors of meaningful readings. An eye path that comes within half a
/// lamp's size and hits it brings its luminance, some hundred times the usual.
double max_error(Known known) {
  return (known == Known::well ? 1e-2 : known == Known::rather ? 5e-2 : 0.25) * root_of_thrift;
}

/// Share of a standard error that a few histories may change: some three times the observed value.
/// Single histories count for more in small bins, and among eye paths a hit of a lamp may be the
/// whole difference.
double part_of_error(Known known) {
  return (known == Known::well ? 0.03 : known == Known::rather ? 0.1 : 1.0) * root_of_thrift;
}

double share_of(uint64_t a, uint64_t b) {
  return static_cast<double>(a) / static_cast<double>(b);
}

/// Share of all voxel scores that has moved to another voxel or direction.
double moved_in_voxels(const RoomRun& a, const RoomRun& b) {
  REQUIRE(a.scene().voxels.count() == b.scene().voxels.count());
  double all = 0, moved = 0;
  for (uint32_t v = 0; v < a.scene().voxels.count(); ++v) {
    for (uint32_t quantity = 0; quantity < 4; ++quantity) {
      const auto of = [&](const RoomRun& run) {
        const double unit = run.emitted_w() * static_cast<double>(run.scene().voxels.edge);
        return run.watts(run.blocks().voxels, v, quantity).value / unit;
      };
      const double x = of(a), y = of(b);
      if (quantity == 0) all += 0.5 * (x + y);
      moved += 0.5 * std::abs(x - y);
    }
  }
  return moved / all;
}

template <class Check>
void for_each_reading(const RoomRun& a, const RoomRun& b, Check check) {
  REQUIRE(a.readings().size() == b.readings().size());
  for (size_t i = 0; i < a.readings().size(); ++i) {
    const Reading &x = a.readings()[i], &y = b.readings()[i];
    REQUIRE(x.name == y.name);
    INFO(y.name << ": " << x.estimate.value << " and " << y.estimate.value << " +- "
                << y.estimate.standard_error);
    check(x.estimate, y.estimate, y.known);
  }
}

}  // namespace

void check_same_histories(const RoomRun& a, const RoomRun& b) {
  for_each_reading(a, b, [](const Estimate& x, const Estimate& y, Known known) {
    const double size = std::abs(y.value);
    CHECK(y.standard_error <= max_error(known) * size);
    CHECK(std::abs(x.value - y.value) <= part_of_error(known) * y.standard_error + 1e-6 * size);
  });
  const double events = 2e-5 * root_of_thrift;
  CHECK(share_of(a.balance().rays, b.balance().rays) == Approx(1).epsilon(events));
  CHECK(share_of(a.balance().hits, b.balance().hits) == Approx(1).epsilon(events));
  CHECK(share_of(a.balance().collisions, b.balance().collisions) == Approx(1).epsilon(events));
  CHECK(moved_in_voxels(a, b) <= 1e-4 * root_of_thrift);
}

void check_same_values(const RoomRun& a, const RoomRun& b, double relative, bool eyes) {
  for_each_reading(a, b, [&](const Estimate& x, const Estimate& y, Known known) {
    if (known == Known::from_eyes && !eyes) return;
    CHECK(std::abs(x.value - y.value) <= relative * std::abs(y.value));
    CHECK(std::abs(x.standard_error - y.standard_error) <= relative * std::abs(y.value));
  });
  CHECK(a.balance().rays == b.balance().rays);
  CHECK(a.balance().hits == b.balance().hits);
  CHECK(a.balance().collisions == b.balance().collisions);
  CHECK(moved_in_voxels(a, b) <= relative);
}

void check_same_light(const RoomRun& a, const RoomRun& b) {
  for_each_reading(a, b, [](const Estimate& x, const Estimate& y, Known known) {
    check_agree(x, y, std::sqrt(2.0) * max_error(known));
  });
}

void check_same_views(const RoomRun& a, const RoomRun& b) {
  for_each_reading(a, b, [](const Estimate& x, const Estimate& y, Known known) {
    if (known == Known::from_eyes) check_agree(x, y, std::sqrt(2.0) * max_error(known));
  });
}

std::vector<double> direct_light_of(SceneDescription scene, const Pose& pose) {
  const Traced traced(compile(std::move(scene)), 1, 1);
  std::vector<double> out;
  for (const glm::dvec3& p : {glm::dvec3(1, 1, 0.4), glm::dvec3(0.3, 2.5, 1.9),
                              glm::dvec3(3.5, 0.6, 0.5), glm::dvec3(1.9, 1.5, 1.2)}) {
    for (const glm::dvec3& n : {glm::dvec3(0, 0, 1), glm::dvec3(0.6, 0, -0.8)})
      out.push_back(traced.direct_lx(pose.point(p), pose.way(n)));
  }
  return out;
}

}  // namespace luxodus::light
