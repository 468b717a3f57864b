#include "actors/apps/cli/terminal.hpp"

#include <spdlog/pattern_formatter.h>
#include <spdlog/spdlog.h>
#include <unistd.h>

#include <memory>
#include <string>
#include <string_view>
#include <utility>

#include "runtime/core/printable.hpp"

namespace luxodus::cli {

namespace {

/// Control characters that are kept.
constexpr std::string_view layout = "\n\t";

/// The stream below, and the first byte of a character that a buffer has divided.
struct Below {
  FILE* stream;
  std::string cut;
};

bool pass_on(const Below& below, const std::string& text) {
  return std::fwrite(text.data(), 1, text.size(), below.stream) == text.size() &&
         std::fflush(below.stream) == 0;
}

/// A write function for fopencookie(3): takes all bytes, or returns 0 and sets errno.
ssize_t write_printable(void* cookie, const char* text, size_t size) noexcept {
  auto& below = *static_cast<Below*>(cookie);
  std::string whole = std::exchange(below.cut, {}) + std::string(text, size);
  if (!whole.empty() && whole.back() == '\xC2') {
    below.cut = whole.back();
    whole.pop_back();
  }
  return pass_on(below, printable(whole, layout)) ? static_cast<ssize_t>(size) : 0;
}

int close_printable(void* cookie) noexcept {
  const std::unique_ptr<Below> below(static_cast<Below*>(cookie));
  return pass_on(*below, below->cut) ? 0 : EOF;
}

/// Formats the message of a log line.
class PrintableMessage final : public spdlog::custom_flag_formatter {
 public:
  void format(const spdlog::details::log_msg& message, const std::tm&,
              spdlog::memory_buf_t& to) override {
    const std::string told = printable({message.payload.data(), message.payload.size()}, layout);
    to.append(told.data(), told.data() + told.size());
  }
  std::unique_ptr<custom_flag_formatter> clone() const override {
    return std::make_unique<PrintableMessage>();
  }
};

}  // namespace

FILE* printable_stream(FILE* below) {
  cookie_io_functions_t calls{};
  calls.write = write_printable;
  calls.close = close_printable;
  auto cookie = std::make_unique<Below>(Below{below, {}});
  FILE* made = ::fopencookie(cookie.get(), "w", calls);
  if (made != nullptr) cookie.release();  // now owned by the stream, until it is closed
  return made;
}

void guard_terminal() {
  if (FILE* guarded = printable_stream(stdout)) {
    // A terminal gets line buffering.
    if (::isatty(STDOUT_FILENO) != 0) std::setvbuf(guarded, nullptr, _IOLBF, BUFSIZ);
    stdout = guarded;
  }
  auto formatter = std::make_unique<spdlog::pattern_formatter>();
  formatter->add_flag<PrintableMessage>('*').set_pattern("%^%l%$ %*");
  spdlog::set_formatter(std::move(formatter));
}

}  // namespace luxodus::cli
