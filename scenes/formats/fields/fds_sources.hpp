// Chooses from which files of a fire simulation its smoke is read, and which frames: the sum of all
// species that absorb light, each in the best form that it has at the time. Reads files; any
// thread.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "scenes/formats/fields/fds.hpp"
#include "scenes/formats/fields/fds_case.hpp"
#include "scenes/formats/fields/fds_frames.hpp"

namespace luxodus::fds {

enum class Form { cell_slice, node_slice, plot, smoke };

/// One output in one form, over all meshes.
struct Series {
  Form form = Form::cell_slice;
  Output output;
  FireSource source = FireSource::cell_extinction;
  std::vector<FrameFiles> meshes;
};

/// Series that are read together, with the chosen frame of each mesh.
struct Picked {
  std::vector<Series> series;
  std::vector<std::vector<Frame>> frames;  // by series and mesh
  double time_s = 0;
  double first_s = 0, last_s = 0;
  size_t common = 0;                         // frames that all meshes of all series have
  size_t partial = 0;                        // between the first and the last: not in all of them
  std::optional<double> previous_s, next_s;  // of the common ones, around time_s
  std::optional<double> step_s;              // the longest of the usual times from frame to frame
};

/// Species that absorb light, soot first: those whose extinction, optical density or visibility any
/// file holds, those with a mass extinction, and soot. With a mass extinction stated, the only
/// species of which there is a density, too.
std::vector<std::string> smokes_of(const Case& fire, const FireOptions& options);

/// The mass extinction coefficient by which FDS computes the extinction of a species [m2/kg]; none
/// where it is not known.
std::optional<double> mass_extinction_of_fds(const Case& fire, const std::string& species);

/// The best files for smoke at a time, one series for each species that absorbs light.
/// Errors: see read_fire.
Result<Picked> choose_smoke(const Case& fire, const FireOptions& options);

/// A time, or the first or last frame of smoke where these do not reach it; nothing where there is
/// no smoke. Errors: damaged files.
Result<std::optional<double>> smoke_time_near(const Case& fire, double at_s);

/// HRRPUV within fire_window_s of a time; nothing where there is none. Errors: damaged files.
Result<std::optional<Picked>> choose_heat(const Case& fire, double time_s);

}  // namespace luxodus::fds
