#include "actors/view/view_server.hpp"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <boost/asio.hpp>
#include <boost/beast.hpp>
#include <chrono>
#include <deque>

#include "actors/view/view_host.hpp"
#include "actors/view/view_hub.hpp"
#include "runtime/core/once_a_minute.hpp"

namespace luxodus {

namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
namespace websocket = beast::websocket;
using tcp = asio::ip::tcp;

constexpr auto request_patience = std::chrono::seconds(15);
/// Whether somebody has interrupted.
constexpr auto look_every = std::chrono::milliseconds(100);
constexpr uint32_t header_bytes = 8 << 10;
/// Until a connection is accepted again, after one could not be: doubled, up to the second. Each
/// viewer who leaves frees a descriptor.
constexpr auto accept_again = std::chrono::milliseconds(50);
constexpr auto accept_again_most = std::chrono::milliseconds(1000);

/// What all connections need to know.
struct Shared {
  ViewHub* hub = nullptr;
  std::string token;
  std::vector<std::string> allowed_hosts;
  size_t viewers = 0;
};

/// Tells tokens apart in a time that does not depend on where they differ.
bool same_token(std::string_view a, std::string_view b) {
  if (a.size() != b.size()) return false;
  unsigned char different = 0;
  for (size_t i = 0; i < a.size(); ++i)
    different = static_cast<unsigned char>(different | (a[i] ^ b[i]));
  return different == 0;
}

struct Target {
  std::string_view path, token;
};

Target target_of(std::string_view text) {
  const size_t query = text.find('?');
  Target out{text.substr(0, query), {}};
  if (query == std::string_view::npos) return out;
  constexpr std::string_view key = "token=";
  std::string_view rest = text.substr(query + 1);
  while (!rest.empty()) {
    const size_t end = rest.find('&');
    const std::string_view one = rest.substr(0, end);
    if (one.substr(0, key.size()) == key) out.token = one.substr(key.size());
    rest = end == std::string_view::npos ? std::string_view() : rest.substr(end + 1);
  }
  return out;
}

std::string_view view_of(beast::string_view text) {
  return {text.data(), text.size()};
}

/// A page of another site must not speak to this one through somebody's browser. Programs that are
/// no browsers say no origin.
bool same_origin(const http::request<http::empty_body>& request) {
  const auto origin = request.find(http::field::origin);
  return origin == request.end() ||
         is_own_page(view_of(origin->value()), view_of(request[http::field::host]));
}

/// One viewer's socket.
class Connection final : public Viewer, public std::enable_shared_from_this<Connection> {
 public:
  Connection(tcp::socket socket, Shared& shared) : socket_(std::move(socket)), shared_(shared) {}
  ~Connection() override { leave(); }

  void begin(const http::request<http::empty_body>& request) {
    socket_.read_message_max(limits::view_message_bytes);
    socket_.auto_fragment(false);  // megabytes in pieces of 4 KiB would be slow
    socket_.set_option(websocket::stream_base::timeout::suggested(beast::role_type::server));
    socket_.async_accept(request, [self = shared_from_this()](beast::error_code failed) {
      if (failed) return;
      ++self->shared_.viewers;
      self->joined_ = true;
      self->shared_.hub->joins(*self);
      self->read();
    });
  }

  void send_text(const LiveFrame& text) override { send({text, false, false}); }
  void send_binary(const LiveFrame& frame, bool light) override { send({frame, true, light}); }
  std::vector<LiveFrame> take_light() override {
    // The first may be on its way.
    const auto first = queue_.begin() + (queue_.empty() ? 0 : 1);
    const auto taken =
        std::stable_partition(first, queue_.end(), [](const Out& out) { return !out.light; });
    std::vector<LiveFrame> light;
    for (auto at = taken; at != queue_.end(); ++at) {
      unread_ -= at->bytes->size();
      light.push_back(std::move(at->bytes));
    }
    queue_.erase(taken, queue_.end());
    return light;
  }

 private:
  struct Out {
    LiveFrame bytes;
    bool binary, light;
  };

  void send(Out out) {
    if (!joined_) return;
    unread_ += out.bytes->size();
    queue_.push_back(std::move(out));
    if (unread_ > limits::viewer_unread_bytes) return close();
    if (queue_.size() == 1) write();
  }

  void write() {
    socket_.binary(queue_.front().binary);
    socket_.async_write(asio::buffer(*queue_.front().bytes),
                        [self = shared_from_this()](beast::error_code failed, size_t) {
                          if (failed) return self->leave();
                          self->unread_ -= self->queue_.front().bytes->size();
                          self->queue_.pop_front();
                          if (!self->queue_.empty()) self->write();
                        });
  }

  void read() {
    socket_.async_read(buffer_, [self = shared_from_this()](beast::error_code failed, size_t) {
      if (failed) return self->leave();
      if (!self->joined_) return;
      const std::string text = beast::buffers_to_string(self->buffer_.data());
      self->buffer_.consume(self->buffer_.size());
      if (self->in_time()) self->shared_.hub->says(*self, text);
      self->read();
    });
  }

  /// Messages above the rate are let fall.
  bool in_time() {
    const auto now = std::chrono::steady_clock::now();
    if (now - second_ > std::chrono::seconds(1)) {
      second_ = now;
      said_ = 0;
    }
    return ++said_ <= limits::viewer_messages_per_s;
  }

  void leave() {
    if (!std::exchange(joined_, false)) return;
    --shared_.viewers;
    if (shared_.hub != nullptr) shared_.hub->leaves(*this);
  }
  /// Does not wait for somebody who does not read.
  void close() {
    beast::error_code ignored;
    beast::get_lowest_layer(socket_).socket().close(ignored);
    leave();
  }

  websocket::stream<beast::tcp_stream> socket_;
  Shared& shared_;
  beast::flat_buffer buffer_;
  std::deque<Out> queue_;
  size_t unread_ = 0;
  bool joined_ = false;
  std::chrono::steady_clock::time_point second_;
  int said_ = 0;
};

/// One request: the page, the socket, or a refusal.
class Request final : public std::enable_shared_from_this<Request> {
 public:
  Request(tcp::socket socket, Shared& shared) : stream_(std::move(socket)), shared_(shared) {}

  void begin() {
    parser_.header_limit(header_bytes);
    parser_.body_limit(0);
    stream_.expires_after(request_patience);
    http::async_read(stream_, buffer_, parser_,
                     [self = shared_from_this()](beast::error_code failed, size_t) {
                       if (!failed) self->answer();
                     });
  }

 private:
  void answer() {
    const auto& request = parser_.get();
    if (!names_place(view_of(request[http::field::host]), place(), shared_.allowed_hosts))
      return reply(http::status::forbidden, "text/plain",
                   "The page is not served under this name. Open the address that luxodus view has "
                   "printed, or allow the name with --allow-host.\n");
    const Target target = target_of(view_of(request.target()));
    if (!shared_.token.empty() && !same_token(target.token, shared_.token))
      return reply(http::status::forbidden, "text/plain",
                   "The address needs the token that luxodus view has printed.\n");
    if (target.path == "/live" && websocket::is_upgrade(request)) {
      if (!same_origin(request) || shared_.viewers >= limits::viewers)
        return reply(http::status::forbidden, "text/plain", "Not from there, or too many.\n");
      stream_.expires_never();
      return std::make_shared<Connection>(stream_.release_socket(), shared_)->begin(request);
    }
    if (request.method() != http::verb::get && request.method() != http::verb::head)
      return reply(http::status::method_not_allowed, "text/plain", "Only GET.\n");
    if (target.path == "/") return reply(http::status::ok, "text/html; charset=utf-8", view_page());
    reply(http::status::not_found, "text/plain", "There is nothing here but the page.\n");
  }

  ServedAt place() {
    beast::error_code failed;  // a connection that has gone is at no place
    const tcp::endpoint here = stream_.socket().local_endpoint(failed);
    if (failed) return {};
    asio::ip::address address = here.address();
    if (address.is_v6() && address.to_v6().is_v4_mapped())
      address = asio::ip::make_address_v4(asio::ip::v4_mapped, address.to_v6());
    return {address.to_string(), address.is_loopback(), here.port()};
  }

  void reply(http::status status, const char* type, std::string_view body) {
    response_.result(status);
    response_.version(parser_.get().version());
    response_.set(http::field::content_type, type);
    response_.set(http::field::cache_control, "no-store");
    response_.set("X-Content-Type-Options", "nosniff");
    response_.set("X-Frame-Options", "DENY");
    response_.set("Content-Security-Policy",
                  "default-src 'none'; script-src 'unsafe-inline' blob:; style-src "
                  "'unsafe-inline'; img-src data: blob:; connect-src 'self'; worker-src blob:; "
                  "frame-ancestors 'none'");
    response_.keep_alive(false);
    response_.content_length(body.size());
    if (parser_.get().method() != http::verb::head) response_.body() = std::string(body);
    http::async_write(stream_, response_, [self = shared_from_this()](beast::error_code, size_t) {
      beast::error_code ignored;
      self->stream_.socket().shutdown(tcp::socket::shutdown_send, ignored);
    });
  }

  beast::tcp_stream stream_;
  Shared& shared_;
  beast::flat_buffer buffer_;
  http::request_parser<http::empty_body> parser_;
  http::response<http::string_body> response_;
};

}  // namespace

class ViewServer::Implementation {
 public:
  Implementation() : acceptor_(context_), again_(context_) {}

  Result<bool> listen(const ServerOptions& options) {
    beast::error_code failed;
    const auto address = asio::ip::make_address(options.address, failed);
    if (failed) return Problem{{}, "\"" + options.address + "\" is no address"};
    const tcp::endpoint at(address, options.port);
    acceptor_.open(at.protocol(), failed);
    if (!failed) acceptor_.set_option(asio::socket_base::reuse_address(true), failed);
    if (!failed) acceptor_.bind(at, failed);
    if (!failed) acceptor_.listen(asio::socket_base::max_listen_connections, failed);
    if (failed)
      return Problem{{},
                     "cannot listen on " + http_address(options.address, options.port) + ": " +
                         failed.message()};
    shared_.token = options.token;
    shared_.allowed_hosts = options.allowed_hosts;
    return true;
  }
  uint16_t port() const { return acceptor_.local_endpoint().port(); }
  void run(ViewHub& hub, const std::function<bool()>& ends) {
    shared_.hub = &hub;
    accept();
    while (!ends()) context_.run_for(look_every);
    shared_.hub = nullptr;
  }
  uint64_t accepts_failed() const { return accepts_failed_; }
  void post(std::function<void()> function) { asio::post(context_, std::move(function)); }

 private:
  void accept() {
    acceptor_.async_accept([this](beast::error_code failed, tcp::socket socket) {
      if (failed) return rest(failed);
      pause_ = accept_again;
      std::make_shared<Request>(std::move(socket), shared_)->begin();
      accept();
    });
  }

  /// Who waits to be accepted would otherwise have this thread try without end.
  void rest(beast::error_code failed) {
    ++accepts_failed_;
    if (log_.may(clock_.now()))
      spdlog::warn("view=full failed={} text=\"a connection cannot be accepted: {}\"",
                   accepts_failed_.load(), failed.message());
    again_.expires_after(std::exchange(pause_, std::min(2 * pause_, accept_again_most)));
    again_.async_wait([this](beast::error_code) { accept(); });
  }

  Shared shared_;
  asio::io_context context_{1};
  tcp::acceptor acceptor_;
  asio::steady_timer again_;
  std::chrono::milliseconds pause_ = accept_again;
  std::atomic<uint64_t> accepts_failed_{0};
  OnceAMinute log_;
  SystemClock clock_;
};

ViewServer::ViewServer(std::unique_ptr<Implementation> implementation)
    : implementation_(std::move(implementation)) {}
ViewServer::~ViewServer() = default;

Result<std::unique_ptr<ViewServer>> ViewServer::listen(const ServerOptions& options) {
  auto implementation = std::make_unique<Implementation>();
  if (auto ok = implementation->listen(options); !ok.ok()) return ok.problem();
  return std::unique_ptr<ViewServer>(new ViewServer(std::move(implementation)));
}

uint16_t ViewServer::port() const {
  return implementation_->port();
}
uint64_t ViewServer::accepts_failed() const {
  return implementation_->accepts_failed();
}
void ViewServer::run(ViewHub& hub, const std::function<bool()>& ends) {
  implementation_->run(hub, ends);
}
void ViewServer::post(std::function<void()> function) {
  implementation_->post(std::move(function));
}

}  // namespace luxodus
