#include "runtime/core/result.hpp"

#include <algorithm>
#include <cerrno>
#include <system_error>

#include "runtime/core/printable.hpp"

namespace luxodus {

std::string Problem::text() const {
  std::string out = where.file;
  if (where.line > 0) out += ":" + std::to_string(where.line);
  return printable(out.empty() ? what : out + ": " + what);
}

ProblemKind Problems::kind() const {
  const auto is_input = [](const Problem& p) {
    return p.kind == ProblemKind::bad_input || p.kind == ProblemKind::not_found;
  };
  return std::any_of(list_.begin(), list_.end(), is_input) ? ProblemKind::bad_input
                                                           : list_.front().kind;
}

ProblemKind kind_of_errno(int error) {
  switch (error) {
    case ENOENT:
    case ENOTDIR:
      return ProblemKind::not_found;
    // Something of this name is there, but not what was meant: a folder, a link, a name too long.
    case EISDIR:
    case ELOOP:
    case ENAMETOOLONG:
    case EEXIST:
    case ENOTEMPTY:
      return ProblemKind::bad_input;
    case EACCES:
    case EPERM:
    case EROFS:
    case EBUSY:
    case ETXTBSY:
    case EADDRINUSE:
    case EADDRNOTAVAIL:
      return ProblemKind::refused;
    case ENOSPC:
    case EDQUOT:
    case EFBIG:
    case ENOMEM:
    case EMFILE:
    case ENFILE:
    case EAGAIN:
      return ProblemKind::no_room;
    case ECONNREFUSED:
    case ECONNRESET:
    case ECONNABORTED:
    case EHOSTUNREACH:
    case ENETUNREACH:
    case EPIPE:
    case ETIMEDOUT:
      return ProblemKind::lost_peer;
    default:
      return ProblemKind::system;
  }
}

Problem system_problem(std::string file, std::string what, int error) {
  return problem_in(std::move(file), what + ": " + std::generic_category().message(error),
                    kind_of_errno(error));
}

}  // namespace luxodus
