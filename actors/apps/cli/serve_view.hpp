// Serves the live view of a scene until Ctrl-C or until tracing fails. One thread.
#pragma once

#include "actors/apps/view/view_hub.hpp"
#include "actors/apps/view/view_server.hpp"
#include "runtime/core/result.hpp"

namespace luxodus::cli {

/// Prints the address of the page. Unless it is local, a token is made, which the page then
/// requires. `fault`: the failure of tracing, which ends the view. Errors: that failure; a pack; an
/// invalid address, a port in use; a folder that cannot be written.
Result<void> serve_view(std::shared_ptr<const SceneDescription> scene, HttpAddress server,
                        const HubOptions& options,
                        const std::function<std::optional<Problem>()>& fault = {});

}  // namespace luxodus::cli
