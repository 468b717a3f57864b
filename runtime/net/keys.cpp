#include "runtime/net/keys.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <string_view>

#include "runtime/core/file_descriptor.hpp"
#include "runtime/core/regular_file.hpp"

namespace luxodus {

namespace {

namespace fs = std::filesystem;

/// Longer than any key file; longer files are no keys.
constexpr size_t max_file_bytes = 256;
constexpr size_t key_characters = 40;

bool write_all(int descriptor, std::string_view text) {
  while (!text.empty()) {
    const ssize_t n = ::write(descriptor, text.data(), text.size());
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return false;
    text.remove_prefix(static_cast<size_t>(n));
  }
  return true;
}

/// Writes a temporary file, then links the name to it: link() fails if the name exists.
Result<std::string> write_new(const fs::path& path, const std::string& text, mode_t mode) {
  fs::path beside = path;
  beside += ".new." + std::to_string(::getpid());
  const FileDescriptor file(::open(beside.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, mode));
  if (!file.valid()) return system_problem(beside, "cannot be written", errno);
  const bool written = write_all(file.number(), text) && ::fsync(file.number()) == 0;
  const bool named = written && ::link(beside.c_str(), path.c_str()) == 0;
  const int failure = errno;
  ::unlink(beside.c_str());
  if (named) return text;
  errno = failure;
  if (failure == EEXIST)
    return problem_in(path,
                      "is there already; a node may depend on that key, so move it away first");
  return system_problem(path, "cannot be written", errno);
}

/// The first word in the file that has a key's length. `secret`: reject a file that others may
/// read.
Result<std::string> read_key(const fs::path& path, bool secret) {
  const auto file = open_regular_file(path);
  if (!file) return file.problem();
  struct stat state {};
  if (::fstat(file->descriptor.number(), &state) != 0)
    return system_problem(path, "cannot be read", errno);
  if (secret && (state.st_mode & (S_IRWXG | S_IRWXO)) != 0)
    return problem_in(path,
                      "holds a secret key that others may read: chmod 600 it, and if they may "
                      "have read it, make a new one");
  std::array<char, max_file_bytes + 1> text;
  const ssize_t n = ::read(file->descriptor.number(), text.data(), text.size());
  if (n < 0) return system_problem(path, "cannot be read", errno);
  if (static_cast<size_t>(n) > max_file_bytes) return problem_in(path, "is too long for a key");
  std::string_view key(text.data(), static_cast<size_t>(n));
  while (!key.empty() && (key.back() == '\n' || key.back() == '\r' || key.back() == ' '))
    key.remove_suffix(1);
  if (key.size() != key_characters)
    return problem_in(path,
                      "holds no key: 40 characters in one line, as `luxodus keygen` writes it");
  return std::string(key);
}

}  // namespace

Result<KeyPair> write_keys(const KeyPair& keys, const fs::path& path) {
  fs::path open_path = path;
  open_path += ".pub";
  const auto secret = write_new(path, keys.secret_key + "\n", 0600);
  if (!secret) return secret.problem();
  const auto open = write_new(open_path, keys.public_key + "\n", 0644);
  if (!open) {
    ::unlink(path.c_str());
    return open.problem();
  }
  return keys;
}

Result<KeyPair> read_keys(const fs::path& path) {
  auto secret = read_key(path, true);
  if (!secret) return secret.problem();
  auto open = public_key_of(secret.value());
  if (!open) return problem_in(path, open.problem());
  return KeyPair{std::move(open).value(), std::move(secret).value()};
}

Result<std::string> read_public_key(const fs::path& path) {
  return read_key(path, false);
}

}  // namespace luxodus
