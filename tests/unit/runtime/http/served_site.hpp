// A server of one page on a thread of its own, for tests.
#pragma once

#include <catch2/catch.hpp>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <thread>
#include <utility>

#include "runtime/http/http_server.hpp"

namespace luxodus::test {

class ServedSite {
 public:
  /// `page` is served at /metrics.
  explicit ServedSite(std::function<std::string()> page, HttpAddress at = {}, HttpSite site = {}) {
    site.page = [page = std::move(page)](std::string_view path) -> std::optional<HttpPage> {
      if (path != "/metrics") return std::nullopt;
      return HttpPage{page(), "text/plain"};
    };
    auto server = HttpServer::listen(std::move(at), std::move(site));
    REQUIRE(server.ok());
    server_ = std::move(server).value();
    thread_ = std::thread([this] { server_->run(); });
  }
  ~ServedSite() {
    server_->stop();
    thread_.join();
  }
  HttpServer& server() const { return *server_; }
  uint16_t port() const { return server_->port(); }
  /// The Host that a client sends.
  std::string here(const std::string& name = "127.0.0.1") const {
    return name + ":" + std::to_string(port());
  }
  std::string request(const std::string& method = "GET",
                      const std::string& target = "/metrics") const {
    return method + " " + target + " HTTP/1.1\r\nHost: " + here() + "\r\n\r\n";
  }

 private:
  std::unique_ptr<HttpServer> server_;
  std::thread thread_;
};

}  // namespace luxodus::test
