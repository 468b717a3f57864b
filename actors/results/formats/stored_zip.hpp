// ZIP archives whose files are stored as they are, for formats that are ZIP archives of small
// texts. Equal content gives equal bytes: files are dated to 1 January 1980. Pure function; any
// thread.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace luxodus {

/// Requires: names that are plain ASCII, contents and archive below 4 GiB, fewer than 65 536 files.
std::string stored_zip(const std::vector<std::pair<std::string, std::string>>& files);

}  // namespace luxodus
