#include "scenes/formats/fds_input/input_states.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "runtime/core/printable.hpp"

namespace luxodus::fds_input {

namespace {

bool is_left_out(const FdsTitle& title, const FdsInputOptions& options) {
  return options.without.contains(title.handle);
}

}  // namespace

bool is_there(const FdsTitle& title, const FdsCourse& course, const FdsInputOptions& options) {
  return course.at(options.at_s) && !is_left_out(title, options);
}

bool is_ever_there(const FdsObstruction& o, const FdsInputOptions& options) {
  return (o.course.at_start || !o.course.turns_s.empty()) && !is_left_out(o.title, options);
}

fds::FireTimes times_of(const FdsCourse& course) {
  std::vector<fds::FireTurn> turns;
  bool there = course.at_start;
  for (const double at_s : course.turns_s) turns.push_back({at_s, there = !there});
  return fds::times_of_turns(std::move(turns));
}

Result<void> names_known(const FdsInput& input, const FdsInputOptions& options) {
  std::set<std::string> names;
  for (const FdsObstruction& o : input.obstructions) names.insert(o.title.handle);
  for (const FdsHole& h : input.holes) names.insert(h.title.handle);
  for (const FdsOpening& o : input.openings) names.insert(o.title.handle);
  for (const std::string& name : options.without)
    if (!names.contains(name))
      return problem_in(
          input.file, fmt::format("no obstruction, hole or opening has the ID \"{}\"; one without "
                                  "an ID is named by its line, as in \"line 12\"",
                                  excerpt(name)));
  return {};
}

Problem too_many_objects(const FdsInput& input) {
  return problem_in(input.file, fmt::format("its building has more than {} objects",
                                            luxodus::limits::fire_objects));
}

Problem too_much_to_compare(const FdsInput& input) {
  return problem_in(input.file,
                    fmt::format("its meshes, obstructions and holes make more than {} pairs: "
                                "import the .smv of its results",
                                luxodus::limits::fds_input_pairs));
}

fds::FireLook input_look(const FdsInput& input, size_t surface,
                         const std::optional<glm::dvec3>& rgb, double opacity) {
  const FdsInputSurface& s = input.surfaces[surface];
  return {s.name, s.rgb, rgb, opacity};
}

namespace {

/// "the obstruction "x"", or by its line and box where it has no ID.
std::string described(const char* kind, const FdsTitle& title, const Box& box) {
  if (!title.name.empty()) return fmt::format("the {} \"{}\"", kind, excerpt(title.name));
  return fmt::format("the {} at {} (XB {:.6g}, {:.6g}, {:.6g}, {:.6g}, {:.6g}, {:.6g})", kind,
                     title.handle, box.low.x, box.high.x, box.low.y, box.high.y, box.low.z,
                     box.high.z);
}

/// Notes "the obstruction "x" is driven by the device "y": it stands as at the start", once for the
/// copies of one group.
void note_driven(const char* kind, const FdsTitle& title, const Box& box, const FdsCourse& course,
                 const FdsInputOptions& options, std::set<std::string>& told, FireBuilding& out) {
  if (course.driven_by.empty() || is_left_out(title, options) ||
      !told.insert(kind + title.handle).second)
    return;
  out.notes.push_back(fmt::format(
      "{} is driven by {}: it is taken as at the start, {}", described(kind, title, box),
      course.driven_by,
      course.at_start ? fmt::format("there; --without \"{}\" takes it away", excerpt(title.handle))
                      : "not there"));
}

}  // namespace

void add_bodies_and_notes(const FdsInput& input, const FdsInputOptions& options,
                          FireBuilding& out) {
  for (const FdsBody& body : input.bodies) {
    FireBody& one = out.bodies.emplace_back();
    one.name = out.tables.name(fds::scene_name(body.name, "body"));
    one.material = out.tables.material(input_look(input, body.surface, body.rgb, body.opacity));
    one.mesh = body.mesh;
  }
  std::set<std::string> told;
  out.notes.insert(out.notes.end(), input.notes.begin(), input.notes.end());
  for (const FdsObstruction& o : input.obstructions) {
    note_driven("obstruction", o.title, o.box, o.course, options, told, out);
    const std::string name = fds::scene_name(o.title.name, "obstruction");
    const bool told_already =
        std::find(out.absent.begin(), out.absent.end(), name) != out.absent.end();
    if (!is_there(o.title, o.course, options) && !told_already) out.absent.push_back(name);
  }
  for (const FdsHole& h : input.holes)
    note_driven("hole", h.title, h.box, h.course, options, told, out);
  for (const FdsOpening& o : input.openings)
    note_driven("opening", o.title, o.box, o.course, options, told, out);
}

}  // namespace luxodus::fds_input
