// HTTP and WebSocket for a live view, by Boost.Beast: the page, the socket, and nothing else. No
// path of the machine is served. What comes in is bounded and timed; a viewer that does not read is
// let go. Thread rule: run() serves on the calling thread; post() may be called from
// any.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "runtime/core/result.hpp"

namespace luxodus {

class ViewHub;

namespace limits {
inline constexpr size_t viewers = 32;
/// Left unread by a viewer before it is dropped [bytes]; light that newer light replaces is not
/// counted.
inline constexpr size_t viewer_unread_bytes = 256 << 20;
inline constexpr int viewer_messages_per_s = 50;
}  // namespace limits

struct ServerOptions {
  std::string address = "127.0.0.1";
  uint16_t port = 8080;  // 0: any that is free
  std::string token;     // demanded in the address of page and socket; "": none
  /// Names under which the page may be asked for, beside the address: see view_host.hpp.
  std::vector<std::string> allowed_hosts = {};
};

class ViewServer {
 public:
  /// Listens at once. Errors: an address that is none, a port that is taken.
  static Result<std::unique_ptr<ViewServer>> listen(const ServerOptions& options);
  ~ViewServer();
  ViewServer(const ViewServer&) = delete;
  ViewServer& operator=(const ViewServer&) = delete;

  uint16_t port() const;
  /// Connections that could not be accepted, as where descriptors have run out. Any thread.
  uint64_t accepts_failed() const;
  /// Serves until `ends()`, asked often on the calling thread. Requires: `hub` outlives the call.
  void run(ViewHub& hub, const std::function<bool()>& ends);
  /// Runs a function on the thread of run().
  void post(std::function<void()> function);

 private:
  class Implementation;
  explicit ViewServer(std::unique_ptr<Implementation> implementation);
  std::unique_ptr<Implementation> implementation_;
};

/// The page, as it was built into the program.
std::string_view view_page();

}  // namespace luxodus
