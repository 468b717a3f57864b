// The other process unpacks and parses. This one checks the plain values of its answer.
#include "scenes/formats/photometry/gldf.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <stdexcept>

#include "runtime/core/isolated_job.hpp"
#include "runtime/core/printable.hpp"
#include "runtime/core/reading_share.hpp"
#include "runtime/core/regular_file.hpp"
#include "scenes/formats/photometry/gldf_archive.hpp"
#include "scenes/formats/photometry/gldf_product.hpp"

namespace luxodus {
namespace {

namespace fs = std::filesystem;

/// Limits on unpacking and parsing: the container, all its contents within the limits, and
/// pugixml's tree, which takes about 20 times its text.
constexpr IsolatedLimits gldf_limits{uint64_t{768} << 20, 30};

// ---- the container -----------------------------------------------------------------------------

std::string lower(std::string_view text) {
  std::string out(text);
  std::transform(out.begin(), out.end(), out.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return out;
}

std::optional<size_t> only(const std::vector<std::string>& names, const auto& wanted) {
  std::optional<size_t> at;
  for (size_t i = 0; i < names.size(); ++i) {
    if (!wanted(names[i])) continue;
    if (at) return std::nullopt;
    at = i;
  }
  return at;
}

/// The entry of a file in a folder ("ldc/"): by its name, by its name ignoring case, or as the only
/// file with that ending, since old packers stored names in code pages that they do not state.
std::optional<size_t> entry_of(const std::vector<std::string>& names, const std::string& folder,
                               const std::string& file) {
  const std::string path = folder + file;
  const auto exact = std::find(names.begin(), names.end(), path);
  if (exact != names.end()) return static_cast<size_t>(exact - names.begin());
  const std::string small = lower(path);
  if (const auto at = only(names, [&](const std::string& n) { return lower(n) == small; }))
    return at;
  const std::string ending = lower(fs::path(file).extension().string());
  const bool ascii = std::all_of(file.begin(), file.end(),
                                 [](char c) { return static_cast<unsigned char>(c) < 0x80; });
  if (ascii || ending.empty()) return std::nullopt;
  return only(names, [&](const std::string& n) {
    return lower(n).starts_with(folder) && lower(n).ends_with(ending);
  });
}

/// Reports how much of a container is unpacked.
class UnpackProgress {
 public:
  /// Counts all photometric files, and the models if they are read.
  UnpackProgress(const GldfArchive& archive, GldfModels models,
                 const std::function<void(double)>& told)
      : archive_(archive), told_(told) {
    const auto& names = archive.names();
    for (size_t i = 0; i < names.size(); ++i)
      if (lower(names[i]).starts_with("ldc/") ||
          (models == GldfModels::read && lower(names[i]).starts_with("geo/")))
        all_ += static_cast<double>(archive.packed_bytes(i));
  }
  void took(size_t entry) {
    done_ += static_cast<double>(archive_.packed_bytes(entry));
    if (told_ && all_ > 0) told_(std::min(1.0, done_ / all_));
  }

 private:
  const GldfArchive& archive_;
  const std::function<void(double)>& told_;
  double all_ = 0, done_ = 0;  // bytes
};

/// Unpacks the photometric file of each light; a light without one gets a fault.
Result<void> take_photometry(const GldfArchive& archive, GldfProduct& product,
                             UnpackProgress& progress) {
  uint64_t all = 0;
  for (GldfLight& light : product.lights) {
    if (!light.fault.empty()) continue;
    const bool there = std::any_of(product.photometry.begin(), product.photometry.end(),
                                   [&](const GldfFile& f) { return f.name == light.photometry; });
    if (there) continue;
    const auto entry = entry_of(archive.names(), "ldc/", light.photometry);
    if (!entry) {
      light.fault =
          "its photometric file \"" + excerpt(light.photometry) + "\" is not in the container";
      continue;
    }
    auto bytes = archive.read(*entry, limits::gldf_file_bytes);
    if (!bytes) return bytes.problem();
    progress.took(*entry);
    all += bytes->size();
    if (all > limits::gldf_all_bytes)
      return problem_in(product.file, fmt::format("its photometric files are larger than {} bytes "
                                                  "when unpacked",
                                                  limits::gldf_all_bytes));
    product.photometry.push_back({light.photometry, std::move(bytes).value()});
  }
  return {};
}

/// Reads each model; one that cannot be read gets a fault.
void take_models(const GldfArchive& archive, GldfProduct& product, UnpackProgress& progress) {
  uint64_t left = limits::l3d_all_bytes;
  for (GldfModel& model : product.models) {
    if (!model.fault.empty()) continue;
    const auto entry = entry_of(archive.names(), "geo/", model.file);
    if (!entry) {
      model.fault = "it is not in the container";
      continue;
    }
    const auto bytes = archive.read(*entry, limits::gldf_file_bytes);
    auto shape = bytes ? l3d_of(bytes.value(), product.file, left) : bytes.problem();
    progress.took(*entry);
    if (!shape) {
      model.fault = shape.problem().what;
      continue;
    }
    model.shape = std::move(shape).value();
    for (const L3dShape& one : model.shape.shapes)
      left -= std::min<uint64_t>(left, one.obj.size() + one.colours.size());
  }
}

// ---- from process to process --------------------------------------------------------------------

void put(PlainWriter& out, const std::optional<double>& value) {
  out.put(static_cast<uint8_t>(value.has_value()));
  out.put(value.value_or(0));
}

bool get(PlainReader& in, std::optional<double>& value) {
  uint8_t there = 0;
  double number = 0;
  if (!in.get(there) || !in.get(number)) return false;
  value = there == 1 ? std::optional(number) : std::nullopt;
  return true;
}

template <class T, class Put>
void put_list(PlainWriter& out, const std::vector<T>& list, const Put& put_one) {
  out.put(static_cast<uint64_t>(list.size()));
  for (const T& one : list) put_one(one);
}

/// False where the list is longer than `most`, or an element is malformed.
template <class T, class Get>
bool get_list(PlainReader& in, std::vector<T>& list, uint64_t most, const Get& get_one) {
  uint64_t count = 0;
  if (!in.get(count) || count > most) return false;
  for (uint64_t i = 0; i < count; ++i)
    if (!get_one(list.emplace_back())) return false;
  return true;
}

void put(PlainWriter& out, const GldfLight& light) {
  for (const auto* text : {&light.emitter, &light.behaviour, &light.photometry, &light.fault})
    out.put(*text);
  for (const auto* number : {&light.rated_lm, &light.lamp_lm, &light.emergency_lm,
                             &light.emergency_lamp_lm, &light.ballast_factor})
    put(out, *number);
  out.put(light.rotation_deg);
  out.put(light.g0_deg);
  out.put(light.alternative);
}

bool get(PlainReader& in, GldfLight& light) {
  for (auto* text : {&light.emitter, &light.behaviour, &light.photometry, &light.fault})
    if (!in.get(*text)) return false;
  for (auto* number : {&light.rated_lm, &light.lamp_lm, &light.emergency_lm,
                       &light.emergency_lamp_lm, &light.ballast_factor})
    if (!get(in, *number)) return false;
  return in.get(light.rotation_deg) && in.get(light.g0_deg) && in.get(light.alternative) &&
         is_finite(light.rotation_deg) && std::isfinite(light.g0_deg);
}

void put(PlainWriter& out, const GldfVariant& variant) {
  out.put(variant.id);
  out.put(variant.name);
  put_list(out, variant.lights, [&](const GldfReference& reference) {
    out.put(reference.name);
    out.put(reference.light);
    out.put(reference.number);
    out.put(reference.opening);
  });
  out.put(variant.durations);
  out.put(static_cast<uint64_t>(variant.model.value_or(limits::gldf_models)));
  const GldfHousing housing = variant.housing.value_or(GldfHousing{});
  out.put(static_cast<uint8_t>(variant.housing.has_value()));
  out.put(static_cast<uint8_t>(housing.round));
  out.put(housing.size_m);
}

bool get(PlainReader& in, GldfVariant& variant, size_t all_lights) {
  uint64_t model = 0;
  uint8_t housed = 0, round = 0;
  GldfHousing housing;
  const auto get_reference = [&](GldfReference& reference) {
    return in.get(reference.name) && in.get(reference.light) && in.get(reference.number) &&
           in.get(reference.opening) && reference.light < all_lights;
  };
  if (!in.get(variant.id) || !in.get(variant.name) ||
      !get_list(in, variant.lights, limits::gldf_references, get_reference))
    return false;
  if (!in.get(variant.durations) || !in.get(model) || !in.get(housed) || !in.get(round) ||
      !in.get(housing.size_m))
    return false;
  if (model < limits::gldf_models) variant.model = model;
  housing.round = round == 1;
  if (housed == 1) variant.housing = housing;
  return true;
}

void put(PlainWriter& out, const GldfModel& model) {
  out.put(model.file);
  out.put(model.fault);
  put_list(out, model.shape.shapes, [&](const L3dShape& shape) {
    out.put(shape.name);
    out.put(shape.obj);
    out.put(shape.colours);
    out.put(shape.metres_per_unit);
    out.put(shape.odd_colour);
  });
  put_list(out, model.shape.parts, [&](const L3dPart& part) {
    out.put(part.name);
    out.put(static_cast<uint64_t>(part.shape));
    out.put(part.place);
    out.put(static_cast<uint8_t>(part.measured));
  });
  put_list(out, model.shape.openings, [&](const L3dOpening& opening) {
    out.put(opening.name);
    out.put(opening.centre_m);
    out.put(opening.down);
  });
}

bool get(PlainReader& in, GldfModel& model) {
  const auto get_shape = [&](L3dShape& shape) {
    return in.get(shape.name) && in.get(shape.obj) && in.get(shape.colours) &&
           in.get(shape.metres_per_unit) && in.get(shape.odd_colour) && shape.metres_per_unit > 0 &&
           shape.metres_per_unit <= 1;
  };
  const auto get_part = [&](L3dPart& part) {
    uint64_t shape = 0;
    uint8_t measured = 0;
    if (!in.get(part.name) || !in.get(shape) || !in.get(part.place) || !in.get(measured))
      return false;
    part.shape = shape;
    part.measured = measured == 1;
    return shape < model.shape.shapes.size() && part.place.usable();
  };
  const auto get_opening = [&](L3dOpening& opening) {
    return in.get(opening.name) && in.get(opening.centre_m) && in.get(opening.down) &&
           is_finite(opening.centre_m) && is_finite(opening.down);
  };
  return in.get(model.file) && in.get(model.fault) &&
         get_list(in, model.shape.shapes, limits::l3d_parts, get_shape) &&
         get_list(in, model.shape.parts, limits::l3d_parts, get_part) &&
         get_list(in, model.shape.openings, limits::l3d_openings, get_opening);
}

void put(PlainWriter& out, const GldfProduct& product) {
  for (const auto* text : {&product.manufacturer, &product.name, &product.number}) out.put(*text);
  put_list(out, product.lights, [&](const GldfLight& light) { put(out, light); });
  put_list(out, product.variants, [&](const GldfVariant& variant) { put(out, variant); });
  put_list(out, product.photometry, [&](const GldfFile& file) {
    out.put(file.name);
    out.put(file.bytes);
  });
  put_list(out, product.models, [&](const GldfModel& model) { put(out, model); });
}

bool get(PlainReader& in, GldfProduct& product) {
  for (auto* text : {&product.manufacturer, &product.name, &product.number})
    if (!in.get(*text)) return false;
  // Each emitter may add several at once, so the last one may exceed the limit.
  return get_list(in, product.lights, 2 * limits::gldf_lights,
                  [&](GldfLight& light) { return get(in, light); }) &&
         get_list(in, product.variants, limits::gldf_variants,
                  [&](GldfVariant& v) { return get(in, v, product.lights.size()); }) &&
         get_list(in, product.photometry, 2 * limits::gldf_lights,
                  [&](GldfFile& file) { return in.get(file.name) && in.get(file.bytes); }) &&
         get_list(in, product.models, limits::gldf_models,
                  [&](GldfModel& model) { return get(in, model); }) &&
         std::all_of(product.variants.begin(), product.variants.end(), [&](const GldfVariant& v) {
           return !v.model || *v.model < product.models.size();
         });
}

void gldf_answer(PlainReader& question, PlainWriter& out) {
  std::string path;
  GldfModels models = GldfModels::left;
  if (!question.get(path) || !question.get(models)) throw std::runtime_error("no question");
  const auto bytes = read_regular_file(path, limits::gldf_bytes);
  const auto product = bytes ? gldf_of(bytes.value(), path, models, tell_share) : bytes.problem();
  out.put(static_cast<uint8_t>(product.ok()));
  if (product) return put(out, product.value());
  out.put(product.problem());
}

const IsolatedJob gldf_job("gldf", gldf_answer);

}  // namespace

Result<GldfProduct> gldf_of(std::string_view bytes, const std::string& file, GldfModels models,
                            const std::function<void(double)>& told) {
  const auto archive = GldfArchive::open(bytes, file, "GLDF container");
  if (!archive) return archive.problem();
  const auto& names = archive->names();
  const auto at = only(names, [](const std::string& n) { return lower(n) == "product.xml"; });
  if (!at) return problem_in(file, "there is no 'product.xml' in it, so it is no GLDF container");
  const auto xml = archive->read(*at, limits::gldf_xml_bytes);
  if (!xml) return xml.problem();
  auto product = gldf_product_of(xml.value(), file);
  if (!product) return product;
  UnpackProgress progress(archive.value(), models, told);
  if (auto taken = take_photometry(archive.value(), product.value(), progress); !taken)
    return taken.problem();
  if (models == GldfModels::read) take_models(archive.value(), product.value(), progress);
  return product;
}

Result<GldfProduct> read_gldf(const fs::path& path, GldfModels models, ReadingShare* reading) {
  const std::string name = path.string();
  std::error_code unknown;
  const uint64_t size = fs::file_size(path, unknown);
  ReadingPart part(reading, unknown ? 0 : size);
  auto in = gldf_job.run(
      [&](PlainWriter& question) {
        question.put(name);
        question.put(models);
      },
      gldf_limits, [&](double share) { part.at_share(share); });
  if (!in) return problem_in(name, in.problem());
  const Problem damaged = problem_in(name, "cannot be read: the reader gave no sound answer");
  uint8_t good = 0;
  if (!in->get(good)) return damaged;
  if (good != 1) {
    Problem why;
    return in->get(why) ? problem_in(name, std::move(why)) : damaged;
  }
  GldfProduct product;
  product.file = name;
  if (!get(in.value(), product)) return damaged;
  return product;
}

}  // namespace luxodus
