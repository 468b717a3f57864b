// Makes the record of a design. Pure functions; any thread.
#pragma once

#include "actors/judge/design/design_record.hpp"

namespace luxodus {

/// `version`: of this program. Requires: a result with a layout.
DesignRecord record_of(const SceneDescription& scene, const DesignResult& result,
                       const std::string& version);
SmokeRecord record_of(const SmokeStage& stage);

/// File of a layout, relative to the folder of the design; "" if the layout has no file of its own.
std::string file_of(const JudgedLayout& layout);

}  // namespace luxodus
