// Films and progressive pictures, on a command line.
#include <catch2/catch.hpp>
#include <fstream>
#include <iterator>

#include "tests/examples/program_kit.hpp"
#include "tests/kit/room_texts.hpp"

using namespace luxodus::program;
using Catch::Matchers::Contains;

namespace {

const std::string walked_room =
    "title = \"A room\"\npatch_edge_m = 1\n" + luxodus::test::white_room("[5, 4, 3]") + R"(
[[emitter]]
name = "lamp"
shape = "rectangle"
position = [2.5, 2, 2.9]
size = [0.6, 0.6]
flux_lm = 3000
[[route]]
name = "to the door"
path = [[1, 2, 0], [4, 2, 0]]
width = 1.2
[[route]]
name = "along the wall"
path = [[1, 1, 0], [1, 3, 0]]
width = 1.2
[[camera]]
name = "small"
eye = [0.3, 0.3, 1.6]
target = [3, 2.4, 1.6]
width = 16
height = 10
[[camera]]
name = "other"
eye = [4.7, 0.3, 1.2]
target = [3, 2.4, 1.6]
width = 16
height = 10
)";

/// A room with a run in it.
struct WalkedRoom : ScenePlace {
  WalkedRoom() : ScenePlace("room.toml", walked_room) {
    REQUIRE(run("--particles 20k --no-views").code == 0);
  }
  Outcome render(const std::string& options, const std::string& under = "") const {
    return luxodus("render " + out.string() + " " + options, under);
  }
};

/// At two frames a second, with few paths.
const std::string walk = "--route \"to the door\" --view small --fps 2 --paths 4";

}  // namespace

TEST_CASE("without ffmpeg a film is its frames, with a message", "[program][film]") {
  const WalkedRoom place;
  const Outcome made = place.render(walk, "env PATH=/nowhere ");
  INFO(made.err);
  CHECK(made.code == 0);
  CHECK_THAT(made.err, Contains("7 frames"));
  CHECK_THAT(made.err, Contains("no ffmpeg"));
  const fs::path frames = place.out / "films/to_the_door";
  CHECK(fs::exists(frames / "000006.png"));
  CHECK_FALSE(fs::exists(frames / "000007.png"));
  CHECK_FALSE(fs::exists(place.out / "films/to_the_door.mp4"));
  CHECK_FALSE(fs::exists(place.out / "views"));
}

TEST_CASE("ffmpeg makes a film of the frames, and a failure is an error", "[program][film]") {
  const WalkedRoom place;
  const fs::path tools = place.folder / "tools";
  fs::create_directory(tools);
  // Replaces ffmpeg: writes its arguments into the file that it should make.
  const auto install = [&](const std::string& last_line) {
    std::ofstream(tools / "ffmpeg") << "#!/bin/sh\nfor last; do :; done\necho \"$@\" > \"$last\"\n"
                                    << last_line << "\n";
    fs::permissions(tools / "ffmpeg", fs::perms::owner_all);
  };
  const std::string with_tools = "env PATH=" + tools.string() + ":/usr/bin:/bin ";
  install("echo no room for it >&2; exit 3");
  const Outcome failed = place.render(walk, with_tools);
  CHECK(failed.code == 1);
  CHECK_THAT(failed.err, Contains("ffmpeg failed with code 3, which said: no room for it"));
  CHECK_FALSE(fs::exists(place.out / "films/to_the_door.mp4"));
  install("exit 0");
  CHECK(place.render(walk, with_tools).code == 0);
  const std::string told = slurp(place.out / "films/to_the_door.mp4");
  CHECK_THAT(told, Contains("-framerate 2 "));
  CHECK_THAT(told, Contains("-frames:v 7 "));
  CHECK_THAT(told, Contains("-i %06d.png "));
  for (const auto& entry : fs::directory_iterator(place.out / "films"))
    CHECK(entry.path().filename().string().front() != '.');
}

TEST_CASE("the real ffmpeg makes a film in a folder with a percent sign", "[program][film]") {
  if (std::system("ffmpeg -version > /dev/null 2>&1") != 0) {
    WARN("there is no ffmpeg on the path: not tested");
    return;
  }
  WalkedRoom place;
  const fs::path odd = place.folder / "50%06d of it";
  fs::rename(place.out, odd);
  place.out = odd;
  const Outcome made = place.luxodus("render \"" + odd.string() + "\" " + walk);
  INFO(made.err);
  CHECK(made.code == 0);
  const fs::path film = odd / "films/to_the_door.mp4";
  REQUIRE(fs::exists(film));
  CHECK_THAT(slurp(film), Contains("ftyp"));
  // 7 frames at 2 a second.
  const std::string probe =
      "test \"$(ffprobe -v error -count_frames -show_entries "
      "stream=nb_read_frames,width,height -of csv=p=0 \"";
  CHECK(std::system((probe + film.string() + "\")\" = 16,10,7").c_str()) == 0);
}

TEST_CASE("a film goes through cameras of the scene", "[program][film]") {
  const WalkedRoom place;
  const Outcome made = place.render("--through 0s=small --through 1.5s=other --fps 2 --paths 4",
                                    "env PATH=/nowhere ");
  INFO(made.err);
  CHECK(made.code == 0);
  const fs::path frames = place.out / "films/small_to_other";
  CHECK(fs::exists(frames / "000003.png"));
  CHECK_FALSE(fs::exists(frames / "000004.png"));
}

TEST_CASE("a film advances the scene's clock, and each state is that of a run at its time",
          "[program][film]") {
  const std::string thickens = walked_room +
                               "[time]\nfrom = 0\nto = 6\nstep = 3\n[[medium]]\nname = "
                               "\"smoke\"\nkind = \"homogeneous\"\nalbedo = 0.5\n"
                               "extinction = [[0, 0], [6, 1.5]]\n";
  const ScenePlace place("room.toml", thickens);
  REQUIRE(place.run("--particles 20k --no-views").code == 0);
  // Frames of two films are compared, so each frame has an exposure of its own.
  const std::string stands =
      " --through 0s=small --through 3s=small --fps 1 --paths 4 --exposure each ";
  const auto film = [&](const fs::path& of, const std::string& clock) {
    return place.luxodus("render " + of.string() + stands + clock, "env PATH=/nowhere ");
  };
  // Two seconds of the clock in a frame: at 0, 2, 4 and 6 s.
  const Outcome made = film(place.out, "--from 0s --clock 2 --state-step 2s");
  INFO(made.err);
  REQUIRE(made.code == 0);
  const fs::path frames = "films/small_to_small";
  const auto frame = [&](const fs::path& of, const std::string& name) {
    return slurp(of / frames / name);
  };
  const fs::path then = place.folder / "at_4s";
  REQUIRE(place
              .luxodus("run " + (place.folder / "room.toml").string() +
                       " --at 4s --particles 20k --no-views --out " + then.string())
              .code == 0);
  REQUIRE(film(then, "").code == 0);
  CHECK(frame(place.out, "000002.png") == frame(then, "000000.png"));
  CHECK(frame(place.out, "000001.png") != frame(then, "000000.png"));
  CHECK(frame(place.out, "000003.png") != frame(then, "000000.png"));
  // A film of four frames ends within its second state of three, which is shown at 6 s.
  const std::string at_6s = frame(place.out, "000003.png");
  const Outcome ends_within = film(place.out, "--from 0s --clock 2 --state-step 6s");
  INFO(ends_within.err);
  REQUIRE(ends_within.code == 0);
  CHECK(frame(place.out, "000003.png") == at_6s);
  // A state of two frames is taken between them, here at 3 and at 7 s, and the scene ends at 6 s.
  const Outcome late = film(place.out, "--from 2s --clock 2 --state-step 4s");
  CHECK(late.code == 2);
  CHECK_THAT(late.err, Contains("'extinction' is known from 0 to 6 s, and the time is 7 s"));
  const WalkedRoom still;
  const Outcome timeless = still.render("--route \"to the door\" --from 0s");
  CHECK(timeless.code == 2);
  CHECK_THAT(timeless.err, Contains("nothing in this scene changes in time"));
  CHECK_THAT(still.render("--from 0s").err, Contains("--route or --through"));
}

TEST_CASE("other states of an adaptive run are allocated by their own light", "[program][film]") {
  const ScenePlace place(
      "room.toml", walked_room +
                       "[run]\ngroups = \"emitter\"\n[time]\nfrom = 0\nto = 6\n"
                       "step = 3\n[[emitter]]\nname = \"far\"\nshape = \"point\"\ndistribution = "
                       "\"isotropic\"\nposition = [0.5, 0.5, 2]\nflux_lm = 200\n"
                       "[[medium]]\nname = \"smoke\"\nkind = "
                       "\"homogeneous\"\nalbedo = 0.5\n"
                       "extinction = [[0, 0], [6, 1.5]]\n");
  const auto last_frame = [&](const std::string& run, const std::string& options) {
    const fs::path out = place.folder / run;
    REQUIRE(place
                .luxodus("run " + (place.folder / "room.toml").string() +
                         " --particles 20k --no-views --out " + out.string() + options)
                .code == 0);
    const Outcome made = place.luxodus("render " + out.string() +
                                           " --through 0s=small --through 1s=small --fps 1 "
                                           "--paths 4 --from 2s --clock 2 --state-step 2s",
                                       "env PATH=/nowhere ");
    INFO(made.err);
    REQUIRE(made.code == 0);
    return slurp(out / "films/small_to_small/000001.png");
  };
  CHECK(last_frame("adaptive", " --adaptive") == last_frame("usual", ""));
}

TEST_CASE("an impossible film is rejected with one clear error", "[program][film]") {
  const WalkedRoom place;
  const auto refused = [&](const std::string& options, const std::string& why) {
    const Outcome outcome = place.render(options);
    INFO(options << "\n" << outcome.err);
    CHECK(outcome.code == 2);
    CHECK_THAT(outcome.err, Contains(why));
    CHECK_FALSE(fs::exists(place.out / "films"));
  };
  refused("--route cellar", "there are: \"to the door\", \"along the wall\"");
  refused("--route \"to the door\" --speed 0", "--speed");
  refused("--route \"to the door\" --fps -1", "--fps");
  refused("--route \"to the door\" --speed 0.01 --fps 240 --paths 1", "frames");
  refused("--route \"to the door\" --view nowhere", "there is no camera \"nowhere\"");
  refused("--route \"to the door\" --picture-time 5s", "exclude --picture-time");
  refused("--speed 2", "--route");
  refused("--fps 2", "--through");
  refused("--route \"to the door\" --through 0s=small", "excludes --through");
  refused("--through 0s=small", "two cameras");
  refused("--through small", "TIME=CAMERA");
  refused("--through 0s=small --through 2s=nowhere", "there is no camera \"nowhere\"");
  fs::remove(place.out / "flux.lux");
  refused("--route \"to the door\" --paths 1 --fps 1", "flux.lux");
}

TEST_CASE("wrong limits of pictures are rejected before anything is traced", "[program][film]") {
  const ScenePlace place("room.toml", walked_room);
  for (const std::string wrong :
       {"--picture-time -5", "--picture-time 0", "--picture-time soon", "--picture-error 0",
        "--picture-error 150%", "--picture-paths 0", "--picture-paths 65537", "--display-white 0.5",
        "--display-white 0"}) {
    const Outcome outcome = place.run("--particles 20k " + wrong);
    INFO(wrong << "\n" << outcome.err);
    CHECK(outcome.code == 2);
    CHECK_THAT(outcome.err, Contains(wrong.substr(0, wrong.find(' '))));
    CHECK_FALSE(fs::exists(place.out / "flux.lux"));
  }
  const ScenePlace large("room.toml", walked_room +
                                          "[[camera]]\nname = \"large\"\n"
                                          "eye = [1, 1, 1]\ntarget = [2, 2, 1]\n"
                                          "width = 100000\nheight = 100000\n");
  const Outcome too_large = large.run("--particles 20k");
  CHECK(too_large.code == 2);
  CHECK_THAT(too_large.err, Contains("width"));
}

TEST_CASE("pictures end at a time or an error, and state their error", "[program][film]") {
  const WalkedRoom place;
  const Outcome timed = place.render("--picture-time 1ms --threads 2");
  CHECK(timed.code == 0);
  CHECK_THAT(timed.err, Contains("pictures: 4 paths a pixel, error "));
  const Outcome good = place.render("--picture-error 20%");
  CHECK(good.code == 0);
  CHECK_THAT(good.err, Contains(" paths a pixel, error "));
  CHECK(fs::exists(place.out / "views/small.exr"));
}

TEST_CASE("pictures of several runs share one exposure", "[program][film]") {
  const WalkedRoom place;
  const fs::path dimmed = place.folder / "dimmed", other = place.folder / "other.toml";
  std::string text = walked_room;
  text.replace(text.find("3000"), 4, "30");
  std::ofstream(other) << text;
  REQUIRE(
      place
          .luxodus("run " + other.string() + " --particles 20k --no-views --out " + dimmed.string())
          .code == 0);
  const Outcome made = place.luxodus("render " + place.out.string() + " " + dimmed.string() +
                                     " --paths 4 --exposure shared");
  INFO(made.err);
  REQUIRE(made.code == 0);
  CHECK_THAT(made.err, Contains("exposure of 4 pictures together: "));
  const auto exposure_of = [](const fs::path& file) {
    std::ifstream in(file, std::ios::binary);
    const std::string png{std::istreambuf_iterator<char>(in), {}};
    const std::string key("Exposure\0", 9);
    const size_t begin = png.find(key) + key.size();
    return png.substr(begin, png.find_first_not_of("0123456789.,e+-", begin) - begin);
  };
  const std::string first = exposure_of(place.out / "views/small.png");
  CHECK_THAT(made.err, Contains("together: " + first.substr(0, first.rfind(','))));
  CHECK(exposure_of(place.out / "views/other.png") == first);
  for (const char* view : {"views/small.png", "views/other.png"})
    CHECK(exposure_of(dimmed / view) == first);
  const Outcome wrong = place.render("--exposure bright");
  CHECK(wrong.code == 2);
  CHECK_THAT(wrong.err, Contains("--exposure takes each, shared, or GREY,WHITE,SIGN"));
}
