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
  if (light.emergency_lamp_lm) return lumens(light.emergency_lamp_lm) + " of its lamps";
  if (light.ballast_factor) return fmt::format("{:.6g} of the rated flux", *light.ballast_factor);
  if (light.behaviour == "None") return "off";
  return light.behaviour == "EmergencyOnly" ? "the rated flux" : "not said";
}

/// Says how the container turns the light within its luminaire; "" if it does not.
std::string turn_words(const GldfLight& light) {
  std::string out;
  if (light.rotation_deg != glm::dvec3(0))
    out = fmt::format(", turned by [{:g}, {:g}, {:g}] degrees about x, y, z", light.rotation_deg.x,
                      light.rotation_deg.y, light.rotation_deg.z);
  if (light.g0_deg != 0) out += fmt::format(", turned by {:g} degrees about gamma 0", light.g0_deg);
  return out;
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
    if (model.fault.empty()) {
      out = who + fmt::format(" of {} part{}\n", model.shape.parts.size(),
                              model.shape.parts.size() == 1 ? "" : "s");
      for (const L3dShape& shape : model.shape.shapes)
        if (!shape.odd_colour.empty())
          out += "  body: \"" + printable(shape.name) + "\": " + printable(shape.odd_colour) + "\n";
      return out;
    }
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
    for (const GldfReference& reference : variant.lights) {
      const GldfLight& light = product.lights[reference.light];
      out += fmt::format("  emitter \"{}\": {}, rated {}, in an emergency {}{}{}\n",
                         printable(reference.name), printable(light.photometry),
                         lumens(light.rated_lm), emergency_words(light), turn_words(light),
                         light.fault.empty() ? "" : "; " + printable(light.fault));
    }
    if (!variant.durations.empty())
      out += "  emergency flux of the product by duration: " + duration_words(variant) + "\n";
    out += body_words(product, variant);
  }
  std::printf("%s", out.c_str());
}

/// A model of the product, written to the folder.
struct WrittenBody {
  std::string file;         // of the parts that were measured with the light; "" for none
  std::string others_file;  // of the other parts; "" for none
  std::string fault;        // why it was not written; "" if it was
  LuminaireBody body;       // all parts
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
    for (const BodyParts which : {BodyParts::measured, BodyParts::others}) {
      if (!has_parts(model.shape, which)) continue;
      const bool measured = which == BodyParts::measured;
      const std::string stem = measured ? wish : wish + " stand";
      std::string& file = measured ? body.file : body.others_file;
      file = stem + ".obj";
      for (int i = 2; !taken.insert(file).second; ++i) file = fmt::format("{} {}.obj", stem, i);
      const auto parts = luminaire_body(model.shape, nullptr, which);
      if (!parts) return parts.problem();
      if (auto ok = write_body(parts.value(), folder / file); !ok) return ok.problem();
    }
  }
  return out;
}

/// A list of names as a value of a scene.
std::string names_text(const std::vector<std::string>& names) {
  std::string out;
  for (const std::string& name : names) out += (out.empty() ? "" : ", ") + toml_text(name);
  return "[" + out + "]";
}

/// Imports of a model whose luminous opening is at `at`. The light of `lights` passes the parts
/// that were measured with it.
std::string model_text(const WrittenBody& body, const L3dModel& model, const std::string& opening,
                       const std::vector<std::string>& lights, const glm::dvec3& at) {
  const BodyPlace place = body_place(model, body.body.mesh, opening);
  const glm::dvec3 to = place.offset_m + at;
  std::string out;
  if (place.below_m > 0 && !body.others_file.empty())
    out = fmt::format(
        "\n# It reaches {:.3g} m below its luminous opening; parts that were not there when the\n"
        "# intensities were measured hide light.",
        place.below_m);
  if (place.down.z >= straight_down)
    out += fmt::format(
        "\n# Its luminous opening shines along [{:.3g}, {:.3g}, {:.3g}]; the luminaire does not "
        "yet.",
        place.down.x, place.down.y, place.down.z);
  const auto import = [&](const std::string& name, const std::string& file, bool measured) {
    out += fmt::format(
        "\n[[import]]\nname = {}\nfile = {}\nunits = \"m\"\nup = \"z\"\n"
        "{}\none_patch = true\ntranslate = [{:.6g}, {:.6g}, {:.6g}]\n",
        toml_text(name), toml_text(file),
        body.body.is_coloured() ? "file_colours = true" : "material = \"white70\"", to.x, to.y,
        to.z);
    if (measured) out += "body_of = " + names_text(lights) + "\n";
  };
  if (!body.file.empty()) import(lights.front() + " housing", body.file, true);
  if (!body.others_file.empty()) import(lights.front() + " stand", body.others_file, false);
  return out;
}

/// The housing as an object that stands on the luminous opening, a millimetre above it, so that
/// eyes below see the opening. It was measured with the light.
std::string housing_text(const GldfVariant& variant, const std::string& name, double x) {
  constexpr double gap_m = 1e-3, z = 3 + gap_m;
  if (!variant.housing) return {};
  const glm::dvec3 size = variant.housing->size_m;
  const std::string head =
      fmt::format("\n[[object]]\nname = {}\nmaterial = \"white70\"\nbody_of = {}\n",
                  toml_text(name + " housing"), names_text({name}));
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

std::string luminaire_text(const GldfVariant& variant, const GldfReference& reference,
                           const GldfLight& light, const std::string& name,
                           const std::string& container, const glm::dvec3& at) {
  std::string out = fmt::format(
      "\n[[luminaire]]\nname = {}\nfile = {}\nvariant = {}\nemitter = {}\n"
      "position = [{:.6g}, {:.6g}, {:.6g}]\n",
      toml_text(name), container, toml_text(variant.id), toml_text(reference.name), at.x, at.y,
      at.z);
  if (light.is_turned()) out += "# The container has it" + turn_words(light).substr(1) + ".\n";
  if (light.alternative > 1)
    out += "# It is built in instead of the first emitter of its id: leave one of them out.\n";
  const bool knows = light.emergency_lm || light.emergency_lamp_lm || light.ballast_factor;
  const bool only_normal = light.behaviour == "None" || (light.behaviour.empty() && !knows);
  if (only_normal || (!knows && light.behaviour != "EmergencyOnly" && variant.durations.empty()))
    return out;
  out += fmt::format(
      "# On emergency supply: {}. To have it lit then, state ageing, and what flux that is:\n"
      "# \"rated\", the least of the duration, or \"initial\" with an end_of_duration_factor.\n"
      "# emergency = \"{}\"\n# emergency_flux_is = \n# maintenance_factor = \n",
      emergency_words(light), light.behaviour == "EmergencyOnly" ? "non-maintained" : "maintained");
  if (!variant.durations.empty())
    out += "# duration_h = " + fmt::format("{:g}", variant.durations.front().hours) +
           "  # there are, for the whole product: " + duration_words(variant) + "\n";
  return out;
}

/// Writes the tables of a product's lights, in a row.
class LuminairesText {
 public:
  LuminairesText(const GldfProduct& product, const std::vector<WrittenBody>& bodies,
                 std::string container)
      : product_(product), bodies_(bodies), container_(std::move(container)) {}

  std::string text() {
    out_ = fmt::format(
        "# {}, {}, {}\n"
        "# Made by `luxodus import gldf`, which writes this file anew: copy its tables to your "
        "scene and\n# give them their places. Here they hang in a row.\n",
        as_name(product_.name, "a product"), as_name(product_.number, "no number"),
        as_name(product_.manufacturer, "no manufacturer"));
    for (const GldfVariant& variant : product_.variants) add(variant);
    return std::move(out_);
  }

 private:
  using Lights = std::vector<const GldfReference*>;

  const GldfLight& light_of(const GldfReference& reference) const {
    return product_.lights[reference.light];
  }

  /// Lights that are built in together hang at the openings of one body, if that is known.
  void add(const GldfVariant& variant) {
    Lights together;
    std::vector<Lights> groups;
    for (const GldfReference& reference : variant.lights) {
      const GldfLight& light = light_of(reference);
      if (!light.fault.empty())
        out_ += "\n# Left out: " + as_name(reference.name, "an emitter") + ": " +
                as_name(light.fault, "") + "\n";
      else if (light.alternative == 1 && has_model(variant))
        together.push_back(&reference);
      else
        groups.push_back({&reference});
    }
    if (!together.empty()) groups.insert(groups.begin(), std::move(together));
    for (const Lights& lights : groups) {
      add_group(variant, lights);
      x_ += 2;
    }
  }

  bool has_model(const GldfVariant& variant) const {
    return variant.model && bodies_[*variant.model].fault.empty();
  }

  void add_group(const GldfVariant& variant, const Lights& lights) {
    const glm::dvec3 first(x_, 0, 3);
    std::vector<std::string> names;
    for (const GldfReference* light : lights) {
      names.push_back(name_of(variant, *light));
      out_ += luminaire_text(variant, *light, light_of(*light), names.back(), container_,
                             first + from_opening(variant, *lights.front(), *light));
    }
    if (has_model(variant)) {
      const size_t model = *variant.model;
      out_ += model_text(bodies_[model], product_.models[model].shape, lights.front()->opening,
                         names, first);
      return;
    }
    if (variant.model)
      out_ += fmt::format("\n# Its model {} is left out: {}\n",
                          as_name(product_.models[*variant.model].file, "without a name"),
                          as_name(bodies_[*variant.model].fault, "it cannot be read"));
    out_ += housing_text(variant, names.front(), x_);
  }

  /// From the opening of one light to that of another; 0 where one is not known.
  glm::dvec3 from_opening(const GldfVariant& variant, const GldfReference& one,
                          const GldfReference& other) const {
    if (!has_model(variant)) return {};
    const L3dModel& model = product_.models[*variant.model].shape;
    const L3dOpening *from = opening_of(model, one.opening), *to = opening_of(model, other.opening);
    return from && to ? to->centre_m - from->centre_m : glm::dvec3(0);
  }

  std::string name_of(const GldfVariant& variant, const GldfReference& light) {
    const std::string wish = as_name(
        variant.lights.size() > 1 ? variant.id + " " + light.name : variant.id, "luminaire");
    std::string name = wish;
    for (int i = 2; !taken_.insert(name).second; ++i) name = fmt::format("{} {}", wish, i);
    return name;
  }

  const GldfProduct& product_;
  const std::vector<WrittenBody>& bodies_;
  const std::string container_;
  std::set<std::string> taken_;
  double x_ = 0;
  std::string out_;
};

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
  const std::string text =
      LuminairesText(product.value(), bodies.value(), container.value()).text();
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
