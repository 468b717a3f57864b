#include "actors/apps/view/view_server.hpp"

#include "actors/apps/view/page_message.hpp"
#include "actors/apps/view/view_hub.hpp"

namespace luxodus {

namespace {

/// The page includes its script and style, and has a stricter policy of its own.
constexpr const char* page_policy =
    "default-src 'none'; script-src 'unsafe-inline' blob:; style-src 'unsafe-inline'; "
    "img-src data: blob:; connect-src 'self'; worker-src blob:; frame-ancestors 'none'";

/// One viewer's socket, with the interface for the hub.
class SocketViewer final : public Viewer, public SocketListener {
 public:
  SocketViewer(WebSocket& socket, ViewHub& hub) : socket_(socket), hub_(hub) { hub_.joins(*this); }
  ~SocketViewer() override { hub_.leaves(*this); }

  void send_text(const LiveFrame& text) override {
    socket_.send(text, WebSocket::Kind::text, false);
  }
  void send_binary(const LiveFrame& frame, bool light) override {
    socket_.send(frame, WebSocket::Kind::binary, light);
  }
  std::vector<LiveFrame> take_light() override { return socket_.take_back(); }
  void hears(std::string_view message) override { hub_.says(*this, message); }

 private:
  WebSocket& socket_;
  ViewHub& hub_;
};

}  // namespace

Result<std::unique_ptr<ViewServer>> ViewServer::listen(const HttpAddress& at) {
  std::unique_ptr<ViewServer> view(new ViewServer);
  HttpSite site;
  site.page = [self = view.get()](std::string_view path) -> std::optional<HttpPage> {
    if (path == "/backdrops.json" && self->hub_ != nullptr)
      return HttpPage{self->hub_->backdrops(), "application/json"};
    if (path == "/library.json" && self->hub_ != nullptr)
      return HttpPage{self->hub_->library(), "application/json"};
    if (path == "/people.json" && self->hub_ != nullptr)
      return HttpPage{self->hub_->people(), "application/json"};
    if (path != "/") return std::nullopt;
    return HttpPage{std::string(view_page()), "text/html; charset=utf-8", page_policy};
  };
  site.socket_path = "/live";
  site.opened = [self = view.get()](WebSocket& socket) {
    return std::make_unique<SocketViewer>(socket, *self->hub_);
  };
  site.limits = {limits::viewers, limits::page_message_bytes, limits::viewer_messages_per_s,
                 limits::viewer_unread_bytes};
  auto server = HttpServer::listen(at, std::move(site));
  if (!server) return server.problem();
  view->server_ = std::move(server).value();
  return view;
}

void ViewServer::run(ViewHub& hub, const std::function<bool()>& ends) {
  hub_ = &hub;
  server_->run(ends);
  hub_ = nullptr;
}

}  // namespace luxodus
