// &DEVC, &CTRL and &RAMP: when the state of a device or a control changes, as far as it follows
// from the clock alone. What depends on the fire is named instead. One thread.
//
// Semantics: FDS User's Guide (NIST SP 1019), "Control function logic", and FDS itself.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "scenes/formats/fds_input/fds_input.hpp"
#include "scenes/formats/fds_input/group_keys.hpp"

namespace luxodus::fds_input {

namespace limits {
/// Changes of a state over time and points of a ramp; controls that read each other.
inline constexpr size_t turns = 10'000;
inline constexpr int depth = 100;
}  // namespace limits

class Drivers {
 public:
  void add_device(GroupKeys& keys);
  void add_control(GroupKeys& keys);
  /// One point of a ramp. Returns a note if the ramp has become longer than limits::turns: it is
  /// not read then, and a control that it drives counts as driven by the fire.
  std::optional<std::string> add_ramp(GroupKeys& keys);

  /// The course of a device or a control; nothing where there is none with this ID. Requires: all
  /// groups are added.
  std::optional<FdsCourse> course(bool is_device, const std::string& id);

 private:
  struct Device {
    bool is_clock = false;  // measures time, and nothing else changes its value
    std::optional<double> setpoint;
    bool rises = true, latches = true, at_start = false;
  };
  struct Control {
    std::string function;
    std::vector<std::string> inputs;
    std::string ramp;
    double delay_s = 0;
    int count = 1;  // N of AT_LEAST and ONLY
    bool latches = true, at_start = false;
  };
  struct Ramp {
    std::vector<std::pair<double, double>> points;  // times [s] and values
    bool is_too_long = false;
  };

  FdsCourse course_of(const Device& device, const std::string& id) const;
  FdsCourse course_of(const Control& control, const std::string& id);
  std::optional<FdsCourse> courses_of_inputs(const Control& control, const std::string& id,
                                             std::vector<FdsCourse>& out);
  std::optional<FdsCourse> input(const std::string& id);

  std::map<std::string, Device> devices_;
  std::map<std::string, Control> controls_;
  std::map<std::string, Ramp> ramps_;
  std::map<std::string, FdsCourse> known_;  // of controls
  int depth_ = 0;
};

}  // namespace luxodus::fds_input
