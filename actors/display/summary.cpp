// The lines that a run ends with on the terminal. They read result.json, not the run: what a person
// sees is what the file says.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "actors/display/report.hpp"

namespace luxodus {

namespace {

double number(const Json& j) {
  return j.is_number() ? j.get<double>() : std::nan("");
}

/// "  12.3 +- 0.4 lx", with the bound of what is computed, where there is one.
std::string measured_text(const Json& m) {
  const std::string unit = m["unit"].get<std::string>();
  std::string text = fmt::format("{:8.4g} ", number(m["value"]));
  text += m["standard_error"].is_number()
              ? fmt::format("+- {:<7.2g} {}", number(m["standard_error"]), unit)
              : unit + " (an error needs two batches)";
  if (m.contains("quadrature_bound"))
    text += fmt::format(", quadrature within {:.2g} {}", number(m["quadrature_bound"]), unit);
  return text;
}

std::string name_of(const Json& item) {
  return item["name"].get<std::string>();
}

std::string illuminances(const Json& result) {
  std::string text;
  for (const Json& p : result["planes"]) {
    text += fmt::format("  plane {:<24} min {:8.3g}  mean {}\n", name_of(p),
                        number(p["minimum"]["value"]), measured_text(p["mean_illuminance"]));
  }
  for (const Json& p : result["probes"])
    text += fmt::format("  probe {:<24} {}\n", name_of(p), measured_text(p["illuminance"]));
  return text;
}

std::string fluxes(const Json& result) {
  std::string text;
  for (const Json& g : result["surface_groups"]) {
    text += fmt::format("  surfaces {:<21} in {}  absorbed {}\n", name_of(g),
                        measured_text(g["incident"]), measured_text(g["absorbed"]));
  }
  for (const Json& c : result["counting_planes"]) {
    const Json& along = c["along_normal"];
    text += fmt::format("  through {:<22} straight {}  after collisions {}\n", name_of(c),
                        measured_text(along["uncollided"]), measured_text(along["collided"]));
  }
  return text;
}

std::string signs(const Json& result) {
  std::string text;
  for (const Json& s : result["signs"]) {
    text +=
        fmt::format("  sign {:<26} from {:<18} {:5.1f} m  white {}  green {}  surround {:.3g}\n",
                    s["sign"].get<std::string>(), s["observer"].get<std::string>(),
                    number(s["distance"]["value"]), measured_text(s["white"]["luminance_at_eye"]),
                    measured_text(s["green"]["luminance_at_eye"]),
                    number(s["surround"]["luminance_at_eye"]["value"]));
  }
  return text;
}

std::string percent(const Json& error) {
  return error["value"].is_number() ? fmt::format("{:.2g} %", 100 * number(error["value"]))
                                    : std::string("not known yet");
}

/// The errors of each kind of value, and where there is none, of what the run was judged by.
std::string errors(const Json& result) {
  if (result.contains("standard_errors_unknown"))
    return "  standard errors: " + result["standard_errors_unknown"].get<std::string>() + "\n";
  const Json& of = result["relative_errors"];
  std::string text;
  if (!result["planes"].empty()) text += ", planes at most " + percent(of["planes"]["worst"]);
  if (!result["probes"].empty())
    text += ", indirect light at probes at most " + percent(of["probes"]["worst"]);
  if (!result["signs"].empty()) {
    text += fmt::format(", signs {} in the median, {} for the worst seen",
                        percent(of["signs"]["median"]), percent(of["signs"]["worst"]));
  }
  const Json& judged = result["error_of"];
  if (!judged.empty()) {
    std::string words;
    for (const Json& word : judged) words += (words.empty() ? "" : ", ") + word.get<std::string>();
    text +=
        ", of " + words + " (what the run is judged by) " + percent(result["worst_relative_error"]);
  }
  if (text.empty()) text = ", surfaces at most " + percent(result["worst_relative_error"]);
  return "  standard errors: " + text.substr(2) + "\n";
}

std::string ledger(const Json& result) {
  const Json& l = result["ledger"];
  const double lost = std::ldexp(std::stod(l["lost"].get<std::string>()), -32);
  return fmt::format("  ledger {}; {} particles{}\n",
                     l["closes"].get<bool>() ? "closes exactly" : "DOES NOT CLOSE",
                     result["particles"].get<int64_t>(),
                     lost > 0
                         ? fmt::format(", the light of {:.3g} of them LOST: their histories do "
                                       "not end (no surface or medium takes any light)",
                                       lost)
                         : std::string());
}

/// What the run is judged by and has no light: no error tells of it.
std::string unlit(const Json& result) {
  constexpr size_t shown = 8;
  const Json& names = result["unlit"];
  if (names.empty()) return "";
  std::string text;
  for (size_t i = 0; i < std::min(names.size(), shown); ++i)
    text += (i > 0 ? ", " : "") + names[i].get<std::string>();
  if (names.size() > shown) text += fmt::format(" and {} more", names.size() - shown);
  return "  no light so far, and no part in these errors: " + text + "\n";
}

}  // namespace

std::string summary_text(const Json& result) {
  return illuminances(result) + fluxes(result) + signs(result) + ledger(result) + errors(result) +
         unlit(result);
}

}  // namespace luxodus
