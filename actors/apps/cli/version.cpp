#include "actors/apps/cli/version.hpp"

// Defined in a source that the build rewrites if the commit has changed: see commit.cmake.
extern const char* const luxodus_commit;

namespace luxodus::cli {

const Build build{LUX_VERSION, luxodus_commit, LUX_BUILD, LUX_ARCH, LUX_BUILT_FOR, LUX_PACKAGES};

}  // namespace luxodus::cli
