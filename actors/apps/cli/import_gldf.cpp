// luxodus import gldf: lists the content of a manufacturer's container, and writes tables of a
// scene that name it.
#include <fmt/format.h>

#include <set>
#include <vector>

#include "actors/apps/cli/command.hpp"
#include "actors/apps/cli/commands.hpp"
#include "actors/apps/cli/progress_line.hpp"
#include "actors/import/import_files.hpp"
#include "actors/import/luminaire_body.hpp"
#include "runtime/core/atomic_file.hpp"
#include "runtime/core/printable.hpp"
#include "runtime/core/reading_share.hpp"
#include "scenes/formats/photometry/gldf.hpp"

namespace luxodus::cli {

namespace {

namespace fs = std::filesystem;

struct ImportGldfOptions {
  std::string file;
  std::string out;
};

std::string lumens(const std::optional<double>& flux) {
  return flux ? fmt::format("{:.6g} lm", *flux) : std::string("not said");
}

/// Describes the light's flux on emergency supply.
std::string emergency_words(const GldfLight& light) {
  if (light.emergency_lm) return lumens(light.emergency_lm);
  if (light.ballast_factor) return fmt::format("{:.6g} of the rated flux", *light.ballast_factor);
  return light.behaviour == "EmergencyOnly" ? "the rated flux" : "not said";
}

std::string duration_words(const GldfVariant& variant) {
  std::string out;
  for (const GldfDuration& row : variant.durations)
    out += fmt::format("{}{:g} h {:.6g} lm", out.empty() ? "" : ", ", row.hours, row.flux_lm);
  return out;
}

/// Describes the body of the luminaire in a scene; "" if the container has no shape of it.
std::string body_words(const GldfProduct& product, const GldfVariant& variant) {
  std::string out;
  if (variant.model) {
    const GldfModel& model = product.models[*variant.model];
    const std::string who = "  body: model \"" + printable(model.file) + "\"";
    if (model.fault.empty())
      return who + fmt::format(" of {} part{}\n", model.shape.parts.size(),
                               model.shape.parts.size() == 1 ? "" : "s");
    out = who + " is not read: " + printable(model.fault) + "\n";
  }
  if (!variant.housing) return out;
  const glm::dvec3 size = variant.housing->size_m;
  return out + fmt::format("  body: {}, {:.6g} x {:.6g} x {:.6g} m\n",
                           variant.housing->round ? "cylinder" : "box", size.x, size.y, size.z);
}

void list_contents(const GldfProduct& product) {
  std::string out =
      fmt::format("product       {}\nnumber        {}\nmanufacturer  {}\n", printable(product.name),
                  printable(product.number), printable(product.manufacturer));
  for (const GldfVariant& variant : product.variants) {
    out += fmt::format("variant \"{}\"{}{}\n", printable(variant.id),
                       variant.name.empty() ? "" : ": ", printable(variant.name));
    for (const size_t at : variant.lights) {
      const GldfLight& light = product.lights[at];
      out += fmt::format("  emitter \"{}\": {}, rated {}, in an emergency {}{}\n",
                         printable(light.emitter), printable(light.photometry),
                         lumens(light.rated_lm), emergency_words(light),
                         light.fault.empty() ? "" : "; " + printable(light.fault));
    }
    if (!variant.durations.empty())
      out += "  emergency flux by duration: " + duration_words(variant) + "\n";
    out += body_words(product, variant);
  }
  std::printf("%s", out.c_str());
}

/// A model of the product, written to the folder.
struct WrittenBody {
  std::string file;   // name within the folder
  std::string fault;  // why it was not written; "" if it was
  LuminaireBody body;
};

/// Writes the bodies of the product's models.
/// Errors: a file that cannot be written. A model that cannot be read becomes a fault in its place.
Result<std::vector<WrittenBody>> write_bodies(const GldfProduct& product, const fs::path& folder) {
  ReadingShare share;
  for (const GldfModel& model : product.models)
    if (model.fault.empty()) foresee_body(model.shape, share);
  const WaitingLine waiting("reading the models of " + product.file, &share);
  std::vector<WrittenBody> out;
  std::set<std::string> taken;
  for (const GldfModel& model : product.models) {
    WrittenBody& body = out.emplace_back();
    body.fault = model.fault;
    if (!body.fault.empty()) continue;
    auto mesh = luminaire_body(model.shape, &share);
    if (!mesh) {
      body.fault = mesh.problem().what;
      continue;
    }
    body.body = std::move(mesh).value();
    const std::string wish = as_name(fs::path(model.file).stem().string(), "body");
    body.file = wish + ".obj";
    for (int i = 2; !taken.insert(body.file).second; ++i)
      body.file = fmt::format("{} {}.obj", wish, i);
    if (auto ok = write_body(body.body, folder / body.file); !ok) return ok.problem();
  }
  return out;
}

/// An import of a model whose luminous opening is at the luminaire.
std::string model_text(const WrittenBody& body, const L3dModel& model, const std::string& opening,
                       const std::string& name, double x) {
  const BodyPlace place = body_place(model, body.body.mesh, opening);
  const glm::dvec3 at = place.offset_m + glm::dvec3(x, 0, 3);
  std::string out;
  if (place.below_m > 0)
    out = fmt::format(
        "\n# It reaches {:.3g} m below its luminous opening and hides light there, which the\n"
        "# intensities of the file lack already: leave it out where that counts.",
        place.below_m);
  if (place.down.z >= straight_down)
    out += fmt::format(
        "\n# Its luminous opening shines along [{:.3g}, {:.3g}, {:.3g}]; the luminaire does not "
        "yet.",
        place.down.x, place.down.y, place.down.z);
  return out + fmt::format(
                   "\n[[import]]\nname = {}\nfile = {}\nunits = \"m\"\nup = \"z\"\n"
                   "{}\none_patch = true\ntranslate = [{:.6g}, {:.6g}, {:.6g}]\n",
                   toml_text(name + " housing"), toml_text(body.file),
                   body.body.is_coloured() ? "file_colours = true" : "material = \"white70\"", at.x,
                   at.y, at.z);
}

/// The housing as an object that stands on the luminous opening, a millimetre above it, so that it
/// blocks no light that goes down.
std::string housing_text(const GldfVariant& variant, const std::string& name, double x) {
  constexpr double gap_m = 1e-3, z = 3 + gap_m;
  if (!variant.housing) return {};
  const glm::dvec3 size = variant.housing->size_m;
  const std::string head = fmt::format("\n[[object]]\nname = {}\nmaterial = \"white70\"\n",
                                       toml_text(name + " housing"));
  if (variant.housing->round)
    return head + fmt::format(
                      "shape = \"cylinder\"\nradius = {:.6g}\nheight = {:.6g}\n"
                      "translate = [{:.6g}, 0, {:.6g}]\n",
                      size.x / 2, size.z, x, z);
  return head + fmt::format(
                    "shape = \"box\"\nlow = [{:.6g}, {:.6g}, {:.6g}]\n"
                    "high = [{:.6g}, {:.6g}, {:.6g}]\n",
                    x - size.x / 2, -size.y / 2, z, x + size.x / 2, size.y / 2, z + size.z);
}

std::string luminaire_text(const GldfVariant& variant, const GldfLight& light,
                           const std::string& name, const std::string& container, double x) {
  std::string out = fmt::format(
      "\n[[luminaire]]\nname = {}\nfile = {}\nvariant = {}\nemitter = {}\n"
      "position = [{:g}, 0, 3]\n",
      toml_text(name), container, toml_text(variant.id), toml_text(light.emitter), x);
  if (light.rotation_deg != glm::dvec3(0))
    out += fmt::format("# The container turns this emitter by [{:g}, {:g}, {:g}] degrees.\n",
                       light.rotation_deg.x, light.rotation_deg.y, light.rotation_deg.z);
  const bool knows = light.emergency_lm || light.ballast_factor;
  if (!knows && light.behaviour != "EmergencyOnly" && variant.durations.empty()) return out;
  out += fmt::format(
      "# On emergency supply: {}. State ageing and battery to have it lit then:\n"
      "# emergency = \"{}\"\n# maintenance_factor = \n# end_of_duration_factor = \n",
      emergency_words(light), light.behaviour == "EmergencyOnly" ? "non-maintained" : "maintained");
  if (!variant.durations.empty())
    out += "# duration_h = " + fmt::format("{:g}", variant.durations.front().hours) +
           "  # there are: " + duration_words(variant) + "\n";
  return out;
}

/// The body of the luminaire: the model, else the box or cylinder.
std::string body_text(const GldfProduct& product, const std::vector<WrittenBody>& bodies,
                      const GldfVariant& variant, size_t light, const std::string& name, double x) {
  if (!variant.model) return housing_text(variant, name, x);
  const WrittenBody& body = bodies[*variant.model];
  const GldfModel& model = product.models[*variant.model];
  if (body.fault.empty()) return model_text(body, model.shape, variant.openings[light], name, x);
  return fmt::format("\n# Its model {} is left out: {}\n", as_name(model.file, "without a name"),
                     as_name(body.fault, "it cannot be read")) +
         housing_text(variant, name, x);
}

/// Tables of all available lights, in a row.
std::string luminaires_text(const GldfProduct& product, const std::vector<WrittenBody>& bodies,
                            const std::string& container) {
  std::string out = fmt::format(
      "# {}, {}, {}\n"
      "# Made by `luxodus import gldf`, which writes this file anew: copy its tables to your scene "
      "and\n# give them their places. Here they hang in a row.\n",
      as_name(product.name, "a product"), as_name(product.number, "no number"),
      as_name(product.manufacturer, "no manufacturer"));
  std::set<std::string> taken;
  double x = 0;
  for (const GldfVariant& variant : product.variants) {
    for (size_t place = 0; place < variant.lights.size(); ++place) {
      const GldfLight& light = product.lights[variant.lights[place]];
      if (!light.fault.empty()) {
        out += "\n# Left out: " + as_name(light.emitter, "an emitter") + ": " +
               as_name(light.fault, "") + "\n";
        continue;
      }
      const std::string wish = as_name(
          variant.lights.size() > 1 ? variant.id + " " + light.emitter : variant.id, "luminaire");
      std::string name = wish;
      for (int i = 2; !taken.insert(name).second; ++i) name = fmt::format("{} {}", wish, i);
      out += luminaire_text(variant, light, name, container, x);
      out += body_text(product, bodies, variant, place, name, x);
      x += 2;
    }
  }
  return out;
}

Result<ExitCode> import_gldf(const ImportGldfOptions& options) {
  const auto product = [&] {
    ReadingShare share;
    const WaitingLine waiting("reading " + options.file, &share);
    return read_gldf(options.file, GldfModels::read, &share);
  }();
  if (!product) return product.problem();
  list_contents(product.value());
  if (options.out.empty()) return ExitCode::success;
  const auto container = quoted_from(options.out, options.file);
  if (!container) return container.problem();
  const auto folder = import_folder(options.out);
  if (!folder) return folder.problem();
  for (const GldfFile& file : product->photometry) {
    // Only the last part of a foreign name is used, so that it cannot lead out of the folder.
    const std::string name = as_name(fs::path(file.name).filename().string(), "photometry.ldt");
    if (auto ok = write_file_atomically(folder.value() / name, std::string_view(file.bytes)); !ok)
      return ok.problem();
  }
  const auto bodies = write_bodies(product.value(), folder.value());
  if (!bodies) return bodies.problem();
  for (size_t i = 0; i < bodies->size(); ++i)
    if (const WrittenBody& body = bodies.value()[i]; !body.fault.empty())
      std::printf("left out: the model \"%s\": %s\n", printable(product->models[i].file).c_str(),
                  printable(body.fault).c_str());
  const std::string text = luminaires_text(product.value(), bodies.value(), container.value());
  const fs::path tables = folder.value() / "luminaires.toml";
  if (auto ok = write_file_atomically(tables, std::string_view(text)); !ok) return ok.problem();
  std::printf("%s\n", (fs::path(options.out) / "luminaires.toml").c_str());
  return ExitCode::success;
}

}  // namespace

Command import_gldf_command() {
  const auto o = std::make_shared<ImportGldfOptions>();
  return {
      .name = "gldf",
      .summary = "List the luminaires of a GLDF container, and write tables of them",
      .options =
          {{"container", &o->file, "Container (.gldf)", {.form = Form::file, .required = true}},
           {"-o,--out",
            &o->out,
            "Folder of luminaires.toml, photometric files and bodies; without it nothing is "
            "written",
            {.form = Form::folder}}},
      .notes =
          "A scene may name the container itself, as the file of a luminaire, with 'variant' and "
          "'emitter'. Files that a container names by an address are not fetched.\n"
          "  luxodus import gldf luminaire.gldf\n"
          "  luxodus import gldf luminaire.gldf --out luminaires",
      .run = [o] { return exit_code_of(import_gldf(*o)); }};
}

}  // namespace luxodus::cli
