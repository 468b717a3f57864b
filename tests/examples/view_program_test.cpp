// Live views as a user starts and uses them: of a folder, and on the processes of a cluster.
#include <boost/asio/connect.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/write.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket.hpp>
#include <cstring>
#include <nlohmann/json.hpp>
#include <set>

#include "tests/examples/cluster_kit.hpp"
#include "tests/kit/room_texts.hpp"

using namespace luxodus::program;

namespace {

namespace beast = boost::beast;
namespace net = boost::asio;

/// The messages of a browser's page, sent and received.
class Page {
 public:
  explicit Page(const std::string& port) : socket_(context_) {
    net::ip::tcp::resolver resolver(context_);
    net::connect(socket_.next_layer(), resolver.resolve("127.0.0.1", port));
    socket_.read_message_max(64 << 20);
    socket_.handshake("127.0.0.1:" + port, "/live");
  }
  void say(const std::string& text) {
    socket_.text(true);
    socket_.write(net::buffer(text));
  }
  /// Waits for a text message with these words, and returns it; records light that arrives
  /// meanwhile.
  std::string hear(const std::string& words) {
    for (;;) {
      beast::flat_buffer buffer;
      socket_.read(buffer);
      const std::string got = beast::buffers_to_string(buffer.data());
      if (!socket_.got_text())
        remember(got);
      else if (got.find(words) != std::string::npos)
        return got;
    }
  }
  /// Groups whose light has arrived, by generation.
  std::set<uint32_t> lit(uint32_t generation) const {
    std::set<uint32_t> out;
    for (const auto& [number, group] : lit_)
      if (number == generation) out.insert(group);
    return out;
  }

 private:
  void remember(const std::string& frame) {
    uint32_t head[3];
    REQUIRE(frame.size() >= sizeof head);
    std::memcpy(head, frame.data(), sizeof head);
    if (head[0] == 2) lit_.insert({head[1], head[2]});
  }

  net::io_context context_;
  beast::websocket::stream<net::ip::tcp::socket> socket_;
  std::set<std::pair<uint32_t, uint32_t>> lit_;
};

/// What the page fetches beside itself.
std::string fetched(const std::string& port, const std::string& target) {
  net::io_context context;
  net::ip::tcp::socket socket(context);
  net::connect(socket, net::ip::tcp::resolver(context).resolve("127.0.0.1", port));
  beast::http::request<beast::http::empty_body> request{beast::http::verb::get, target, 11};
  request.set(beast::http::field::host, "127.0.0.1:" + port);
  beast::http::write(socket, request);
  beast::flat_buffer buffer;
  beast::http::response<beast::http::string_body> response;
  beast::http::read(socket, buffer, response);
  CHECK(response.result_int() == 200);
  return response.body();
}

ClusterText viewed() {
  ClusterText text;
  text.workers = 2;
  text.scene = (fs::path(LUX_SOURCE_DIR) / "scenes/library/office_floor.toml").string();
  text.run = "particles = 100_000\n";
  text.more = "[view]\nport = 0\n[timeouts]\nstart_s = 20\nlost_s = 20\n";
  return text;
}

/// The port of the page that a process has printed.
std::string port_of(Process& process) {
  REQUIRE(process.says("http://127.0.0.1:"));
  REQUIRE(process.says("Ctrl-C"));
  const std::string& text = process.text();
  const size_t from = text.find("http://127.0.0.1:") + 17;
  return text.substr(from, text.find('/', from) - from);
}

}  // namespace

TEST_CASE("a cluster traces for a live view, and retraces what is moved", "[cluster][view]") {
  const TemporaryFolder folder;
  Process up(LUX_PROGRAM, {"cluster", "up", write_cluster(folder, viewed())});
  {
    Page page(port_of(up));
    const std::string scene = page.hear("\"type\":\"scene\"");
    page.hear("\"done\":true");
    const size_t groups = page.lit(1).size();
    CHECK(groups > 10);
    // One luminaire moves: only its light is sent again.
    const size_t at = scene.find("\"luminaires\":[");
    REQUIRE(at != std::string::npos);
    const size_t name = scene.find("\"name\":\"", at) + 8;
    page.say(R"({"type":"move","kind":"luminaire","name":")" +
             scene.substr(name, scene.find('"', name) - name) + R"(","position":[2,2,2.2]})");
    page.hear("\"generation\":2");
    page.hear("\"done\":true");
    CHECK(page.lit(2).size() == 1);
  }
  // One may have traced everything before the other has come.
  CHECK(up.says("n0 is there"));
  CHECK(up.says("n1 is there"));
  up.kill(SIGINT);
  const int code = up.wait();
  INFO(up.text());
  CHECK(code == 0);
}

TEST_CASE("a live view of a folder shows the scene and state of its run", "[program][view]") {
  const TemporaryFolder folder;
  const std::string scene =
      (fs::path(LUX_SOURCE_DIR) / "scenes/library/office_floor.toml").string();
  const std::string out = (folder / "out").string();
  const Outcome run = run_luxodus(
      folder,
      "run " + scene + " --scenario clear_emergency --particles 20k --no-views --out " + out);
  INFO(run.err);
  REQUIRE(run.code == 0);
  Process view(LUX_PROGRAM, {"view", out, "--port", "0", "--particles", "20k"});
  {
    Page page(port_of(view));
    CHECK(page.hear("\"type\":\"scene\"").find("\"scenario\":\"clear_emergency\"") !=
          std::string::npos);
  }
  view.kill(SIGINT);
  CHECK(view.wait() == 0);
}

TEST_CASE("a live view serves the people who walk, unless they stand as bodies",
          "[program][view][walk]") {
  const TemporaryFolder folder;
  const std::string scene =
      folder
          .write("room.toml",
                 "[[object]]\nname = \"hall\"\nshape = \"room\"\nlow = [0, -2, 0]\n"
                 "high = [12, 2, 3]\nmaterial = \"grey50\"\n" +
                     std::string(luxodus::test::middle_lamp))
          .string();
  const std::string people =
      folder.write("people.txt", "# framerate: 1\n# id frame x/m y/m z/m\n7 0 1 1 0\n7 2 3 1 0\n")
          .string();
  Process view(LUX_PROGRAM, {"view", scene, "--port", "0", "--particles", "1k", "--trajectories",
                             people, "--save-folder", folder.path().string()});
  const auto json = nlohmann::json::parse(fetched(port_of(view), "/people.json"));
  REQUIRE(json["people"].size() == 1);
  CHECK(json["people"][0]["to"] == 2);
  view.kill(SIGINT);
  CHECK(view.wait() == 0);

  const auto refused = [&](const std::string& words, const std::string& why) {
    const Outcome run = run_luxodus(folder, "view --port 0 " + words);
    INFO(run.err);
    CHECK(run.code == 2);
    CHECK(run.err.find(why) != std::string::npos);
  };
  refused(scene + " --trajectories " + scene, "room.toml");
  const std::string pack = (folder / "tank.luxpack").string();
  REQUIRE(run_luxodus(folder, "pack " + smoke_tank() + " --out " + pack).code == 0);
  refused(pack, "a pack cannot be changed live");
  const std::string bodies = folder
                                 .write("bodies.toml",
                                        "include = [\"room.toml\"]\npeople_as_bodies = true\n"
                                        "[[people]]\nname = \"guests\"\nfile = \"people.txt\"\n")
                                 .string();
  refused(bodies + " --at 1s --trajectories " + people, "people stand as bodies in this scene");
}

TEST_CASE("a folder without a run cannot be viewed, nor one with other files",
          "[program][view][failure]") {
  const TemporaryFolder folder;
  const Outcome empty = run_luxodus(folder, "view " + folder.path().string());
  CHECK(empty.code == 2);
  CHECK(empty.err.find("result.json") != std::string::npos);
  std::ofstream(folder / "assessment.json") << "{\"scene\": 3}";
  const Outcome other = run_luxodus(folder, "view " + folder.path().string());
  CHECK(other.code == 2);
  CHECK(other.err.find("assessment.json") != std::string::npos);
}

TEST_CASE("a second live view whose workers trace for another one ends, and says why",
          "[cluster][view][failure]") {
  const TemporaryFolder folder;
  ClusterText text = viewed();
  text.scene = smoke_tank();  // which is quickly traced
  const std::string first = write_cluster(folder, text, "first");
  const std::string second = write_cluster(folder, text, "second");
  Process up(LUX_PROGRAM, {"cluster", "up", first});
  // Both: the second view would take a worker that has not come to the first, and wait with it.
  REQUIRE(up.says("n0 is there"));
  REQUIRE(up.says("n1 is there"));
  const auto intruder = node(second, "controller");
  CHECK(intruder->wait() == 1);
  INFO(intruder->text());
  CHECK(intruder->said("its workers are not free: let the run that n"));
  CHECK(intruder->said("a live view of " + first));
  up.kill(SIGINT);
  CHECK(up.wait() == 0);
}

TEST_CASE("a live view refuses nodes that do not hold the scene", "[cluster][view][failure]") {
  const TemporaryFolder folder;
  ClusterText text = viewed();
  text.more += "[budget]\nobject_bytes = \"1 MiB\"\n";
  Process node(LUX_PROGRAM,
               {"node", "--config", write_cluster(folder, text), "--name", "controller"});
  CHECK(node.wait() == 2);
  CHECK(node.said("object_bytes"));
}

TEST_CASE("a live view prints an address that a browser accepts, and serves only there",
          "[program][view]") {
  const TemporaryFolder folder;
  const std::string scene = (fs::path(LUX_SOURCE_DIR) / "scenes/library/empty_room.toml").string();
  Process view(LUX_PROGRAM, {"view", scene, "--port", "0", "--particles", "10k", "--address", "::1",
                             "--save-folder", folder.path().string()});
  if (!view.says("Ctrl-C")) {
    CHECK(view.wait() == 2);
    WARN("skipped: this machine has no IPv6 loopback: " << view.text());
    return;
  }
  const std::string head = "http://[::1]:";
  INFO(view.text());
  REQUIRE(view.said(head));
  const size_t from = view.text().find(head) + head.size();
  const std::string port = view.text().substr(from, view.text().find('/', from) - from);
  const auto status_of = [&](const std::string& host) {
    net::io_context context;
    net::ip::tcp::socket socket(context);
    socket.connect({net::ip::make_address("::1"), static_cast<uint16_t>(std::stoi(port))});
    const std::string request = "HEAD / HTTP/1.1\r\nHost: " + host + "\r\n\r\n";
    net::write(socket, net::buffer(request));
    beast::flat_buffer buffer;
    beast::http::response_parser<beast::http::empty_body> answer;
    answer.skip(true);
    beast::http::read(socket, buffer, answer);
    return answer.get().result_int();
  };
  CHECK(status_of("[::1]:" + port) == 200);
  CHECK(status_of("evil.example:" + port) == 403);
  view.kill(SIGINT);
  CHECK(view.wait() == 0);
}

TEST_CASE("a live view whose variants could not be saved says so before it begins",
          "[program][view][failure]") {
  const TemporaryFolder folder;
  const std::string scene = (fs::path(LUX_SOURCE_DIR) / "scenes/library/empty_room.toml").string();
  const fs::path missing = folder / "missing";
  const Outcome none =
      run_luxodus(folder, "view " + scene + " --port 0 --save-folder " + missing.string());
  CHECK(none.code == 2);
  CHECK(none.err.find(missing.string() + ": variants cannot be saved in this folder: No such file "
                                         "or directory") != std::string::npos);
  const Outcome file = run_luxodus(folder, "view " + scene + " --port 0 --save-folder " + scene);
  CHECK(file.code == 2);
  CHECK(file.err.find("Not a directory") != std::string::npos);
  const Outcome name = run_luxodus(folder, "view " + scene + " --port 0 --allow-host http://a/");
  CHECK(name.code != 0);
  CHECK(name.err.find("is no name of a host") != std::string::npos);
}
