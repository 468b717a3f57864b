#include "runtime/core/result.hpp"

#include "runtime/core/printable.hpp"

namespace luxodus {

std::string Problem::text() const {
  std::string out = where.file;
  if (where.line > 0) out += ":" + std::to_string(where.line);
  return printable(out.empty() ? what : out + ": " + what);
}

}  // namespace luxodus
