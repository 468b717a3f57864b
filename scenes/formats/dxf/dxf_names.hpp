// Names in a DXF drawing as UTF-8. Drawings up to release 2004 are written in the code page that
// their header names, later ones in UTF-8; both may write letters as \U+XXXX, and of East Asian
// pages as \M+NXXXX. One thread per object.
#pragma once

#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace luxodus {

class DxfNames {
 public:
  /// `version` and `code_page`: $ACADVER and $DWGCODEPAGE of the header, "" where they are missing.
  DxfNames(std::string_view version, std::string_view code_page);

  /// The name as UTF-8. Bytes that the code page does not have become the letters of ISO 8859-1, so
  /// that different names stay different.
  const std::string& utf8(std::string_view raw);

  /// What could not be read as the header says.
  std::vector<std::string> notes() const;

 private:
  std::string decoded(std::string_view raw);

  std::string page_;             // as iconv names it; "" for one that is not known
  std::string page_told_;        // as the header does
  std::set<std::string> wrong_;  // names that are not of their page
  std::map<std::string, std::string, std::less<>> known_;
};

}  // namespace luxodus
