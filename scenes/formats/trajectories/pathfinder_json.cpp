// JSON of Pathfinder: {id: {time: {"position": {x, y, z}, "velocity": {...}, "isActive": true,
// "tagsApplied": [...]}}}. It is read event by event, since its tree would take ten times its
// bytes. Times are keys, whose order says nothing. Positions of occupants that are not active are
// skipped, and so is all that a list holds. Its unit is the metre; z is the height of the floor.
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "runtime/core/printable.hpp"
#include "scenes/formats/trajectories/trajectory_rows.hpp"

namespace luxodus {

namespace {

using nlohmann::json;

/// Takes the events of the parser. Depth 1 is within the whole, 2 within a person, 3 within a time,
/// 4 within a position.
class PathfinderEvents : public nlohmann::json_sax<json> {
 public:
  explicit PathfinderEvents(const std::string& file)
      : file_(file), rows_(file, TrajectoryRows::Order::any) {}

  bool null() override { return value("null"); }
  bool boolean(bool is) override {
    if (lists_ == 0 && depth_ == 3 && key_ == "isActive") {
      active_ = is;
      return true;
    }
    return value("a flag");
  }
  bool number_integer(number_integer_t n) override { return number(static_cast<double>(n)); }
  bool number_unsigned(number_unsigned_t n) override { return number(static_cast<double>(n)); }
  bool number_float(number_float_t n, const string_t&) override { return number(n); }
  bool string(string_t&) override { return value("a text"); }
  bool binary(binary_t&) override { return value("bytes"); }
  bool start_object(size_t) override {
    if (lists_ > 0) return true;
    ++depth_;
    if (depth_ == 3) {
      place_ = {};
      active_ = true;
    }
    if (depth_ == 4) within_ = key_;
    return depth_ <= 4 || stop("objects are nested more deeply than in a file of Pathfinder");
  }
  bool key(string_t& name) override {
    if (lists_ > 0) return true;
    key_ = name;
    if (depth_ == 1) {
      const auto id = whole_of(name);
      if (!id) return stop(fmt::format("\"{}\" is no number of an occupant", excerpt(name)));
      id_ = *id;
    } else if (depth_ == 2) {
      const auto time = decimal_of(name);
      if (!time) return stop(fmt::format("occupant {}: \"{}\" is no time [s]", id_, excerpt(name)));
      time_s_ = *time;
    }
    return true;
  }
  bool end_object() override {
    if (lists_ > 0 || depth_-- != 3 || !active_) return true;
    for (const auto& coordinate : place_)
      if (!coordinate)
        return stop(
            fmt::format("occupant {} at {} s has no \"position\" with x, y and z", id_, time_s_));
    const auto added = rows_.add(
        {.id = id_, .time_s = time_s_, .place = {*place_[0], *place_[1], *place_[2]}, .facing = {}},
        0);
    if (added) return true;
    problem_ = added.problem();
    return false;
  }
  bool start_array(size_t) override {
    if (lists_ == 0 && !value("a list")) return false;
    ++lists_;
    return true;
  }
  bool end_array() override {
    --lists_;
    return true;
  }
  bool parse_error(size_t at, const std::string&, const json::exception&) override {
    return stop(fmt::format("this is no JSON: byte {} is wrong", at));
  }

  Result<Trajectories> people() {
    if (problem_) return *problem_;
    return rows_.people_of(
        {.form = "JSON of Pathfinder", .has_heights = true, .fps = std::nullopt, .people = {}});
  }

 private:
  bool stop(std::string what) {
    problem_ = problem_in(file_, std::move(what));
    return false;
  }
  bool number(double n) {
    if (lists_ == 0 && depth_ == 4 && within_ == "position")
      for (size_t axis = 0; axis < 3; ++axis)
        if (key_.size() == 1 && key_[0] == "xyz"[axis]) {
          place_[axis] = n;
          return true;
        }
    return value("a number");
  }
  /// A value that is not read; where persons and times have to be, it is a mistake.
  bool value(const char* what) {
    if (lists_ > 0) return true;
    if (depth_ >= 3 && !(depth_ == 4 && within_ == "position" && key_.size() == 1)) return true;
    return stop(fmt::format("{} stands where {} has to be", what,
                            depth_ <= 2 ? "an object of occupants and times" : "a coordinate"));
  }

  const std::string& file_;
  TrajectoryRows rows_;
  std::optional<Problem> problem_;
  int depth_ = 0;
  size_t lists_ = 0;  // within so many lists
  std::string key_, within_;
  int64_t id_ = 0;
  double time_s_ = 0;
  std::array<std::optional<double>, 3> place_;
  bool active_ = true;
};

}  // namespace

Result<Trajectories> pathfinder_json_trajectories(std::string_view bytes, const std::string& file) {
  PathfinderEvents events(file);
  (void)json::sax_parse(bytes.begin(), bytes.end(), &events);  // its problem is in the events
  return events.people();
}

}  // namespace luxodus
