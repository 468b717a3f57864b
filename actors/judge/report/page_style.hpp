// Style sheet of a report for screen and paper. Constant data; any thread.
#pragma once

namespace luxodus {

/// CSS without what depends on the report: paper size and margin texts.
extern const char* const report_style;

}  // namespace luxodus
