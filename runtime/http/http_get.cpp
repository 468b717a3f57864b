#include "runtime/http/http_get.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <chrono>
#include <string_view>
#include <utility>

#include "runtime/http/served_names.hpp"

namespace luxodus {

namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
using tcp = asio::ip::tcp;

/// Status line and headers [bytes].
constexpr uint32_t max_head_bytes = 16 * 1024;

/// One request and its answer: resolve, connect, write, read. The first step that fails ends it.
class Exchange {
 public:
  explicit Exchange(const HttpUrl& url)
      : url_(url), request_(http::verb::get, beast::string_view(url.path), 11) {
    request_.set(http::field::host, named_place(url.host, url.port));
    request_.set(http::field::connection, "close");
    answer_.header_limit(max_head_bytes);
    answer_.body_limit(limits::http_page_bytes);
  }

  beast::error_code run(Nanoseconds patience) {
    stream_.expires_after(std::chrono::nanoseconds(patience));
    resolver_.async_resolve(url_.host, std::to_string(url_.port),
                            [this](beast::error_code failed, tcp::resolver::results_type places) {
                              if (!over(failed)) connect(places);
                            });
    context_.run();
    return failed_;
  }
  const http::response<http::string_body>& answer() const { return answer_.get(); }

 private:
  bool over(beast::error_code failed) {
    failed_ = failed;
    return static_cast<bool>(failed);
  }
  void connect(const tcp::resolver::results_type& places) {
    stream_.async_connect(places, [this](beast::error_code failed, const tcp::endpoint&) {
      if (!over(failed)) ask();
    });
  }
  void ask() {
    http::async_write(stream_, request_, [this](beast::error_code failed, size_t) {
      if (!over(failed)) read_head();
    });
  }
  /// Separately from the body: Beast 1.74 misses that a body is too long if both arrive at once.
  void read_head() {
    http::async_read_header(stream_, buffer_, answer_, [this](beast::error_code failed, size_t) {
      if (!over(failed)) read_body();
    });
  }
  void read_body() {
    http::async_read(stream_, buffer_, answer_,
                     [this](beast::error_code failed, size_t) { over(failed); });
  }

  const HttpUrl& url_;
  asio::io_context context_{1};
  tcp::resolver resolver_{context_};
  beast::tcp_stream stream_{context_};
  http::request<http::empty_body> request_;
  beast::flat_buffer buffer_;
  http::response_parser<http::string_body> answer_;
  beast::error_code failed_;
};

std::string reason_of(beast::error_code failed) {
  if (failed == beast::error::timeout) return "no answer in time";
  if (failed == http::error::body_limit)
    return fmt::format("the page is longer than {} bytes", limits::http_page_bytes);
  if (failed.category() == http::make_error_code(http::error::bad_version).category())
    return "the answer is not HTTP/1: " + failed.message();
  return failed.message();
}

}  // namespace

std::string HttpUrl::text() const {
  return http_address(host, port) + path;
}

Result<HttpUrl> parse_http_url(const std::string& text) {
  const Problem wrong{{},
                      fmt::format("\"{}\" is no address such as 127.0.0.1:9464 or "
                                  "http://host:9464/metrics",
                                  text)};
  std::string_view rest = text;
  constexpr std::string_view scheme = "http://";
  if (rest.starts_with(scheme)) rest.remove_prefix(scheme.size());
  const size_t slash = std::min(rest.find('/'), rest.size());
  const auto place = named_place_of(rest.substr(0, slash));
  const auto printable = [](char c) { return c > ' ' && c < 0x7f; };
  if (!place || !place->port || *place->port == 0 ||
      !std::all_of(text.begin(), text.end(), printable))
    return wrong;
  HttpUrl url{place->name, *place->port};
  if (slash < rest.size()) url.path = rest.substr(slash);
  return url;
}

Result<std::string> http_get(const HttpUrl& url, Nanoseconds patience) {
  Exchange exchange(url);
  const auto refused = [&](const std::string& why) {
    return problem(fmt::format("{}: {}", url.text(), why), ProblemKind::lost_peer);
  };
  if (const auto failed = exchange.run(patience)) return refused(reason_of(failed));
  const auto& answer = exchange.answer();
  if (answer.result() != http::status::ok)
    return refused(
        fmt::format("the answer is {} {}", answer.result_int(), std::string(answer.reason())));
  return answer.body();
}

}  // namespace luxodus
