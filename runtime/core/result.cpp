#include "runtime/core/result.hpp"

#include <system_error>

#include "runtime/core/printable.hpp"

namespace luxodus {

std::string Problem::text() const {
  std::string out = where.file;
  if (where.line > 0) out += ":" + std::to_string(where.line);
  return printable(out.empty() ? what : out + ": " + what);
}

Problem system_problem(std::string file, std::string what, int error) {
  return problem_in(std::move(file), what + ": " + std::generic_category().message(error));
}

}  // namespace luxodus
