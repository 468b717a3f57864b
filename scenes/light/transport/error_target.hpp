// By what the error of a run is judged: words of a scene file or a command line, and what they
// stand for in a compiled scene. Pure.
#pragma once

#include <string>
#include <vector>

#include "scenes/light/transport/compiled_scene.hpp"

namespace luxodus {

/// The words: "all" (or nothing) for planes, probes and signs, and surfaces where a scene has none
/// of these; "planes", "cells" (of planes), "probes", "signs", "surfaces", "patches"; "plane NAME",
/// "cells NAME" (of that plane), "probe NAME", "sign NAME". Errors: another word, a name that the
/// scene does not have, a kind that it has none of.
Result<ErrorTarget> error_target_of(const CompiledScene& scene,
                                    const std::vector<std::string>& words);

}  // namespace luxodus
