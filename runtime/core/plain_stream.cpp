#include "runtime/core/plain_stream.hpp"

#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

namespace luxodus {

namespace {

/// Buffer size: a system call for each number would cost more than all the rest.
constexpr size_t block_bytes = size_t{1} << 16;

}  // namespace

// ---- writing -----------------------------------------------------------------------------------

void PlainWriter::add(std::span<const std::byte> bytes) {
  while (!bytes.empty() && !failed_) {
    const size_t now = std::min(bytes.size(), block_bytes);
    held_.insert(held_.end(), bytes.begin(), bytes.begin() + static_cast<ptrdiff_t>(now));
    bytes = bytes.subspan(now);
    if (held_.size() >= block_bytes) flush();
  }
}

void PlainWriter::put(const Problem& problem) {
  put(problem.where.file);
  put(problem.where.line);
  put(problem.what);
  put(static_cast<uint8_t>(problem.kind));
}

bool PlainWriter::flush() {
  size_t done = 0;
  while (done < held_.size() && !failed_) {
    const ssize_t n = ::write(descriptor_, held_.data() + done, held_.size() - done);
    if (n < 0 && errno == EINTR) continue;
    failed_ = n <= 0;
    if (n > 0) done += static_cast<size_t>(n);
  }
  held_.clear();
  return !failed_;
}

// ---- reading -----------------------------------------------------------------------------------

PlainReader::PlainReader(FileDescriptor file) : file_(std::move(file)) {
  struct stat about {};
  if (file_.valid() && ::fstat(file_.number(), &about) == 0)
    left_ = static_cast<uint64_t>(std::max<off_t>(about.st_size, 0));
}

bool PlainReader::get(Problem& problem) {
  uint8_t kind = 0;
  if (!get(problem.where.file) || !get(problem.where.line) || !get(problem.what) || !get(kind))
    return false;
  if (kind > static_cast<uint8_t>(ProblemKind::bug)) return fail();
  problem.kind = static_cast<ProblemKind>(kind);
  return true;
}

bool PlainReader::get(std::string& text) {
  std::vector<char> read;
  if (!get(read)) return false;
  text.assign(read.begin(), read.end());
  return true;
}

bool PlainReader::fail() {
  left_ = 0;
  return false;
}

bool PlainReader::take(std::span<std::byte> to) {
  if (to.size() > left_) return fail();
  left_ -= to.size();
  while (!to.empty()) {
    if (given_ == held_.size()) {
      held_.resize(block_bytes);
      const ssize_t n =
          ::pread(file_.number(), held_.data(), held_.size(), static_cast<off_t>(at_));
      held_.resize(static_cast<size_t>(std::max<ssize_t>(n, 0)));
      given_ = 0;
      if (n < 0 && errno == EINTR) continue;
      if (n <= 0) return fail();
      at_ += static_cast<uint64_t>(n);
    }
    const size_t now = std::min(to.size(), held_.size() - given_);
    std::memcpy(to.data(), held_.data() + given_, now);
    given_ += now;
    to = to.subspan(now);
  }
  return true;
}

}  // namespace luxodus
