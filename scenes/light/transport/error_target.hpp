// Error targets: the words of a scene file or command line that name the results whose error ends a
// run, resolved in a compiled scene. Pure; any thread.
#pragma once

#include <string>
#include <vector>

#include "scenes/light/transport/compiled_scene.hpp"

namespace luxodus {

/// The words: "all" (or none) for planes, probes and signs, or surfaces if a scene has none of
/// these; "planes", "cells" (of planes), "probes", "signs", "surfaces", "patches"; "plane NAME",
/// "cells NAME" (of that plane), "probe NAME", "sign NAME". Errors: another word, a name that the
/// scene does not have, a kind of which it has none.
Result<ErrorTarget> error_target_of(const CompiledScene& scene,
                                    const std::vector<std::string>& words);

}  // namespace luxodus
