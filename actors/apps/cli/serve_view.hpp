// Serves the live view of a scene until Ctrl-C or until tracing fails. One thread.
#pragma once

#include "actors/apps/view/view_hub.hpp"
#include "actors/apps/view/view_server.hpp"
#include "runtime/core/result.hpp"

namespace luxodus::cli {

/// Reads the states of a live view at other times. Empty for a scene without a clock, and where
/// people stand as bodies: the page has the surfaces of one state.
SceneAtTime times_of_view(const std::string& file, const SceneDescription& scene);

/// The people whom a live view shows walking, as people_json: those of the scene, or of
/// `trajectories`, if it is given. Nobody, where they stand as bodies. Errors: as people_shown and
/// people_json; `trajectories` where people stand as bodies.
Result<std::string> people_of_view(const SceneDescription& scene, const std::string& file,
                                   const std::string& trajectories = "");

/// Prints where the page is. Beyond this machine it makes a token, which the page then demands.
/// `goes_on`: an error where whoever traces cannot, which ends the view. Errors: that; a pack; an
/// address that is none, a port that is taken; a folder that nothing can be saved in.
Result<void> serve_view(std::shared_ptr<const SceneDescription> scene, HttpAddress server,
                        const HubOptions& options,
                        const std::function<Result<void>()>& goes_on = {});

}  // namespace luxodus::cli
