// Reads safety signs.
#include "scenes/formats/scene_file/read_signs.hpp"

#include <algorithm>
#include <cctype>

#include "runtime/core/output_text.hpp"
#include "scenes/formats/images/image_file.hpp"
#include "scenes/formats/scene_file/read_colours.hpp"
#include "scenes/formats/scene_file/read_files.hpp"
#include "scenes/formats/scene_file/read_placement.hpp"
#include "scenes/formats/scene_file/read_spectrum.hpp"
#include "scenes/formats/scene_file/read_types.hpp"
#include "scenes/formats/scene_file/scene_readers.hpp"
#include "scenes/light/signs/sign_colours.hpp"
#include "scenes/light/signs/sign_face.hpp"

namespace luxodus {

namespace {

std::string lower_extension(const std::filesystem::path& path) {
  std::string e = path.extension().string();
  for (char& c : e) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return e;
}

Result<SignFace> drawn_face(const std::filesystem::path& path, const Sign& sign, int texels) {
  const std::string extension = lower_extension(path);
  if (extension == ".svg")
    return face_from_svg(path, sign.width_m, sign.height_m, texels, sign.colours);
  if (extension == ".png")
    return face_from_png(path, sign.width_m, sign.height_m, texels, sign.colours);
  return problem("a pictogram is an .svg or a .png file, not '" + path.filename().string() + "'");
}

/// Warns of what a drawing lacks, once for each file.
void tell_gaps(const std::filesystem::path& path, KeyReader& keys) {
  if (lower_extension(path) != ".svg" ||
      !keys.reading().cache.try_emplace("drawing " + path.string()).second)
    return;
  for (const std::string& gap : gaps_of_svg(path))
    keys.reading().warning(keys.place("file"),
                           "the drawing \"" + path.filename().string() + "\": " + gap);
}

/// Smallest number that is probably a length of a sign in millimetres.
constexpr double min_slip = 1;

/// A length of a sign longer than `most` probably has the wrong unit, and would make small details
/// large.
void bound_length(KeyReader& keys, const char* key, double value, double most, const char* of,
                  const Sign& sign) {
  if (!keys.has(key) || !keys.clean() || value <= most) return;
  keys.problem(key, "'" + std::string(key) + "' is " + shortest_number(value) +
                        " m but must not exceed " + shortest_number(most) + " m, " + of +
                        " of a face of " + shortest_number(sign.width_m) + " x " +
                        shortest_number(sign.height_m) + " m" +
                        (value >= min_slip ? "; metres? " + shortest_number(value) + " mm is " +
                                                 shortest_number(value / 1000)
                                           : ""));
}

/// Checks every length of a sign against its face.
void bound_lengths(KeyReader& keys, const Sign& sign) {
  const double shorter = std::min(sign.width_m, sign.height_m);
  const double longer = std::max(sign.width_m, sign.height_m);
  bound_length(keys, "smallest_detail", sign.smallest_detail_m, shorter, "the shorter side", sign);
  bound_length(keys, "thickness", sign.thickness_m, longer, "the longer side", sign);
  if (!sign.letters) return;
  bound_length(keys, "letter_height", sign.letters->height_m, sign.height_m, "the height", sign);
  bound_length(keys, "stroke", sign.letters->stroke_m, shorter, "the shorter side", sign);
  bound_length(keys, "spacing", keys.number("spacing"), sign.width_m, "the width", sign);
}

/// The colours that the keys of a face name.
struct NamedColours {
  std::optional<ColourIndex> legend, ground, plain;
};

NamedColours read_named_colours(KeyReader& keys, const Sign& sign) {
  NamedColours named{colour_of_key(keys, "legend", sign), colour_of_key(keys, "ground", sign),
                     colour_of_key(keys, "plain", sign)};
  if (named.legend && named.legend == named.ground)
    keys.problem("ground", "legend and ground have the same colour");
  // One of two colours leaves the other one. Signs of white and green have a white legend.
  if (sign.colours.size() != 2) return named;
  if (!named.legend && !named.ground && !names_its_colours(keys)) named.legend = ColourIndex{0};
  const auto rest = [](ColourIndex one) { return static_cast<ColourIndex>(1 - one); };
  if (named.legend && !named.ground) named.ground = rest(*named.legend);
  if (named.ground && !named.legend) named.legend = rest(*named.ground);
  return named;
}

/// What a face is made of; read before anything is drawn.
struct FaceKeys {
  std::string given;  // "file", "text" or "plain"
  int texels = 0;
  double letter_m = 0, stroke_m = 0, spacing_m = 0;
  NamedColours colours;
  std::optional<std::filesystem::path> path;
};

FaceKeys read_face_keys(KeyReader& keys, Sign& sign) {
  FaceKeys face;
  face.given = keys.exactly_one({"file", "text", "plain"}, true);
  face.texels = static_cast<int>(keys.integer("texels"));
  face.letter_m = keys.number("letter_height");
  face.stroke_m = keys.number("stroke");
  face.spacing_m = keys.number("spacing");
  face.colours = read_named_colours(keys, sign);
  const auto detail = keys.maybe_number("smallest_detail");
  if (face.given == "file") face.path = keys.file("file");
  if (face.given != "text") {
    for (const char* key : {"letter_height", "stroke", "spacing"}) {
      if (keys.has(key)) {
        keys.problem(key, "'" + std::string(key) + "' belongs to a sign with 'text'");
        break;
      }
    }
  }
  if (!face.given.empty() && face.given != "text" && !keys.has("smallest_detail")) {
    keys.problem(
        "'smallest_detail' [m] is needed where the face is no 'text': what must be seen to "
        "understand the sign?");
  }
  if (face.given == "text" && keys.clean() && (!face.colours.legend || !face.colours.ground))
    keys.problem("text", "a text needs 'legend', the colour of its letters" +
                             std::string(sign.colours.size() > 2 ? ", and 'ground'" : "") +
                             ": of the colours " + colour_names(sign.colours));
  sign.smallest_detail_m = detail.value_or(face.stroke_m);
  if (face.given == "text") {
    sign.letters = SignLetters{face.letter_m, face.stroke_m};
    sign.text = keys.text("text");
  }
  if (face.path) sign.file = *keys.value("file")->as_text();
  bound_lengths(keys, sign);
  return face;
}

/// Requires: nothing is wrong with the keys.
Result<SignFace> make_face(const FaceKeys& keys, const Sign& sign, bool names_colours) {
  const NamedColours& named = keys.colours;
  if (keys.given == "text")
    return face_from_text(sign.text, sign.width_m, sign.height_m, keys.letter_m, keys.stroke_m,
                          keys.spacing_m, *named.legend, *named.ground, keys.texels);
  if (keys.given == "plain") {
    auto face = uniform_face(*named.plain, sign.width_m, sign.height_m, keys.texels);
    if (face && names_colours) {
      face->legend = *named.plain;
      face->ground = other_colour;
    }
    return face;
  }
  auto face = drawn_face(*keys.path, sign, keys.texels);
  if (!face) return face;
  if (auto ok = choose_legend(face.value(), sign.colours, named.legend, named.ground); !ok)
    return ok.problem();
  return face;
}

void read_face(KeyReader& keys, Sign& sign) {
  const FaceKeys face_keys = read_face_keys(keys, sign);
  const auto map = keys.file("luminance_map");
  if (!keys.clean()) return;
  const auto& path = face_keys.path;
  if (path && !take_hash(*path, keys.place("file"), keys.reading())) return;
  auto face = make_face(face_keys, sign, names_its_colours(keys));
  if (!face) {
    SourcePlace at = keys.place(face_keys.given);
    return take_problem(face.problem(), at, keys.reading());
  }
  sign.face = std::move(face).value();
  if (path) tell_gaps(*path, keys);
  if (!map) return;
  const auto image = read_image(*map, keys.place("luminance_map"), keys.reading());
  if (!image) return;
  auto with_map = with_luminance_map(std::move(sign.face), sign.colours, *image);
  if (!with_map)
    return take_problem(with_map.problem(), keys.place("luminance_map"), keys.reading());
  sign.face = std::move(with_map).value();
}

void read_lighting(KeyReader& keys, Sign& sign) {
  const std::string lighting = keys.choice("lighting");
  sign.lighting = lighting == "external"           ? SignLighting::external
                  : lighting == "photoluminescent" ? SignLighting::photoluminescent
                                                   : SignLighting::internal;
  sign.decay = keys.pairs("decay");
  sign.duration_s = duration_s(keys);
  if (keys.has("duration_h") && lighting != "internal")
    keys.problem("duration_h", "'duration_h' belongs to a sign with lighting = \"internal\"");
}

void check_decay(KeyReader& keys, const Sign& sign) {
  if (sign.lighting != SignLighting::photoluminescent) {
    if (keys.has("decay")) keys.problem("decay", "'decay' belongs to a photoluminescent sign");
    return;
  }
  if (!keys.has("decay")) {
    keys.problem(
        "the key 'decay' is missing: rows [seconds after failure, share of the luminance]");
  } else if (keys.clean()) {
    bool good = sign.decay.size() >= 2 && sign.decay.front().x == 0;
    for (size_t i = 1; i < sign.decay.size(); ++i) good &= sign.decay[i].x > sign.decay[i - 1].x;
    if (!good) keys.problem("decay", "'decay' needs two or more rows, times ascending from 0");
  }
}

}  // namespace

SignArrow arrow_named(const std::string& word) {
  return word == "left" ? SignArrow::left : word == "right" ? SignArrow::right : SignArrow::ahead;
}

void read_leads_to(KeyReader& keys, Sign& sign) {
  for (const toml::Table* table : keys.tables("leads_to")) {
    KeyReader way(*table, {"sign.leads_to"}, keys.reading());
    const std::string route = way.text("route");
    const SignArrow arrow = arrow_named(way.choice("arrow"));
    const auto same = [&](const LeadsTo& one) { return one.route == route; };
    if (std::any_of(sign.leads_to.begin(), sign.leads_to.end(), same))
      way.problem("route", "this sign leads to the route '" + route + "' already");
    sign.leads_to.push_back({route, arrow});
    keys.reading().routes_named.push_back({route, way.place("route")});
  }
}

void read_sign_itself(KeyReader& keys, Sign& sign) {
  sign.width_m = keys.number("width");
  sign.height_m = keys.number("height");
  sign.thickness_m = keys.number("thickness");
  sign.double_sided = keys.flag("double_sided");
  sign.angular_exponent = keys.number("angular_exponent");
  if (const auto circuit = keys.maybe_text("circuit")) {
    sign.circuit = *circuit;
    keys.reading().note("circuit", sign.circuit, keys.place("circuit"));
  }
  sign.group = keys.text("group");
  read_lighting(keys, sign);
  read_colours(keys, sign);
  check_decay(keys, sign);
  read_face(keys, sign);
}

void make_generic_sign(Sign& sign) {
  // The letters of NFPA 101, a height legible from 40 m by EN 1838, and luminances that both
  // require where smoke may occur.
  constexpr double width_m = 0.5, height_m = 0.2, letter_m = 0.1524, stroke_m = 0.01905;
  constexpr double spacing_m = 0.009525;
  constexpr int texels = 256;
  sign.width_m = width_m;
  sign.height_m = height_m;
  sign.text = "EXIT";
  sign.letters = SignLetters{letter_m, stroke_m};
  sign.smallest_detail_m = stroke_m;
  sign.colours = white_and_green({500, 50}, {200, 20});
  FaceColour &white = sign.colours[0], &green = sign.colours[1];
  white.shape = emission_shape_from_linear_srgb(1, 1, 1);
  green.shape = film_before(white.shape, green.drawn);
  // The text fits by construction: letters, stroke and face are those above.
  sign.face =
      face_from_text(sign.text, width_m, height_m, letter_m, stroke_m, spacing_m, 0, 1, texels)
          .value();
}

void read_sign(const toml::Table& stated, SceneReading& reading) {
  const auto typed = with_type(stated, "sign_type", reading);
  const toml::Table table = typed.value_or(stated);
  KeyReader keys(table, {"sign"}, reading);
  Sign sign;
  sign.name = read_name(keys, "sign");
  if (!typed) return;
  sign.ifc_guid = keys.text("ifc_guid");
  sign.place = keys.place();
  const glm::dvec3 position = keys.point("position");
  const auto facing = keys.maybe_direction("facing");
  const glm::dvec3 up = keys.direction("up");
  if (facing && keys.clean()) {
    if (glm::length(glm::cross(*facing, up)) < 1e-6) {
      keys.problem("up",
                   "'up' must not be parallel to 'facing'; a sign that lies flat must say it");
    } else if (auto frame = frame_facing(position, *facing, up)) {
      sign.frame = frame.value();
    } else {
      adopt_problem(keys, frame.problem());
    }
  }
  read_sign_itself(keys, sign);
  read_leads_to(keys, sign);
  reading.scene.signs.push_back(std::move(sign));
}

}  // namespace luxodus
