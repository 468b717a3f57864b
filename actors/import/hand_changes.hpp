// Keeps what a person has changed in a file that an import writes anew: tables that bear the
// GlobalId of something in the model, held against a copy of the file as it was last written. Pure
// functions; any thread.
#pragma once

#include <string>
#include <vector>

namespace luxodus {

struct HandChanges {
  std::string text;                // to be written
  std::vector<std::string> notes;  // what was kept, or left out again
};

/// `fresh`: as the import makes it; `now`: as the file is; `written`: as it was last written. A
/// table of `fresh` that differs between `now` and `written` is that of `now`; one that `now` lacks
/// is left out.
HandChanges with_hand_changes(const std::string& fresh, const std::string& now,
                              const std::string& written);

}  // namespace luxodus
