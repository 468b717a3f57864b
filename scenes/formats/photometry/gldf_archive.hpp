// Reads untrusted ZIP archives from memory, within limits. Internal to the reading of GLDF and L3D;
// only gldf_archive.cpp includes libzip. One thread.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/core/result.hpp"

struct zip;

namespace luxodus {

class GldfArchive {
 public:
  /// `bytes` outlive the archive; `file` and `kind` ("GLDF container") name it in messages.
  /// Errors: not a ZIP, too many entries, a name that leads out of the archive.
  static Result<GldfArchive> open(std::string_view bytes, const std::string& file,
                                  const char* kind);

  /// Names of the entries, in the archive's order, as UTF-8.
  const std::vector<std::string>& names() const { return names_; }

  /// Packed size of an entry, as the archive states it; 0 where it does not.
  uint64_t packed_bytes(size_t entry) const;

  /// Unpacks an entry. A declared size is not trusted: unpacking stops at `max_bytes`.
  /// Errors: more bytes, encrypted, an unknown compression method, damaged.
  Result<std::string> read(size_t entry, uint64_t max_bytes) const;

 private:
  struct Closed {
    void operator()(struct zip* archive) const;
  };
  std::string file_;
  std::unique_ptr<struct zip, Closed> zip_;
  std::vector<std::string> names_;
};

}  // namespace luxodus
