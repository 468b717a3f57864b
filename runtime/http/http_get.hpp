// Fetches one page over HTTP/1.x: a request without a body, an answer of limited length within a
// limited time, one connection each. For pages of metrics on a trusted network: no encryption, no
// redirects, no compression. Blocks the calling thread; any thread.
#pragma once

#include <cstdint>
#include <string>

#include "runtime/core/clock.hpp"
#include "runtime/core/result.hpp"

namespace luxodus {

namespace limits {
/// Longest page [bytes]: a node's metrics take about 20 KB, and a process has at most 64 nodes.
inline constexpr size_t http_page_bytes = 8 << 20;
}  // namespace limits

/// "http://host:port/path", "host:port/path" or "host:port", which asks for /metrics. An IPv6
/// address is written in brackets.
struct HttpUrl {
  std::string host;  // without brackets
  uint16_t port = 0;
  std::string path = "/metrics";

  std::string text() const;
};

/// Errors: another scheme, no port, characters that are invalid in a request.
Result<HttpUrl> parse_http_url(const std::string& text);

/// The body of the answer. Errors: no such host, no answer within `patience`, a status other than
/// 200, more bytes than the limit.
Result<std::string> http_get(const HttpUrl& url, Nanoseconds patience);

}  // namespace luxodus
