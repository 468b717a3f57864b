#include "scenes/formats/fds_input/drivers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>

#include "runtime/core/printable.hpp"

namespace luxodus::fds_input {

namespace {

/// A state that does not follow from the clock stays as at the start.
FdsCourse driven(bool is_device, const std::string& id, bool at_start) {
  FdsCourse out;
  out.at_start = at_start;
  out.driven_by = fmt::format("the {} \"{}\"", is_device ? "device" : "control", excerpt(id));
  return out;
}

/// A condition over time: false before the first turn, if it does not hold at the start.
struct Condition {
  bool at_start = false;
  std::vector<double> turns_s;
};

/// The state that a condition gives: the other one than at the start while it holds, and for ever
/// once it has held if it latches. FDS evaluates it in its first step, not before.
FdsCourse state_of(const Condition& condition, bool at_start, bool latches) {
  FdsCourse out;
  out.at_start = at_start;
  if (condition.at_start) out.turns_s.push_back(0);
  if (latches && condition.at_start) return out;
  out.turns_s.insert(out.turns_s.end(), condition.turns_s.begin(), condition.turns_s.end());
  if (latches && out.turns_s.size() > 1) out.turns_s.resize(1);
  return out;
}

/// Whether a number of states hold, over time.
Condition combined(const std::vector<FdsCourse>& inputs, const std::function<bool(size_t)>& holds) {
  std::vector<std::pair<double, size_t>> turns;
  std::vector<uint8_t> now;
  size_t count = 0;
  for (size_t i = 0; i < inputs.size(); ++i) {
    now.push_back(inputs[i].at_start ? 1 : 0);
    count += now.back();
    for (const double t : inputs[i].turns_s) turns.emplace_back(t, i);
  }
  std::sort(turns.begin(), turns.end());
  Condition out;
  bool state = out.at_start = holds(count);
  for (size_t i = 0; i < turns.size(); ++i) {
    uint8_t& one = now[turns[i].second];
    one = one == 0 ? 1 : 0;
    count += one != 0 ? 1 : static_cast<size_t>(-1);
    const bool same_time = i + 1 < turns.size() && turns[i + 1].first == turns[i].first;
    if (same_time || holds(count) == state) continue;
    state = !state;
    out.turns_s.push_back(turns[i].first);
  }
  return out;
}

/// When a ramp of the time is above zero: linear between its points, constant outside.
Condition above_zero(std::vector<std::pair<double, double>> points) {
  std::stable_sort(points.begin(), points.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  Condition out;
  // At time 0, where a run begins.
  double before_s = 0, before = points.front().second;
  for (size_t i = 0; i < points.size() && points[i].first <= 0; ++i) {
    before = points[i].second;
    if (i + 1 < points.size() && points[i + 1].first > 0)
      before += (points[i + 1].second - before) * -points[i].first /
                (points[i + 1].first - points[i].first);
  }
  bool state = out.at_start = before > 0;
  for (const auto& [at_s, value] : points) {
    if (at_s <= 0) continue;
    if (const bool after = value > 0; after != state) {
      state = after;
      // Up, it is above zero once it has left it; down, until it reaches it.
      const double share = before == value ? 0 : before / (before - value);
      out.turns_s.push_back(before_s + std::clamp(share, 0.0, 1.0) * (at_s - before_s));
    }
    before_s = at_s;
    before = value;
  }
  return out;
}

}  // namespace

void Drivers::add_device(GroupKeys& keys) {
  Device one;
  one.at_start = keys.flag("INITIAL_STATE", false);
  one.latches = keys.flag("LATCH", true);
  one.rises = keys.number("TRIP_DIRECTION", 1) > 0;
  if (keys.has("SETPOINT")) one.setpoint = keys.number("SETPOINT", 0);
  one.is_clock = keys.text("QUANTITY") == "TIME";
  for (const char* key : {"CONVERSION_FACTOR", "CONVERSION_ADDEND", "DELAY", "CTRL_ID", "DEVC_ID"})
    one.is_clock = one.is_clock && !keys.has(key);
  devices_[keys.text("ID")] = one;
}

void Drivers::add_control(GroupKeys& keys) {
  Control one;
  one.function = keys.text("FUNCTION_TYPE");
  one.inputs = keys.texts("INPUT_ID");
  one.ramp = keys.text("RAMP_ID");
  one.delay_s = keys.number("DELAY", 0);
  one.count = keys.integer("N", 1);
  one.at_start = keys.flag("INITIAL_STATE", false);
  one.latches = keys.flag("LATCH", one.function != "CUSTOM");
  controls_[keys.text("ID")] = one;
}

std::optional<std::string> Drivers::add_ramp(GroupKeys& keys) {
  // Only ramps of the clock are evaluated, and those have both numbers.
  const std::string id = keys.text("ID");
  Ramp& ramp = ramps_[id];
  if (ramp.is_too_long) return std::nullopt;
  ramp.points.emplace_back(keys.number("T", 0), keys.number("F", 0));
  if (ramp.points.size() <= limits::turns) return std::nullopt;
  ramp.is_too_long = true;
  ramp.points.clear();
  return fmt::format(
      "line {}: the ramp \"{}\" has more than {} points and is not read: what it drives stays as "
      "at the start",
      keys.line(), excerpt(id), limits::turns);
}

FdsCourse Drivers::course_of(const Device& device, const std::string& id) const {
  if (!device.is_clock || !device.setpoint) return driven(true, id, device.at_start);
  Condition passed;
  if (device.rises) {
    passed.turns_s = {*device.setpoint};
  } else {
    passed.at_start = *device.setpoint > 0;
    if (passed.at_start) passed.turns_s = {*device.setpoint};
  }
  return state_of(passed, device.at_start, device.latches);
}

std::optional<FdsCourse> Drivers::input(const std::string& id) {
  for (const bool is_device : {true, false})
    if (auto one = course(is_device, id)) return one;
  return std::nullopt;
}

/// The courses of all inputs; returned is what the control is instead, where one is driven.
std::optional<FdsCourse> Drivers::courses_of_inputs(const Control& control, const std::string& id,
                                                    std::vector<FdsCourse>& out) {
  size_t turns = 0;
  for (const std::string& name : control.inputs) {
    auto one = input(name);
    if (!one || !one->driven_by.empty()) return driven(false, id, control.at_start);
    turns += one->turns_s.size();
    if (turns > limits::turns) return driven(false, id, control.at_start);
    out.push_back(std::move(*one));
  }
  if (out.empty()) return driven(false, id, control.at_start);
  return std::nullopt;
}

FdsCourse Drivers::course_of(const Control& control, const std::string& id) {
  if (control.function == "CUSTOM") {
    const auto device =
        control.inputs.empty() ? devices_.end() : devices_.find(control.inputs.front());
    const auto ramp = ramps_.find(control.ramp);
    if (device == devices_.end() || !device->second.is_clock || ramp == ramps_.end() ||
        ramp->second.is_too_long)
      return driven(false, id, control.at_start);
    return state_of(above_zero(ramp->second.points), control.at_start, control.latches);
  }
  std::vector<FdsCourse> inputs;
  if (auto instead = courses_of_inputs(control, id, inputs)) return *instead;
  const size_t all = inputs.size();
  const auto wanted = static_cast<size_t>(std::max(control.count, 0));
  const auto gate = [&](const std::function<bool(size_t)>& holds) {
    return state_of(combined(inputs, holds), control.at_start, control.latches);
  };
  if (control.function == "ALL") return gate([&](size_t n) { return n == all; });
  if (control.function == "ANY") return gate([](size_t n) { return n > 0; });
  if (control.function == "ONLY") return gate([&](size_t n) { return n == wanted; });
  if (control.function == "AT_LEAST") return gate([&](size_t n) { return n >= wanted; });
  if (control.function == "TIME_DELAY" && all == 1) {
    // Every change of the input is followed by one of the control.
    Condition late;
    for (const double t : inputs.front().turns_s) late.turns_s.push_back(t + control.delay_s);
    return state_of(late, control.at_start, control.latches);
  }
  return driven(false, id, control.at_start);
}

std::optional<FdsCourse> Drivers::course(bool is_device, const std::string& id) {
  if (is_device) {
    const auto at = devices_.find(id);
    if (at == devices_.end()) return std::nullopt;
    return course_of(at->second, id);
  }
  const auto at = controls_.find(id);
  if (at == controls_.end()) return std::nullopt;
  const auto known = known_.find(id);
  if (known != known_.end()) return known->second;
  // Controls that read each other in a circle are driven by themselves.
  if (depth_ >= limits::depth) return driven(false, id, at->second.at_start);
  ++depth_;
  known_[id] = driven(false, id, at->second.at_start);
  FdsCourse out = course_of(at->second, id);
  --depth_;
  known_[id] = out;
  return out;
}

}  // namespace luxodus::fds_input
