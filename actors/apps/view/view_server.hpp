// Serves a live view over HTTP: its page, and the socket of each viewer. Listening and limits are
// those of runtime/http. Thread rule: run() serves on the calling thread; post() may be called from
// any.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>

#include "runtime/core/result.hpp"
#include "runtime/http/http_server.hpp"

namespace luxodus {

class ViewHub;

namespace limits {
inline constexpr size_t viewers = 32;
/// A viewer with more unread bytes is dropped; light that newer light replaces is not counted.
inline constexpr size_t viewer_unread_bytes = 256 << 20;
inline constexpr int viewer_messages_per_s = 50;
}  // namespace limits

class ViewServer {
 public:
  /// Listens at once. Errors: an invalid address, a port in use.
  static Result<std::unique_ptr<ViewServer>> listen(const HttpAddress& at);

  uint16_t port() const { return server_->port(); }
  /// Serves until `ends()`, which is called often on the calling thread. Requires: `hub` outlives
  /// the call.
  void run(ViewHub& hub, const std::function<bool()>& ends);
  /// Runs a function on the thread of run().
  void post(std::function<void()> function) { server_->post(std::move(function)); }

 private:
  ViewServer() = default;

  ViewHub* hub_ = nullptr;  // null except in run()
  std::unique_ptr<HttpServer> server_;
};

/// The page, as it was built into the program.
std::string_view view_page();

}  // namespace luxodus
