// How a report looks, on a screen and on paper. Constant data; any thread.
#pragma once

namespace luxodus {

/// CSS, but for what depends on the report: the size of the paper and what its margins say.
extern const char* const report_style;

}  // namespace luxodus
