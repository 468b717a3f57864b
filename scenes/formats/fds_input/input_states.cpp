#include "scenes/formats/fds_input/input_states.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "runtime/core/printable.hpp"

namespace luxodus::fds_input {

bool is_there(const std::string& name, const FdsCourse& course, const FdsInputOptions& options) {
  return course.at(options.at_s) && !options.without.contains(name);
}

bool is_ever_there(const FdsObstruction& o, const FdsInputOptions& options) {
  return (o.course.at_start || o.course.turns_s) && !options.without.contains(o.name);
}

fds::FireTimes times_of(const FdsCourse& course) {
  if (!course.turns_s) return {};
  return fds::times_of_turns({{*course.turns_s, !course.at_start}});
}

Result<void> names_known(const FdsInput& input, const FdsInputOptions& options) {
  std::set<std::string> names;
  for (const FdsObstruction& o : input.obstructions) names.insert(o.name);
  for (const FdsHole& h : input.holes) names.insert(h.name);
  for (const FdsOpening& o : input.openings) names.insert(o.name);
  for (const std::string& name : options.without)
    if (!names.contains(name))
      return problem_in(input.file, fmt::format("no obstruction, hole or opening has the ID \"{}\"",
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

/// Notes "obstruction "x" is driven by the device "y": it stands as at the start".
void note_driven(const char* kind, const std::string& name, const FdsCourse& course,
                 std::set<std::string>& told, FireBuilding& out) {
  if (course.driven_by.empty()) return;
  std::string note = fmt::format(
      "the {} \"{}\" is driven by {}: it is taken as at the start, {}; --without takes it away",
      kind, excerpt(name), course.driven_by, course.at_start ? "there" : "not there");
  if (told.insert(note).second) out.notes.push_back(std::move(note));
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
    note_driven("obstruction", o.name, o.course, told, out);
    const std::string name = fds::scene_name(o.name, "obstruction");
    const bool told_already =
        std::find(out.absent.begin(), out.absent.end(), name) != out.absent.end();
    if (!is_there(o.name, o.course, options) && !told_already) out.absent.push_back(name);
  }
  for (const FdsHole& h : input.holes) note_driven("hole", h.name, h.course, told, out);
  for (const FdsOpening& o : input.openings) note_driven("opening", o.name, o.course, told, out);
}

}  // namespace luxodus::fds_input
