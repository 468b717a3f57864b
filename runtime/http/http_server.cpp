// All code on Boost.Beast's server is in this file, since it takes a minute to compile. Every
// client is a chain of callbacks on one io_context: read a request's head, answer it, and close; or
// become a WebSocket. A chain owns itself by shared_from_this, so it ends when no callback is
// pending.
#include "runtime/http/http_server.hpp"

#include <algorithm>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket.hpp>
#include <chrono>
#include <deque>
#include <utility>

#include "runtime/core/log.hpp"
#include "runtime/core/once_a_minute.hpp"
#include "runtime/http/served_names.hpp"

namespace luxodus {

namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
namespace websocket = beast::websocket;
using tcp = asio::ip::tcp;
using RequestHead = http::request<http::empty_body>;

/// Interval of checks for an interrupt.
constexpr auto look_every = std::chrono::milliseconds(100);
/// Delay before accepting again after a failure: doubled, up to one second. Each client that leaves
/// frees a descriptor.
constexpr auto accept_again = std::chrono::milliseconds(50);
constexpr auto max_accept_again = std::chrono::milliseconds(1000);

class OpenSocket;

/// State shared by all clients.
struct Shared {
  HttpAddress at;
  HttpSite site;
  std::vector<OpenSocket*> sockets = {};  // each while it has a listener, or may get one
};

/// Compares tokens in constant time.
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

/// Rejects pages of other sites that speak to this server through a user's browser. Programs that
/// are no browsers send no Origin.
bool same_origin(const RequestHead& request) {
  const auto origin = request.find(http::field::origin);
  return origin == request.end() ||
         is_own_page(view_of(origin->value()), view_of(request[http::field::host]));
}

class OpenSocket final : public WebSocket, public std::enable_shared_from_this<OpenSocket> {
 public:
  OpenSocket(tcp::socket socket, Shared& shared) : socket_(std::move(socket)), shared_(shared) {
    shared_.sockets.push_back(this);
  }
  ~OpenSocket() override { end(); }

  void begin(const RequestHead& request) {
    socket_.read_message_max(shared_.site.limits.message_bytes);
    socket_.auto_fragment(false);  // megabytes in pieces of 4 KiB would be slow
    socket_.set_option(websocket::stream_base::timeout::suggested(beast::role_type::server));
    socket_.async_accept(request, [self = shared_from_this()](beast::error_code failed) {
      if (failed || !self->open_) return self->leave();
      auto listener = self->shared_.site.opened(*self);
      if (!self->open_) return;  // it queued more at once than the limit
      self->listener_ = std::move(listener);
      self->read();
    });
  }

  void send(Bytes message, Kind kind, bool revocable) override {
    if (!open_) return;
    unread_ += message->size();
    queue_.push_back({std::move(message), kind, revocable});
    if (unread_ > shared_.site.limits.unread_bytes) return close();
    if (queue_.size() == 1) write();
  }

  std::vector<Bytes> take_back() override {
    // The first may be in the middle of sending.
    const auto first = queue_.begin() + (queue_.empty() ? 0 : 1);
    const auto taken =
        std::stable_partition(first, queue_.end(), [](const Out& out) { return !out.revocable; });
    std::vector<Bytes> messages;
    for (auto at = taken; at != queue_.end(); ++at) {
      unread_ -= at->message->size();
      messages.push_back(std::move(at->message));
    }
    queue_.erase(taken, queue_.end());
    return messages;
  }

  /// Stops sending and receiving. The listener may be the caller, and may still call send(), so it
  /// is destroyed later, together with this.
  void leave() {
    if (!std::exchange(open_, false)) return;
    asio::post(socket_.get_executor(), [self = shared_from_this()] { self->end(); });
  }
  void end() {
    open_ = false;
    std::erase(shared_.sockets, this);
    listener_.reset();
  }

 private:
  struct Out {
    Bytes message;
    Kind kind;
    bool revocable;
  };

  void write() {
    socket_.binary(queue_.front().kind == Kind::binary);
    socket_.async_write(asio::buffer(*queue_.front().message),
                        [self = shared_from_this()](beast::error_code failed, size_t) {
                          if (failed) return self->leave();
                          self->unread_ -= self->queue_.front().message->size();
                          self->queue_.pop_front();
                          if (!self->queue_.empty()) self->write();
                        });
  }

  void read() {
    socket_.async_read(buffer_, [self = shared_from_this()](beast::error_code failed, size_t) {
      if (failed) return self->leave();
      if (!self->open_) return;
      const std::string message = beast::buffers_to_string(self->buffer_.data());
      self->buffer_.consume(self->buffer_.size());
      if (self->in_time()) self->listener_->hears(message);
      self->read();
    });
  }

  /// Drops messages above the rate limit.
  bool in_time() {
    const auto now = std::chrono::steady_clock::now();
    if (now - second_ > std::chrono::seconds(1)) {
      second_ = now;
      said_ = 0;
    }
    return ++said_ <= shared_.site.limits.messages_per_s;
  }

  /// Does not wait for a peer that does not read.
  void close() {
    beast::error_code ignored;
    beast::get_lowest_layer(socket_).socket().close(ignored);
    leave();
  }

  websocket::stream<beast::tcp_stream, false> socket_;  // false: no compression
  Shared& shared_;
  std::unique_ptr<SocketListener> listener_;
  beast::flat_buffer buffer_;
  std::deque<Out> queue_;
  size_t unread_ = 0;
  bool open_ = true;
  std::chrono::steady_clock::time_point second_;
  int said_ = 0;
};

/// From an accepted connection to the end of its answer, or to a WebSocket.
class Client final : public std::enable_shared_from_this<Client> {
 public:
  Client(tcp::socket socket, Shared& shared) : stream_(std::move(socket)), shared_(shared) {}

  void begin() {
    parser_.header_limit(limits::http_request_bytes);
    stream_.expires_after(std::chrono::nanoseconds(limits::http_client));
    http::async_read_header(stream_, buffer_, parser_,
                            [self = shared_from_this()](beast::error_code failed, size_t) {
                              return failed ? self->refuse(failed) : self->answer();
                            });
  }
  void close() { stream_.close(); }

 private:
  void answer() {
    const RequestHead& request = parser_.get();
    if (!names_place(view_of(request[http::field::host]), place(), shared_.at.allowed_hosts))
      return say(http::status::forbidden,
                 "Nothing is served under this name. Ask for the address that the program has "
                 "printed or was given, or allow the name (--allow-host, allow_host).\n");
    const Target target = target_of(view_of(request.target()));
    if (!shared_.at.token.empty() && !same_token(target.token, shared_.at.token))
      return say(http::status::forbidden,
                 "The address needs the token that luxodus view has printed.\n");
    if (!shared_.site.socket_path.empty() && target.path == shared_.site.socket_path &&
        websocket::is_upgrade(request)) {
      if (!same_origin(request) || shared_.sockets.size() >= shared_.site.limits.sockets)
        return say(http::status::forbidden, "Not from there, or too many.\n");
      stream_.expires_never();
      return std::make_shared<OpenSocket>(stream_.release_socket(), shared_)->begin(request);
    }
    if (request.method() != http::verb::get && request.method() != http::verb::head)
      return say(http::status::method_not_allowed, "Only GET and HEAD.\n");
    if (auto page = shared_.site.page(target.path))
      return reply(http::status::ok, *std::move(page));
    say(http::status::not_found, "There is nothing at this path.\n");
  }

  ServedAt place() {
    beast::error_code failed;  // a connection that has gone has no address
    const tcp::endpoint here = stream_.socket().local_endpoint(failed);
    if (failed) return {};
    asio::ip::address address = here.address();
    if (address.is_v6() && address.to_v6().is_v4_mapped())
      address = asio::ip::make_address_v4(asio::ip::v4_mapped, address.to_v6());
    return {address.to_string(), address.is_loopback(), here.port()};
  }

  /// Answers an unreadable request; a client that has gone or timed out gets no answer.
  void refuse(beast::error_code failed) {
    if (failed == http::error::header_limit || failed == http::error::buffer_overflow)
      return say(http::status::request_header_fields_too_large, "The request is too long.\n");
    if (failed == http::error::end_of_stream || failed == http::error::partial_message) return;
    if (failed.category() == http::make_error_code(http::error::bad_method).category())
      say(http::status::bad_request, "This is not HTTP/1.\n");
  }

  void say(http::status status, const char* sentence) {
    reply(status, {sentence, "text/plain; charset=utf-8"});
  }

  void reply(http::status status, HttpPage page) {
    response_.result(status);
    if (parser_.is_header_done()) response_.version(parser_.get().version());
    response_.set(http::field::content_type, page.type);
    response_.set(http::field::cache_control, "no-store");
    response_.set("X-Content-Type-Options", "nosniff");
    response_.set("X-Frame-Options", "DENY");
    response_.set("Content-Security-Policy", page.policy);
    response_.keep_alive(false);
    response_.content_length(page.body.size());
    if (parser_.get().method() != http::verb::head) response_.body() = std::move(page.body);
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

class HttpServer::Implementation {
 public:
  Implementation(HttpAddress at, HttpSite site) : shared_{std::move(at), std::move(site)} {}

  Result<void> listen() {
    const HttpAddress& wanted = shared_.at;
    beast::error_code failed;
    const auto address = asio::ip::make_address(wanted.address, failed);
    if (failed)
      return problem("\"" + wanted.address + "\" is no numeric address such as 127.0.0.1 or ::1");
    const tcp::endpoint at(address, wanted.port);
    acceptor_.open(at.protocol(), failed);
    if (!failed) acceptor_.set_option(asio::socket_base::reuse_address(true), failed);
    if (!failed) acceptor_.bind(at, failed);
    if (!failed) acceptor_.listen(asio::socket_base::max_listen_connections, failed);
    if (failed)
      return problem(
          "cannot listen on " + http_address(wanted.address, wanted.port) + ": " + failed.message(),
          kind_of_errno(failed.value()));
    accept();
    return {};
  }
  uint16_t port() const { return acceptor_.local_endpoint().port(); }
  uint64_t accepts_failed() const { return accepts_failed_; }
  void post(std::function<void()> function) { asio::post(context_, std::move(function)); }
  void stop() { context_.stop(); }
  void run() {
    context_.run();
    end_sockets();
  }
  void run(const std::function<bool()>& ends) {
    while (!ends() && !context_.stopped()) context_.run_for(look_every);
    end_sockets();
  }

 private:
  void accept() {
    acceptor_.async_accept([this](beast::error_code failed, tcp::socket socket) {
      if (failed) return rest(failed);
      pause_ = accept_again;
      const auto client = std::make_shared<Client>(std::move(socket), shared_);
      make_room();
      clients_.push_back(client);
      client->begin();
      accept();
    });
  }

  /// Pauses accepting, since this thread would otherwise retry in a busy loop.
  void rest(beast::error_code failed) {
    ++accepts_failed_;
    if (log_.may(clock_.now()))
      log_warning("http=full failed={} text=\"a connection cannot be accepted: {}\"",
                  accepts_failed_.load(), failed.message());
    again_.expires_after(std::exchange(pause_, std::min(2 * pause_, max_accept_again)));
    again_.async_wait([this](beast::error_code) { accept(); });
  }

  /// Closes the oldest client: a client that is served needs only milliseconds.
  void make_room() {
    std::erase_if(clients_, [](const auto& client) { return client.expired(); });
    if (clients_.size() < limits::http_clients) return;
    if (const auto oldest = clients_.front().lock()) oldest->close();
    clients_.pop_front();
  }

  void end_sockets() {
    while (!shared_.sockets.empty()) shared_.sockets.back()->end();
  }

  Shared shared_;
  std::deque<std::weak_ptr<Client>> clients_;  // in order of arrival
  asio::io_context context_{1};
  tcp::acceptor acceptor_{context_};
  asio::steady_timer again_{context_};
  std::chrono::milliseconds pause_ = accept_again;
  std::atomic<uint64_t> accepts_failed_{0};
  OnceAMinute log_;
  SystemClock clock_;
};

HttpServer::HttpServer(std::unique_ptr<Implementation> implementation)
    : implementation_(std::move(implementation)) {}
HttpServer::~HttpServer() = default;

Result<std::unique_ptr<HttpServer>> HttpServer::listen(HttpAddress at, HttpSite site) {
  auto implementation = std::make_unique<Implementation>(std::move(at), std::move(site));
  if (auto ok = implementation->listen(); !ok) return ok.problem();
  return std::unique_ptr<HttpServer>(new HttpServer(std::move(implementation)));
}

uint16_t HttpServer::port() const {
  return implementation_->port();
}
uint64_t HttpServer::accepts_failed() const {
  return implementation_->accepts_failed();
}
void HttpServer::run() {
  implementation_->run();
}
void HttpServer::run(const std::function<bool()>& ends) {
  implementation_->run(ends);
}
void HttpServer::stop() {
  implementation_->stop();
}
void HttpServer::post(std::function<void()> function) {
  implementation_->post(std::move(function));
}

}  // namespace luxodus
