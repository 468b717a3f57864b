// Keys of luminaires, emitters, signs and media.
#include "scenes/formats/scene_file/scene_schema.hpp"

namespace luxodus {

KeySpec ifc_guid_key() {
  return {"ifc_guid", "text", "",
          "\"\"",     "",     "GlobalId in the IFC model that it came from; results name it"};
}

std::vector<KeySpec> photometric_file_keys(const char* whether) {
  return {
      {"file", "path", "", whether, "",
       "EULUMDAT (.ldt) or IES LM-63 (.ies) file, or a GLDF container (.gldf) of them"},
      {"variant", "text", "", "", "", "id of the variant in a GLDF container that has several"},
      {"emitter", "text", "", "", "",
       "name of the light emitter, where the variant has several: its id; `ID#2` for the second of "
       "its alternatives, `ID:1` for its first channel, `ID@2` for the second reference to it"},
      {"lamp_set", "integer", "", "", "[1, 20]",
       "which lamp set of an EULUMDAT file burns: its sets are alternatives; mandatory where it "
       "has "
       "several and no GLDF container states the flux"},
      {"point_source", "flag", "", "false", "",
       "emit from a point instead of the luminous opening of the file"},
  };
}

std::vector<KeySpec> operation_keys() {
  return {
      {"circuit", "name", "", "", "", "circuit it hangs on"},
      {"group", "name", "", "", "", "source group with tallies of its own"},
      {"mains_factor", "number", "", "1", "[0, 1000]", "dimming in mains operation"},
      {"maintenance_factor", "number", "", "", "(0, 1]",
       "ageing and dirt, applied to every flux; no default: mandatory where `emergency` is not "
       "false, "
       "1 where it is"},
      {"emergency", "choice", "", "\"false\"", "false, true, maintained, non-maintained",
       "lit when the mains fail; `true` and `\"maintained\"`: with the mains too; "
       "`\"non-maintained\"`: only then"},
      {"emergency_flux", "number", "lm or W", "", "[0, 1e9]",
       "flux on emergency supply, in the unit of the mains flux; this or `emergency_factor` is "
       "mandatory where `emergency` is not false and no GLDF container says it"},
      {"emergency_factor", "number", "", "", "[0, 1000]",
       "flux on emergency supply as a share of the rated flux (ballast lumen factor)"},
      {"emergency_flux_is", "choice", "", "", "rated, initial",
       "what the flux on emergency supply states: `\"rated\"` (EN 60598-2-22): the least from 60 s "
       "to the end of the duration, so that no `end_of_duration_factor` belongs to it; "
       "`\"initial\"`: that of a full battery. Not stated, it is taken as initial, and `check` "
       "warns"},
      {"initial_flux", "number", "lm or W", "", "[0, 1e9]",
       "flux on emergency supply of a new luminaire with a full battery, beside a rated flux; "
       "without it neither its glare (E8) nor its veil is assessed"},
      {"end_of_duration_factor", "number", "", "", "(0, 1]",
       "share of the initial flux that is left at the end of the rated duration; no default: "
       "mandatory where `emergency` is not false and the flux is not rated"},
      {"onset", "pairs", "", "", "[0, 1]",
       "rows [seconds after the mains have failed, share of the emergency flux], ascending in both "
       "from 0 s, the last share 1; linear between; without it the light is there at once, and "
       "whether it comes in time is not assessed"},
      {"duration_h", "number", "h", "", "(0, 1000]",
       "how long the emergency supply lasts: from then on after the failure it is dark; lit for as "
       "long as is asked for unless said. Of a GLDF container that states its emergency flux by "
       "duration it takes the flux of this one"},
      {"spectrum", "emission", "", "\"led 4000 K\"", "[0, 1e9]", "shape of its spectrum"},
  };
}

std::vector<KeySpec> product_keys() {
  return {
      {"maker", "text", "", "", "", "maker, as schedules name it; that of the file unless said"},
      {"article", "text", "", "", "",
       "article number, as schedules name it; that of the file unless said"},
      {"battery", "text", "", "", "", "its battery or central supply, as schedules name it"},
  };
}

namespace {

using Keys = std::vector<KeySpec>;

Keys aim_keys() {
  return {
      {"position", "point", "m", "required", "[-1e7, 1e7]", "centre of the luminous opening"},
      {"direction", "direction", "", "", "[-1e7, 1e7]",
       "where its -z looks, down unless said; instead of `target`"},
      {"target", "point", "m", "", "[-1e7, 1e7]",
       "a point its -z looks at; instead of `direction`"},
      {"rotation_deg", "number", "deg", "0", "[-360, 360]",
       "turn about local z, counter-clockwise seen against the aim (from above, where it looks "
       "down); at 0 "
       "and looking down local x is along +x, else local y is as near to up as can be"},
  };
}

std::vector<TableSpec> luminaire_keys() {
  return {
      {"luminaire", "`[[luminaire]]`: a luminaire of a photometric file",
       joined(
           joined(joined({{"name", "name", "", "required", "", "name of the luminaire"},
                          {"type", "text", "", "", "",
                           "name of a `[[luminaire_type]]`, whose keys it has but for those that "
                           "it says itself"},
                          ifc_guid_key()},
                         photometric_file_keys("required")),
                  aim_keys()),
           joined(joined(operation_keys(), product_keys()),
                  {repeat_key(),
                   {"body_material", "text", "", "", "",
                    "material of its body; without it returning light passes"}}))},
      {"luminaire_type", "`[[luminaire_type]]`: what several luminaires have in common",
       joined(joined({{"name", "name", "", "required", "", "name of the type"}},
                     photometric_file_keys("")),
              joined(joined(operation_keys(), product_keys()),
                     {{"body_material", "text", "", "", "",
                       "material of its body; without it returning light passes"}}))},
      {"emitter", "`[[emitter]]`: a light source of simple shape",
       joined(
           joined(
               {{"name", "name", "", "required", "", "name of the emitter"},
                {"shape", "choice", "", "required", "point, rectangle, disc, sphere, tube, mesh",
                 "shape; surfaces emit along local -z, spheres and tubes outward, meshes to their "
                 "front"},
                {"distribution", "choice", "", "\"lambertian\"",
                 "lambertian, isotropic, cosine_power, spot, collimated",
                 "how intensity depends on direction"},
                {"cosine_power", "number", "", "1", "[0, 1e4]",
                 "exponent n of intensity ~ cos^n, for `cosine_power`"},
                {"spot_inner_deg", "number", "deg", "0", "[0, 90]",
                 "half angle of full intensity, for `spot`"},
                {"spot_outer_deg", "number", "deg", "30", "(0, 90]",
                 "half angle where intensity ends, for `spot`"},
                {"flux_lm", "number", "lm", "", "(0, 1e12]", "luminous flux"},
                {"flux_w", "number", "W", "", "(0, 1e12]",
                 "radiant flux between 380 and 780 nm; instead of `flux_lm`"},
                {"luminance_cd_m2", "number", "cd/m2", "", "(0, 1e12]",
                 "luminance of a Lambertian surface, flux = pi L area; instead of `flux_lm`"}},
               operation_keys()),
           {repeat_key(),
            {"body_material", "text", "", "", "",
             "material of its body; without it returning light passes"}})},
      {"emitter.point", "`[[emitter]]` with `shape = \"point\"`", aim_keys()},
      {"emitter.rectangle", "`[[emitter]]` with `shape = \"rectangle\"`",
       joined(aim_keys(),
              {{"size", "pair", "m", "required", "(0, 1e5]", "extent along local x and y"}})},
      {"emitter.disc", "`[[emitter]]` with `shape = \"disc\"`",
       joined(aim_keys(), {{"diameter", "number", "m", "required", "(0, 1e5]", "diameter"}})},
      {"emitter.sphere", "`[[emitter]]` with `shape = \"sphere\"`",
       joined(aim_keys(), {{"diameter", "number", "m", "required", "(0, 1e5]", "diameter"}})},
      {"emitter.tube",
       "`[[emitter]]` with `shape = \"tube\"`: the side of a cylinder along local x",
       joined(aim_keys(), {{"length", "number", "m", "required", "(0, 1e5]", "length"},
                           {"diameter", "number", "m", "required", "(0, 1e5]", "diameter"}})},
      {"emitter.mesh",
       "`[[emitter]]` with `shape = \"mesh\"`",
       {
           {"file", "path", "", "required", "", "OBJ or glTF 2.0 file"},
           {"units", "choice", "", "required", "m, cm, mm, km, in, ft",
            "unit of length of the file"},
           {"up", "choice", "", "required", "y, z", "axis that points up in the file"},
           {"translate", "point", "m", "[0, 0, 0]", "[-1e7, 1e7]", "moved by, after the turn"},
           {"rotate_deg", "point", "deg", "[0, 0, 0]", "[-360, 360]",
            "turned about the scene's x, then y, then z axis"},
           {"scale", "scale", "", "1", "[1e-6, 1e6]", "scaled first: one number or three"},
       }},
  };
}

TableSpec sign_keys() {
  return {
      "sign",
      "`[[sign]]`: a safety sign",
      {
          {"name", "name", "", "required", "", "name of the sign"},
          {"type", "text", "", "", "",
           "name of a `[[sign_type]]`, whose keys it has but for those that it says itself"},
          ifc_guid_key(),
          {"position", "point", "m", "required", "[-1e7, 1e7]", "centre of the sign"},
          {"facing", "direction", "", "required", "[-1e7, 1e7]", "where its (front) face looks"},
          {"up", "direction", "", "[0, 0, 1]", "[-1e7, 1e7]", "what is up on the face"},
          {"width", "number", "m", "required", "[0.01, 20]", "width of the face"},
          {"height", "number", "m", "required", "[0.01, 20]", "height of the face"},
          {"double_sided", "flag", "", "false", "", "the same face behind"},
          {"thickness", "number", "m", "0.03", "[0, 1]", "between the two faces"},
          {"file", "path", "", "", "", "pictogram, SVG or PNG; instead of `text` or `plain`"},
          {"text", "text", "", "", "", "legend, one line; instead of `file` or `plain`"},
          {"plain", "text", "", "", "",
           "name of the colour of a face of one colour; instead of `file` or `text`"},
          {"legend", "text", "", "", "",
           "name of the legend's colour. Unless said: white on a face of white and green; else, of "
           "the two colours that cover most of a drawing, the one that covers less"},
          {"ground", "text", "", "", "",
           "name of the colour that the legend stands on; unless said the other of two colours, or "
           "the one that covers most of a drawing"},
          {"colours", "tables", "", "", "",
           "the colours of its face, see `[[sign.colours]]`; unless said white and green, by the "
           "eight keys with their names"},
          {"letter_height", "number", "m", "0.1524", "[0.001, 10]", "of `text` (6 in, NFPA 101)"},
          {"stroke", "number", "m", "0.01905", "[1e-4, 2]", "of `text`; at most 0.2 of the height"},
          {"spacing", "number", "m", "0.009525", "[0, 2]",
           "clear gap between the letters of `text`"},
          {"texels", "integer", "", "256", "[8, 2048]", "texels across the face"},
          {"smallest_detail", "number", "m", "", "[1e-4, 10]",
           "smallest detail that must be seen to read it; mandatory with `file` and `plain`, the "
           "stroke "
           "with `text`"},
          {"lighting", "choice", "", "\"internal\"", "internal, external, photoluminescent",
           "where its light comes from"},
          {"mains_white", "number", "cd/m2", "", "[0, 1e6]",
           "luminance of white along the normal in mains operation; mandatory with `internal`"},
          {"mains_green", "number", "cd/m2", "", "[0, 1e6]", "of green; mandatory with `internal`"},
          {"emergency_white", "number", "cd/m2", "", "[0, 1e6]",
           "luminance of white in emergency operation, at the end of the rated duration (at "
           "failure, with "
           "`photoluminescent`); mandatory with `internal` and `photoluminescent`"},
          {"emergency_green", "number", "cd/m2", "", "[0, 1e6]",
           "of green; mandatory with `internal` and `photoluminescent`"},
          {"duration_h", "number", "h", "", "(0, 1000]",
           "how long the emergency supply of an `internal` sign lasts: from then on after the "
           "failure it is dark; lit for as long as is asked for unless said"},
          {"luminance_map", "path", "", "", "", "PNG of the brightness pattern over the face"},
          {"angular_exponent", "number", "", "0", "[0, 20]",
           "luminance ~ cos^n of the angle from the normal; 0: Lambertian"},
          {"decay", "pairs", "", "", "[0, 1]",
           "rows [seconds after failure, share of the luminance], ascending from 0; mandatory with "
           "`photoluminescent`"},
          {"white_spectrum", "emission", "", "\"led 4000 K\"", "[0, 1e9]",
           "shape of white's spectrum"},
          {"green_spectrum", "emission", "", "", "[0, 1e9]",
           "shape of green's spectrum; unless said that of white through a film of the colour sRGB "
           "#237F52"},
          {"white_reflectance", "reflectance", "", "0.7", "[0, 1]", "reflectance of white"},
          {"green_reflectance", "reflectance", "", "0.15", "[0, 1]", "reflectance of green"},
          {"circuit", "name", "", "", "", "circuit it hangs on"},
          {"group", "name", "", "", "", "source group with tallies of its own"},
          {"leads_to", "tables", "", "", "",
           "routes that it belongs to, see below; needed where guidance is assessed over time"},
      }};
}

TableSpec sign_colour_keys() {
  return {
      "sign.colours",
      "`[[sign.colours]]`: a colour of a sign's face, at most 8",
      {{"name", "name", "", "required", "",
        "name of the colour; white, green, red, blue, yellow and black are those of ISO 3864"},
       {"drawn", "text", "", "", "",
        "how the drawing prints it, such as \"#9B2423\"; mandatory for other names. A pixel has "
        "the "
        "colour that is nearest in CIE Lab, up to 35 away"},
       {"mains", "number", "cd/m2", "", "[0, 1e6]",
        "luminance along the normal in mains operation; mandatory with `internal`"},
       {"emergency", "number", "cd/m2", "", "[0, 1e6]",
        "luminance along the normal in emergency operation, as `emergency_white`; mandatory with "
        "`internal` and `photoluminescent`"},
       {"spectrum", "emission", "", "\"led 4000 K\"", "[0, 1e9]",
        "shape of its spectrum; unless said that of the default through a film of the colour "
        "`drawn`, for white the default itself"},
       {"reflectance", "reflectance", "", "", "[0, 1]",
        "reflectance; unless said that of a paint of the colour `drawn`"}}};
}

Keys optics_keys() {
  return {
      {"extinction", "course", "1/m", "", "[0, 1e6]",
       "extinction; exactly one of this and the next six keys"},
      {"od_per_m", "course", "1/m", "", "[0, 1e6]", "optical density per metre, x ln 10"},
      {"db_per_m", "course", "dB/m", "", "[0, 1e6]", "decibel per metre, x ln 10 / 10"},
      {"percent_per_m", "course", "%", "", "[0, 100)", "share lost in a metre: -ln(1 - p/100)"},
      {"percent_per_ft", "course", "%", "", "[0, 100)",
       "share lost in a foot: -ln(1 - p/100) / 0.3048"},
      {"soot_density", "course", "kg/m3", "", "[0, 100]", "soot, x `mass_extinction`"},
      {"extinction_table", "spectrum", "1/m", "", "[0, 1e6]",
       "extinction by wavelength: rows [nm, 1/m]"},
      {"mass_extinction", "number", "m2/kg", "", "(0, 1e6]",
       "of `soot_density`; 8700 with `smoke = \"flaming\"`, else mandatory"},
      {"smoke", "choice", "", "", "flaming, smouldering",
       "kind of smoke; chooses defaults of `mass_extinction` and `angstrom`"},
      {"wavelength_nm", "number", "nm", "633", "[200, 5000]", "at which the extinction is said"},
      {"angstrom", "number", "", "", "[-2, 6]",
       "extinction ~ wavelength^-angstrom; 1 with `smoke = \"flaming\"`, else 0"},
      {"albedo", "reflectance", "", "required", "[0, 1]", "share of the extinction that scatters"},
      {"phase", "choice", "", "\"isotropic\"", "isotropic, hg, rayleigh, table",
       "phase function; `hg`: Henyey-Greenstein"},
      {"g", "number", "", "", "[-0.9999, 0.9999]", "mean cosine; mandatory with `hg`"},
      {"phase_table", "pairs", "", "", "[0, 1e9]",
       "rows [cosine, relative density per solid angle], from -1 to 1; mandatory with `table`"},
  };
}

Keys footprint_keys() {
  return {
      {"polygon", "corners", "m", "", "[-1e7, 1e7]",
       "corners [x, y] of the ground it stands over; everywhere unless this or `box`"},
      {"box", "corners", "m", "", "[-1e7, 1e7]",
       "two opposite corners [x, y] of the ground it stands over"},
  };
}

Keys placed_keys() {
  return {
      {"position", "point", "m", "required", "[-1e7, 1e7]", "origin of its local coordinates"},
      {"rotate_deg", "point", "deg", "[0, 0, 0]", "[-360, 360]",
       "turned about the scene's x, then y, then z axis"},
      {"emission", "table", "", "", "", "its own light: flames"},
  };
}

std::vector<TableSpec> medium_keys() {
  return {
      {"medium",
       "`[[medium]]`: smoke and flames",
       {
           {"name", "name", "", "required", "", "name of the medium"},
           {"kind", "choice", "", "required", "homogeneous, layered, bounded, data_set, fds",
            "where it is: everywhere, in horizontal slabs, in a body, in a box of cells, in the "
            "meshes of a fire simulation"},
       }},
      {"medium.optics", "Optics of a homogeneous or bounded medium, or of a layer", optics_keys()},
      {"medium.homogeneous", "`[[medium]]` with `kind = \"homogeneous\"`, besides the optics",
       joined({{"z_low", "number", "m", "", "[-1e7, 1e7]", "lower end; none unless said"},
               {"z_high", "number", "m", "", "[-1e7, 1e7]", "upper end; none unless said"}},
              footprint_keys())},
      {"medium.layered", "`[[medium]]` with `kind = \"layered\"`",
       joined({{"layer", "tables", "", "required", "", "slabs, see below"}}, footprint_keys())},
      {"medium.layer",
       "`[[medium.layer]]`, besides the optics",
       {
           {"z_low", "course", "m", "required", "[-1e7, 1e7]", "lower end"},
           {"z_high", "course", "m", "required", "[-1e7, 1e7]", "upper end; layers do not overlap"},
       }},
      {"medium.bounded", "`[[medium]]` with `kind = \"bounded\"`, besides the optics",
       joined({{"body", "choice", "", "required", "ellipsoid, cylinder, cone, paraboloid, quadric",
                "shape of the body"}},
              placed_keys())},
      {"medium.ellipsoid",
       "`body = \"ellipsoid\"`, centred",
       {{"radii", "point", "m", "required", "[1e-4, 1e6]", "half axes along local x, y, z"}}},
      {"medium.cylinder",
       "`body = \"cylinder\"`, from local z = 0 up",
       {{"radius", "number", "m", "required", "[1e-4, 1e6]", "radius"},
        {"height", "number", "m", "required", "[1e-4, 1e6]", "height"}}},
      {"medium.cone",
       "`body = \"cone\"`, from local z = 0 up",
       {{"radius", "number", "m", "required", "[1e-4, 1e6]", "radius of the base at z = 0"},
        {"height", "number", "m", "required", "[1e-4, 1e6]", "height of the tip"}}},
      {"medium.paraboloid",
       "`body = \"paraboloid\"`, from local z = 0 up to its vertex",
       {{"radius", "number", "m", "required", "[1e-4, 1e6]", "radius of the base at z = 0"},
        {"height", "number", "m", "required", "[1e-4, 1e6]", "height of the vertex"}}},
      {"medium.quadric",
       "`body = \"quadric\"`: x.Ax + b.x + c <= 0 in local coordinates",
       {{"a", "numbers", "1/m2", "required", "[-1e12, 1e12]",
         "[xx, yy, zz, xy, xz, yz] of A, where xy stands for A12 = A21"},
        {"b", "point", "1/m", "[0, 0, 0]", "[-1e12, 1e12]", "linear coefficients"},
        {"c", "number", "", "required", "[-1e12, 1e12]", "constant"},
        {"clip", "tables", "", "", "", "half spaces that cut it"},
        {"low", "point", "m", "required", "[-1e6, 1e6]",
         "lower corner of a box that holds the body"},
        {"high", "point", "m", "required", "[-1e6, 1e6]", "upper corner of that box"}}},
      {"medium.clip",
       "`[[medium.clip]]`: keeps normal.x <= offset",
       {{"normal", "direction", "", "required", "[-1e7, 1e7]", "points out of what is kept"},
        {"offset", "number", "m", "required", "[-1e7, 1e7]", "distance from the local origin"}}},
      {"medium.emission",
       "`[medium.emission]`: light of flames",
       {
           {"power_w", "course", "W", "required", "[0, 1e12]",
            "radiant power over all wavelengths"},
           {"temperature_k", "number", "K", "required", "[600, 6000]", "of Planck's law"},
           {"emissivity", "choice", "", "\"soot\"", "soot, black",
            "`soot`: emissivity ~ 1/wavelength; `black`: constant"},
           {"circuit", "name", "", "", "", "circuit that scenarios may scale it by"},
           {"group", "name", "", "", "", "source group with tallies of its own"},
       }},
  };
}

TableSpec sign_type_keys() {
  return {"sign_type", "`[[sign_type]]`: what several signs have in common",
          joined({{"name", "name", "", "required", "", "name of the type"}}, sign_body_keys())};
}

}  // namespace

std::vector<KeySpec> sign_body_keys() {
  std::vector<KeySpec> out;
  for (KeySpec key : sign_keys().keys) {
    if (key.name == "name" || key.name == "position" || key.name == "facing" ||
        key.name == "type" || key.name == "ifc_guid" || key.name == "leads_to")
      continue;
    if (key.fallback == "required") key.fallback = "";
    out.push_back(key);
  }
  return out;
}

std::vector<TableSpec> light_schema() {
  std::vector<TableSpec> all = luminaire_keys();
  all.push_back(sign_keys());
  all.push_back(sign_type_keys());
  all.push_back(sign_colour_keys());
  all.push_back({"sign.leads_to",
                 "`[[sign.leads_to]]`: a route that a sign belongs to",
                 {{"route", "text", "", "required", "", "name of the route"},
                  {"arrow", "choice", "", "required", "left, right, ahead",
                   "where the arrow of the front points, as its reader sees it; `ahead`: on past "
                   "the sign, or through the door below it. An arrow to the left or right points "
                   "the same way on the back of a double-sided sign, one ahead away from its "
                   "reader"}}});
  for (auto& t : medium_keys()) all.push_back(std::move(t));
  for (auto& t : data_set_schema()) all.push_back(std::move(t));
  return all;
}

}  // namespace luxodus
