// Fetches one page over HTTP/1.x: a question without a body, an answer of bounded length within a
// bounded time, one connection each. For pages of numbers on a network that is one's own: no
// encryption, no redirects, no compression. Blocks the thread that calls; any may.
#pragma once

#include <cstdint>
#include <string>

#include "runtime/core/clock.hpp"
#include "runtime/core/result.hpp"

namespace luxodus {

namespace limits {
/// Of a page [bytes]: a node's numbers take some 20 KB, and a process has at most 64 nodes.
inline constexpr size_t http_page_bytes = 8 << 20;
}  // namespace limits

/// "http://host:port/path", "host:port/path" or "host:port", which asks for /metrics. An IPv6
/// address stands in brackets.
struct HttpUrl {
  std::string host;  // without brackets
  uint16_t port = 0;
  std::string path = "/metrics";

  std::string text() const;
};

/// Errors: another scheme, no port, characters that a request cannot carry.
Result<HttpUrl> parse_http_url(const std::string& text);

/// The body of the answer. Errors: no such host, nobody answers within `patience`, another status
/// than 200, more bytes than the limit.
Result<std::string> http_get(const HttpUrl& url, Nanoseconds patience);

}  // namespace luxodus
