// The files of a run in its folder: their names, which may be replaced, and which the next run
// removes. Only files that the folder's own result.json names are ever removed or replaced; all
// others belong to somebody else. Any thread, but only one run at a time may use a folder: see
// actors/results/formats/output_folder.hpp.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "actors/results/formats/output_folder.hpp"
#include "scenes/light/world/description.hpp"

namespace luxodus {

namespace limits {
/// Largest result.json that is read back [bytes]: 1 GiB, far above a million surfaces in 40 bands.
inline constexpr uint64_t max_result_bytes = uint64_t{1} << 30;
}  // namespace limits

/// The files of each plane and each camera, without folder and ending, in the scene's order: the
/// scene's names without characters that are special to a shell or another system.
struct ResultNames {
  std::vector<std::string> planes, views;
};
ResultNames result_names(const SceneDescription& scene);

/// Whether pictures of a plane, and a luminance map of a camera, are written: up to a limit of
/// cells and pixels.
bool is_drawn(const PlaneMeasure& plane);
bool is_mapped(const Camera& camera);

/// Paths of the files of one plane and of one camera, within the folder of the run.
std::vector<std::string> files_of_plane(const SceneDescription& scene, size_t plane);
std::vector<std::string> files_of_view(const SceneDescription& scene, size_t camera);

/// All files that a run writes; without `views` no pictures.
OutputPlan run_output(const SceneDescription& scene, bool views);

/// Removes the maps and pictures of an earlier run: those that result.json names, patches.vtp and
/// volume.vti. Keeps flux.lux and result.json, which the next run replaces atomically. A folder
/// without a result of ours is left unchanged.
/// Errors: a file that cannot be removed, with the system's reason.
Result<void> remove_old_maps(const std::filesystem::path& folder);

/// Errors: a file to be written exists already and is not a run's: the folder's result.json does
/// not name it, or is not the result of a run.
Result<void> refuse_foreign_files(const std::filesystem::path& folder, const OutputPlan& plan);

}  // namespace luxodus
