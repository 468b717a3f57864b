// Reads an FDS input file in two steps: first all groups of all files, then their meaning, in the
// order in which they refer to each other: &MULT, &SURF and &DEVC before what names them.
#include "scenes/formats/fds_input/fds_input.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>

#include "runtime/core/printable.hpp"
#include "scenes/formats/fds_input/bodies.hpp"
#include "scenes/formats/fds_input/colours.hpp"
#include "scenes/formats/fds_input/drivers.hpp"
#include "scenes/formats/fds_input/input_files.hpp"
#include "scenes/formats/fds_input/moves.hpp"
#include "scenes/formats/fds_input/multiplier.hpp"
#include "scenes/formats/fields/fds_case.hpp"

namespace luxodus {

namespace {

using fds_input::Box;
using fds_input::GroupKeys;
using fds_input::InputFiles;
using fds_input::Multiplier;

class InputReader {
 public:
  explicit InputReader(const InputFiles& files) : files_(files) { out_.file = files.main; }

  Result<FdsInput> read() {
    for (const char* name : {"TRNX", "TRNY", "TRNZ"})
      each(name, [&](GroupKeys& keys) {
        if (!out_.stretched) out_.stretched = SourcePlace{keys.file(), keys.line()};
      });
    each("TIME", [&](GroupKeys& keys) {
      if (keys.has("T_END")) out_.end_s = keys.number("T_END", 0);
    });
    each("HEAD", [&](GroupKeys& keys) { head(keys); });
    each("MISC", [&](GroupKeys& keys) { misc(keys); });
    each("MULT", [&](GroupKeys& keys) {
      Multiplier one = fds_input::multiplier_of(keys, limits::fds_input_boxes);
      multipliers_[one.id] = one;
    });
    each("MOVE", [&](GroupKeys& keys) { moves_[keys.text("ID")] = fds_input::move_of(keys); });
    out_.surfaces.push_back({.name = "INERT"});
    each("SURF", [&](GroupKeys& keys) { surface(keys); });
    default_surface();
    each("RAMP", [&](GroupKeys& keys) {
      if (auto note = drivers_.add_ramp(keys)) out_.notes.push_back(std::move(*note));
    });
    each("DEVC", [&](GroupKeys& keys) { drivers_.add_device(keys); });
    each("CTRL", [&](GroupKeys& keys) { drivers_.add_control(keys); });
    each("MESH", [&](GroupKeys& keys) { mesh(keys); });
    if (!problem_ && out_.meshes.empty())
      return problem_in(out_.file,
                        "there is no &MESH in this file: is it the input of an FDS "
                        "case?");
    each("OBST", [&](GroupKeys& keys) { obstruction(keys); });
    each("HOLE", [&](GroupKeys& keys) { hole(keys); });
    each("VENT", [&](GroupKeys& keys) { vent(keys); });
    each("GEOM", [&](GroupKeys& keys) { body(keys); });
    if (problem_) return *problem_;
    note_left_out();
    return std::move(out_);
  }

 private:
  template <class Do>
  void each(std::string_view name, const Do& act) {
    for (const fds_input::InputFile& file : files_.files)
      for (const fds_input::Group& group : file.groups) {
        if (problem_) return;
        if (group.name != name) continue;
        GroupKeys keys(group, file.name, problem_);
        act(keys);
      }
  }

  /// Calls `act` for each copy of a box that &MULT makes. `there`: how many of this kind exist
  /// already.
  template <class Do>
  void copies(GroupKeys& keys, const Box& box, size_t there, const Do& act) {
    Multiplier times;
    if (keys.has("MULT_ID")) {
      const std::string id = keys.text("MULT_ID");
      const auto at = multipliers_.find(id);
      if (at == multipliers_.end())
        return keys.fail("MULT_ID", fmt::format("there is no &MULT \"{}\"", excerpt(id)));
      times = at->second;
    }
    if (times.count() > static_cast<int64_t>(limits::fds_input_boxes - there))
      return keys.fail("MULT_ID", fmt::format("there are more than {} boxes of this kind",
                                              limits::fds_input_boxes));
    glm::ivec3 n;
    for (n.z = times.first.z; n.z <= times.last.z; ++n.z)
      for (n.y = times.first.y; n.y <= times.last.y; ++n.y)
        for (n.x = times.first.x; n.x <= times.last.x; ++n.x) {
          if (times.skips(n)) continue;
          Box copy = times.copy(box, n);
          const Box moved = copy;
          copy.low = glm::min(moved.low, moved.high);
          copy.high = glm::max(moved.low, moved.high);
          const glm::dvec3 far = glm::max(glm::abs(copy.low), glm::abs(copy.high));
          if (!(std::max({far.x, far.y, far.z}) <= fds_input::limits::farthest_m))
            return keys.fail("MULT_ID", "a copy that &MULT makes is beyond 1000 km");
          act(copy);
        }
  }

  void head(GroupKeys& keys) {
    out_.case_name = keys.text("CHID", out_.case_name);
    if (out_.case_name.find_first_of(std::string_view("/\\\0", 3)) != std::string::npos)
      keys.fail("CHID", "CHID of &HEAD is no name of files");
  }

  void misc(GroupKeys& keys) {
    thicken_ = keys.flag("THICKEN_OBSTRUCTIONS", thicken_);
    default_name_ = keys.text("SURF_DEFAULT", default_name_);
  }

  /// COLOR, else RGB; nothing where neither is given.
  std::optional<glm::dvec3> colour(GroupKeys& keys) {
    if (!keys.has("COLOR")) return keys.rgb("RGB");
    const std::string name = keys.text("COLOR");
    if (name == "INVISIBLE") return FdsInputSurface{}.rgb;
    const auto rgb = fds_input::colour_rgb(name);
    if (!rgb)
      out_.notes.push_back(fmt::format("line {}: the colour \"{}\" is not known, grey is taken",
                                       keys.line_of("COLOR"), excerpt(name)));
    return rgb.value_or(glm::dvec3(0.5));
  }

  double opacity(GroupKeys& keys) { return std::clamp(keys.number("TRANSPARENCY", 1), 0.0, 1.0); }

  void surface(GroupKeys& keys) {
    FdsInputSurface one;
    one.name = keys.text("ID");
    if (const auto rgb = colour(keys)) one.rgb = *rgb;
    one.opacity = opacity(keys);
    if (keys.flag("DEFAULT", false)) default_name_ = one.name;
    const size_t place = out_.surfaces.size();
    if (surface_places_.emplace(one.name, place).second) out_.surfaces.push_back(std::move(one));
  }

  void default_surface() {
    surface_places_.emplace("INERT", 0);
    const auto at = surface_places_.find(default_name_);
    if (at != surface_places_.end()) out_.default_surface = at->second;
  }

  size_t surface_named(GroupKeys& keys, std::string_view key, const std::string& name) {
    if (name.empty() || name == "null") return out_.default_surface;
    const auto at = surface_places_.find(name);
    if (at != surface_places_.end()) return at->second;
    keys.fail(key, fmt::format("there is no &SURF \"{}\"", excerpt(name)));
    return 0;
  }

  /// The surface of most of the six sides.
  size_t surface_of_sides(GroupKeys& keys) {
    std::vector<size_t> sides(6, out_.default_surface);
    if (keys.has("SURF_ID")) sides.assign(6, surface_named(keys, "SURF_ID", keys.text("SURF_ID")));
    const std::vector<std::string> three = keys.texts("SURF_IDS");  // top, sides, bottom
    const size_t of_side[] = {1, 1, 1, 1, 2, 0};
    for (size_t i = 0; i < 6; ++i)
      if (of_side[i] < three.size()) sides[i] = surface_named(keys, "SURF_IDS", three[of_side[i]]);
    const std::vector<std::string> six = keys.texts("SURF_ID6");
    for (size_t i = 0; i < std::min<size_t>(6, six.size()); ++i)
      sides[i] = surface_named(keys, "SURF_ID6", six[i]);
    return *std::max_element(sides.begin(), sides.end(), [&](size_t a, size_t b) {
      return std::count(sides.begin(), sides.end(), a) < std::count(sides.begin(), sides.end(), b);
    });
  }

  FdsCourse course(GroupKeys& keys) {
    for (const bool is_device : {true, false}) {
      const char* key = is_device ? "DEVC_ID" : "CTRL_ID";
      if (!keys.has(key)) continue;
      const std::string id = keys.text(key);
      if (const auto one = drivers_.course(is_device, id)) return *one;
      keys.fail(key,
                fmt::format("there is no &{} \"{}\"", is_device ? "DEVC" : "CTRL", excerpt(id)));
    }
    return {};
  }

  /// The ID of an object, or where it stands.
  FdsTitle title(GroupKeys& keys) {
    FdsTitle out;
    out.name = keys.text("ID");
    const bool is_main = keys.file() == out_.file;
    const std::string of_file =
        is_main ? "" : std::filesystem::path(keys.file()).filename().string() + " ";
    out.handle = out.name.empty() ? fmt::format("{}line {}", of_file, keys.line()) : out.name;
    return out;
  }

  /// The &MOVE that a group names; nothing where it names none.
  std::optional<fds_input::Move> move_named(GroupKeys& keys) {
    if (!keys.has("MOVE_ID")) return std::nullopt;
    const std::string id = keys.text("MOVE_ID");
    const auto at = moves_.find(id);
    if (at != moves_.end()) return at->second;
    keys.fail("MOVE_ID", fmt::format("there is no &MOVE \"{}\"", excerpt(id)));
    return std::nullopt;
  }

  /// Moves a box in place.
  void move_box(GroupKeys& keys, Box& box) {
    const auto move = move_named(keys);
    if (!move) return;
    const auto there = fds_input::moved(box, *move);
    if (!there)
      return keys.fail("MOVE_ID",
                       fmt::format("MOVE_ID of &{} turns it off the axes, or beyond 1000 km: give "
                                   "it as a &GEOM, or import the .smv of its results",
                                   keys.name()));
    box = *there;
  }

  void mesh(GroupKeys& keys) {
    for (const char* key : {"TRNX_ID", "TRNY_ID", "TRNZ_ID"})
      if (keys.has(key) && !out_.stretched)
        out_.stretched = SourcePlace{keys.file(), keys.line_of(key)};
    if (keys.flag("CYLINDRICAL", false))
      keys.fail("CYLINDRICAL", "CYLINDRICAL of &MESH is not imported: a building has no wedges");
    FdsInputMesh one;
    one.line = keys.line();
    one.name = keys.text("ID", fmt::format("mesh {}", out_.meshes.size() + 1));
    const std::vector<double> ijk = keys.array("IJK", {10, 10, 10});
    double all = 1;
    for (int axis = 0; axis < 3; ++axis) {
      const double n = ijk[static_cast<size_t>(axis)];
      all *= n;
      if (!(n >= 1 && n <= fds::limits::side_cells && n == std::floor(n)))
        return keys.fail("IJK", fmt::format("IJK of &MESH is not three numbers of 1 to {}",
                                            fds::limits::side_cells));
      one.cells[axis] = static_cast<int>(n);
    }
    if (all > static_cast<double>(fds::limits::mesh_cells))
      return keys.fail("IJK", fmt::format("the mesh has {:g} cells: at most {} are read", all,
                                          fds::limits::mesh_cells));
    const auto box = keys.has("XB") ? keys.box("XB") : Box{glm::dvec3(0), glm::dvec3(1)};
    if (!box) return;
    copies(keys, *box, 0, [&](const Box& copy) {
      if (!glm::all(glm::lessThan(copy.low, copy.high)))
        return keys.fail("XB", "a &MESH has no volume");
      if (out_.meshes.size() >= fds::limits::meshes)
        return keys.fail("XB", fmt::format("there are more than {} meshes", fds::limits::meshes));
      one.box = copy;
      out_.meshes.push_back(one);
    });
  }

  void obstruction(GroupKeys& keys) {
    keys.refuse("SHAPE",
                "FDS makes it of cells; write boxes, a &GEOM, or import the .smv of its "
                "results");
    FdsObstruction one;
    one.title = title(keys);
    one.surface = surface_of_sides(keys);
    one.rgb = colour(keys);
    one.opacity = keys.has("TRANSPARENCY") ? opacity(keys) : out_.surfaces[one.surface].opacity;
    one.permit_hole = keys.flag("PERMIT_HOLE", true);
    one.thicken = keys.flag("THICKEN", thicken_);
    one.course = course(keys);
    const auto box = required_box(keys);
    if (!box) return;
    copies(keys, *box, out_.obstructions.size(), [&](const Box& copy) {
      one.box = copy;
      out_.obstructions.push_back(one);
    });
  }

  std::optional<Box> required_box(GroupKeys& keys) {
    if (!keys.has("XB")) keys.fail("XB", fmt::format("this &{} has no XB", keys.name()));
    auto box = keys.box("XB");
    if (box) move_box(keys, *box);
    return box;
  }

  void hole(GroupKeys& keys) {
    FdsHole one;
    one.title = title(keys);
    one.course = course(keys);
    const auto box = required_box(keys);
    if (!box) return;
    copies(keys, *box, out_.holes.size(), [&](const Box& copy) {
      one.box = copy;
      out_.holes.push_back(one);
    });
  }

  /// Reads openings only: other surface patches have no geometry.
  void vent(GroupKeys& keys) {
    const std::string surface = keys.text("SURF_ID");
    if (fds::is_symmetric(surface) && symmetric_faces_++ == 0)
      first_symmetric_ = fmt::format("line {}: {}", keys.line(), surface);
    if (surface != "OPEN" || keys.flag("GEOM", false)) return;
    FdsOpening one;
    one.title = title(keys);
    one.course = course(keys);
    Box around{glm::dvec3(1e300), glm::dvec3(-1e300)};
    for (const FdsInputMesh& m : out_.meshes) {
      around.low = glm::min(around.low, m.box.low);
      around.high = glm::max(around.high, m.box.high);
    }
    if (keys.has("RADIUS"))
      out_.notes.push_back(
          fmt::format("line {}: the round opening \"{}\" is taken as its rectangle", keys.line(),
                      excerpt(one.title.handle)));
    const std::string by_mesh = keys.text("MB"), of_all = keys.text("DB");
    if (!by_mesh.empty()) {
      one.mesh_face = face_named(keys, "MB", by_mesh);
      one.box = around;
      return add_opening(keys, one);
    }
    if (!of_all.empty()) {
      const int face = face_named(keys, "DB", of_all);
      const int axis = face / 2;
      one.box = around;
      (face % 2 == 0 ? one.box.high : one.box.low)[axis] =
          face % 2 == 0 ? around.low[axis] : around.high[axis];
      return add_opening(keys, one);
    }
    const char* const planes[] = {"PBX", "PBY", "PBZ"};
    bool plane = false;
    one.box = around;
    for (int axis = 0; axis < 3; ++axis) {
      if (!keys.has(planes[axis])) continue;
      plane = true;
      const double at = keys.number(planes[axis], 0);
      if (!(std::abs(at) <= fds_input::limits::farthest_m))
        return keys.fail(planes[axis], "a plane of &VENT is beyond 1000 km");
      one.box.low[axis] = one.box.high[axis] = at;
    }
    if (plane) return add_opening(keys, one);
    const auto box = required_box(keys);
    if (!box) return;
    if (glm::all(glm::lessThan(box->low, box->high)))
      return keys.fail("XB", "XB of &VENT is no plane");
    copies(keys, *box, out_.openings.size(), [&](const Box& copy) {
      one.box = copy;
      out_.openings.push_back(one);
    });
  }

  void add_opening(GroupKeys& keys, const FdsOpening& opening) {
    if (out_.openings.size() >= limits::fds_input_boxes)
      return keys.fail("XB",
                       fmt::format("there are more than {} openings", limits::fds_input_boxes));
    out_.openings.push_back(opening);
  }

  static int face_named(GroupKeys& keys, const char* key, const std::string& name) {
    const char* const names[] = {"XMIN", "XMAX", "YMIN", "YMAX", "ZMIN", "ZMAX"};
    const auto* at = std::find(std::begin(names), std::end(names), name);
    if (at != std::end(names)) return static_cast<int>(at - std::begin(names));
    keys.fail(key, fmt::format("{} of &VENT is none of XMIN, XMAX, YMIN, YMAX, ZMIN, ZMAX", key));
    return 0;
  }

  void body(GroupKeys& keys) {
    FdsBody one;
    one.name = keys.text("ID", "body");
    one.rgb = colour(keys);
    std::vector<std::string> names = keys.texts("SURF_ID");
    if (names.empty()) names = keys.texts("SURF_IDS");
    if (names.empty()) names = keys.texts("SURF_ID6");
    fds_input::Body made =
        fds_input::body_of(keys, names.size(), limits::fds_input_triangles - triangles_);
    const auto move = move_named(keys);
    for (size_t i = 0; i < made.meshes.size() && !problem_; ++i) {
      if (made.meshes[i].triangles.empty()) continue;
      if (move) fds_input::move_mesh(made.meshes[i], *move);
      triangles_ += made.meshes[i].triangles.size();
      one.surface =
          i < names.size() ? surface_named(keys, "SURF_ID", names[i]) : out_.default_surface;
      one.opacity = keys.has("TRANSPARENCY") ? opacity(keys) : out_.surfaces[one.surface].opacity;
      one.mesh = std::move(made.meshes[i]);
      out_.bodies.push_back(one);
    }
    if (triangles_ > limits::fds_input_triangles)
      keys.fail("ID",
                fmt::format("the bodies have more than {} triangles", limits::fds_input_triangles));
  }

  void note_left_out() {
    if (symmetric_faces_ > 0)
      out_.notes.push_back(fmt::format(
          "{}{}: planes of symmetry or of repetition, behind which the building goes on; they "
          "become opaque walls",
          first_symmetric_,
          symmetric_faces_ > 1 ? fmt::format(", and {} more", symmetric_faces_ - 1) : ""));
    if (out_.stretched)
      out_.notes.push_back(
          fmt::format("line {}: the grid is stretched: the building is as written, not on cells",
                      out_.stretched->line));
    out_.notes.insert(out_.notes.end(), files_.notes.begin(), files_.notes.end());
  }

  const InputFiles& files_;
  FdsInput out_;
  std::map<std::string, Multiplier> multipliers_;
  std::map<std::string, size_t> surface_places_;
  std::map<std::string, fds_input::Move> moves_;
  fds_input::Drivers drivers_;
  size_t symmetric_faces_ = 0;
  std::string first_symmetric_;
  bool thicken_ = false;
  std::string default_name_ = "INERT";
  size_t triangles_ = 0;
  std::optional<Problem> problem_;
};

}  // namespace

Result<FdsInput> read_fds_input(const std::filesystem::path& file) {
  const auto files = fds_input::read_input_files(file);
  if (!files) return files.problem();
  auto input = InputReader(files.value()).read();
  if (input && input->case_name.empty()) input->case_name = file.stem().string();
  return input;
}

}  // namespace luxodus
