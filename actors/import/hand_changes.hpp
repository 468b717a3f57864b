// Keeps what a person has changed in a file that an import writes anew: tables that bear the
// GlobalId of something in the model, compared with a copy of the file as it was last written. Pure
// functions; any thread.
#pragma once

#include <string>
#include <vector>

namespace luxodus {

struct HandChanges {
  std::string text;                // to be written
  std::vector<std::string> notes;  // what was kept, left out again, or is lost
};

/// `fresh`: as the import makes it; `now`: as the file is; `written`: as it was last written. A
/// table of `fresh` that differs between `now` and `written` is that of `now`; one that `now` lacks
/// is left out. Changes to other tables, which bear no GlobalId or are no longer in `fresh`, are
/// not kept; a note names each table.
HandChanges with_hand_changes(const std::string& fresh, const std::string& now,
                              const std::string& written);

}  // namespace luxodus
