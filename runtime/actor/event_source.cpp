#include "runtime/actor/event_source.hpp"

#include <poll.h>
#include <sys/eventfd.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <ctime>
#include <stdexcept>
#include <string>

namespace luxodus {

QuietSource::QuietSource(const Clock& clock)
    : clock_(clock), event_(eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK)) {
  if (event_ < 0)
    throw std::runtime_error(std::string("cannot make an eventfd: ") + std::strerror(errno));
}

QuietSource::~QuietSource() {
  close(event_);
}

void QuietSource::wait_until(Nanoseconds deadline) {
  // One day at most: `never` does not fit a timespec, and a spurious wake-up is harmless.
  const Nanoseconds left =
      std::clamp<Nanoseconds>(deadline - clock_.now(), 0, seconds(24 * 60 * 60));
  const timespec wait{left / seconds(1), left % seconds(1)};
  pollfd watched{event_, POLLIN, 0};
  if (ppoll(&watched, 1, &wait, nullptr) <= 0) return;
  eventfd_t wakes = 0;
  eventfd_read(event_, &wakes);
}

void QuietSource::wake() noexcept {
  eventfd_write(event_, 1);
}

}  // namespace luxodus
