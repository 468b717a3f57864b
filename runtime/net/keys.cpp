#include "runtime/net/keys.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <string_view>

#include "runtime/core/regular_file.hpp"

namespace luxodus {

namespace {

namespace fs = std::filesystem;

/// Longer than any key's file; what is longer is no key.
constexpr size_t file_bytes_most = 256;
constexpr size_t key_characters = 40;

Problem trouble(const fs::path& path, const std::string& what) {
  return {{path.string(), 0}, what};
}
Problem system_trouble(const fs::path& path, const std::string& what) {
  return trouble(path, what + ": " + std::strerror(errno));
}

/// A descriptor that is closed at the end of its scope.
struct File {
  int descriptor;
  explicit File(int d) : descriptor(d) {}
  File(const File&) = delete;
  File& operator=(const File&) = delete;
  ~File() {
    if (descriptor >= 0) ::close(descriptor);
  }
};

bool write_all(int descriptor, std::string_view text) {
  while (!text.empty()) {
    const ssize_t n = ::write(descriptor, text.data(), text.size());
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return false;
    text.remove_prefix(static_cast<size_t>(n));
  }
  return true;
}

/// Writes beside the path, then links the name to it: link() fails where a file has that name.
Result<std::string> write_new(const fs::path& path, const std::string& text, mode_t mode) {
  fs::path beside = path;
  beside += ".new." + std::to_string(::getpid());
  const File file(::open(beside.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, mode));
  if (file.descriptor < 0) return system_trouble(beside, "cannot be written");
  const bool written = write_all(file.descriptor, text) && ::fsync(file.descriptor) == 0;
  const bool named = written && ::link(beside.c_str(), path.c_str()) == 0;
  const int failure = errno;
  ::unlink(beside.c_str());
  if (named) return text;
  errno = failure;
  if (failure == EEXIST)
    return trouble(path, "is there already; a node may depend on that key, so move it away first");
  return system_trouble(path, "cannot be written");
}

/// The first word of the file that has the length of a key. `secret`: refuse what others may read.
Result<std::string> read_key(const fs::path& path, bool secret) {
  const auto file = open_regular_file(path);
  if (!file) return file.problem();
  struct stat state {};
  if (::fstat(file->descriptor.number(), &state) != 0)
    return system_trouble(path, "cannot be read");
  if (secret && (state.st_mode & (S_IRWXG | S_IRWXO)) != 0)
    return trouble(path,
                   "holds a secret key that others may read: chmod 600 it, and if they may "
                   "have read it, make a new one");
  std::array<char, file_bytes_most + 1> text;
  const ssize_t n = ::read(file->descriptor.number(), text.data(), text.size());
  if (n < 0) return system_trouble(path, "cannot be read");
  if (static_cast<size_t>(n) > file_bytes_most) return trouble(path, "is too long for a key");
  std::string_view key(text.data(), static_cast<size_t>(n));
  while (!key.empty() && (key.back() == '\n' || key.back() == '\r' || key.back() == ' '))
    key.remove_suffix(1);
  if (key.size() != key_characters)
    return trouble(path, "holds no key: 40 characters in one line, as `luxodus keygen` writes it");
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
  if (!open) return trouble(path, open.problem().what);
  return KeyPair{std::move(open).value(), std::move(secret).value()};
}

Result<std::string> read_public_key(const fs::path& path) {
  return read_key(path, false);
}

}  // namespace luxodus
