// The lines at the end of a run on the terminal. They are made from result.json, not from the run,
// so that both agree.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "actors/results/files/run_results.hpp"
#include "actors/results/files/run_state.hpp"
#include "scenes/light/world/description.hpp"

namespace luxodus {

namespace {

double number(const Json& j) {
  return j.is_number() ? j.get<double>() : std::nan("");
}

/// " 12.3 +- 0.4 lx", with the bound of the computed part, if there is one.
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

/// "0.8 at (1.2, 3, 0)": a value with its place [m].
std::string placed_text(const Json& value) {
  std::string text = fmt::format("{:.3g}", number(value["value"]));
  if (!value.contains("position")) return text;
  const Json& p = value["position"];
  return text +
         fmt::format(" at ({:.4g}, {:.4g}, {:.4g})", number(p[0]), number(p[1]), number(p[2]));
}

std::string illuminances(const Json& result) {
  std::string text;
  for (const Json& p : result["planes"]) {
    text += fmt::format("  plane {:<24} mean {}, least {}, most {}, least/mean {:.2g}\n",
                        name_of(p), measured_text(p["mean_illuminance"]), placed_text(p["minimum"]),
                        placed_text(p["maximum"]), number(p["uniformity"]["value"]));
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

/// "white 200 ± 1 %  "; nothing for a part that the face lacks.
std::string part_text(const Json& sign, const char* part) {
  if (!sign.contains(part)) return "";
  const std::string name = sign[part];
  return fmt::format("{} {}  ", name, measured_text(sign[name]["luminance_at_eye"]));
}

/// The signs that each observer sees, in the scene's order.
std::string signs(const Json& result) {
  std::vector<std::string> observers;
  for (const Json& s : result["signs"])
    if (std::find(observers.begin(), observers.end(), s["observer"]) == observers.end())
      observers.push_back(s["observer"]);
  std::string text;
  for (const std::string& observer : observers) {
    text += fmt::format("  signs from {}: luminance at the eye\n", observer);
    for (const Json& s : result["signs"]) {
      if (s["observer"] != observer) continue;
      text += fmt::format(
          "    {:<26} {:5.1f} m  {}surround {:.3g}\n",
          s["sign"].get<std::string>() + (s["back_face"].get<bool>() ? ", back" : ""),
          number(s["distance"]["value"]), part_text(s, "legend") + part_text(s, "ground"),
          number(s["surround"]["luminance_at_eye"]["value"]));
    }
  }
  return text;
}

/// A share below one is never rounded to 100 %.
std::string percent(double share) {
  if (share < 1 && share > 0.995) return fmt::format("{:.4g} %", 100 * share);
  return share < 0.0995 ? fmt::format("{:.2g} %", 100 * share)
                        : fmt::format("{:.0f} %", 100 * share);
}

std::string percent(const Json& error) {
  return error["value"].is_number() ? percent(number(error["value"])) : "not known yet";
}

/// "exit north" from "crawler", or "floor".
std::string subject_text(const Json& of) {
  if (of.contains("name")) return "\"" + name_of(of) + "\"";
  return "\"" + of["sign"].get<std::string>() + "\" from \"" + of["observer"].get<std::string>() +
         "\"";
}

/// "signs 4.4 % (median), 36 % (largest: "exit north" from "crawler")".
std::string spread_text(const char* what, const Json& spread) {
  if (!spread["worst_of"].is_object()) return std::string(what) + " without light so far";
  if (!spread["worst"]["value"].is_number()) return std::string(what) + " not known yet";
  return fmt::format("{} {} (median), {} (largest: {})", what, percent(spread["median"]),
                     percent(spread["worst"]), subject_text(spread["worst_of"]));
}

/// The errors of each kind of value, and of the target if one was chosen.
std::string errors(const Json& result) {
  if (result.contains("standard_errors_unknown"))
    return "  standard errors: " + result["standard_errors_unknown"].get<std::string>() + "\n";
  const Json& of = result["relative_errors"];
  std::string text;
  const auto add = [&](const std::string& part) { text += (text.empty() ? "" : "; ") + part; };
  if (!result["planes"].empty()) add(spread_text("planes", of["planes"]));
  if (!result["probes"].empty()) add(spread_text("indirect light at probes", of["probes"]));
  if (!result["signs"].empty()) add(spread_text("signs", of["signs"]));
  const Json& judged = result["error_of"];
  if (!judged.empty()) {
    std::string words;
    for (const Json& word : judged) words += (words.empty() ? "" : ", ") + word.get<std::string>();
    add("what the run is judged by (" + words + ") " + percent(result["worst_relative_error"]));
  }
  if (text.empty()) add("surfaces " + percent(result["worst_relative_error"]) + " (largest)");
  return "  relative standard errors: " + text + "\n";
}

/// A part's share of the emitted light; sums of 128 bits stand in result.json as text.
double share_of(const Json& balance, const char* part) {
  const double emitted = std::stod(balance["emitted"].get<std::string>());
  return emitted > 0 ? std::stod(balance[part].get<std::string>()) / emitted : 0;
}

/// "west" of "x-", as `open_sides` names it.
std::string side_word(const std::string& side) {
  if (side.size() != 2 || side[0] < 'x' || side[0] > 'z') return side;
  const auto axis = static_cast<size_t>(side[0] - 'x');
  return std::string(side_words[2 * axis + (side[1] == '+' ? 1 : 0)]);
}

/// Sides of the building's box through which light escapes, the largest first.
std::string sides_text(const Json& escape, double escaped) {
  std::vector<std::pair<double, std::string>> sides;
  double all = 0;
  for (const auto& [side, flux] : escape.items()) {
    sides.emplace_back(std::max(0.0, number(flux["value"])), side);
    all += sides.back().first;
  }
  std::sort(sides.rbegin(), sides.rend());
  std::string text;
  for (const auto& [flux, side] : sides)
    if (all > 0 && flux > 0.01 * all)
      text +=
          (text.empty() ? " (by " : ", ") + side_word(side) + " " + percent(escaped * flux / all);
  return text.empty() ? "" : text + ")";
}

/// The energy balance.
std::string whereabouts(const Json& result) {
  const Json& balance = result["ledger"];
  const double escaped = share_of(balance, "escaped"), lost = share_of(balance, "lost");
  std::string text = "  light: " + percent(share_of(balance, "absorbed_surfaces")) +
                     " absorbed by surfaces, " + percent(share_of(balance, "absorbed_media")) +
                     " by smoke, " + percent(escaped) + " escaped" +
                     (escaped > 0 ? sides_text(result["escape"], escaped) : "") + "\n";
  if (lost > 0)
    text += "  " + percent(lost) +
            " of the light is LOST: its histories do not end (no surface or medium takes any "
            "light)\n";
  if (!balance["closes"].get<bool>())
    text += "  THE ENERGY BALANCE DOES NOT CLOSE: these results are wrong; report it\n";
  return text;
}

/// Targets of the run without light, whose error is unknown.
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

std::string effort(const Json& result) {
  return fmt::format("  {} particles in {:.3g} s; stopped by: {}\n",
                     result["particles"].get<int64_t>(), number(result["seconds"]["value"]),
                     result["stopped_by"].get<std::string>());
}

/// Internals, for developers.
std::string internals(const Json& result) {
  const Json& balance = result["ledger"];
  return fmt::format(
      "  kernel: {}; {} batches of {} particles; {} threads; {:.4g} rays/s\n"
      "  energy balance (ledger, exact to 2^-32 of a particle) {}: {} rays, {} hits, {} "
      "collisions\n",
      result["kernel"].get<std::string>(), result["batches"].get<int64_t>(),
      result["batch_particles"].get<int64_t>(), result["threads"].get<int>(),
      number(result["rays_per_second"]["value"]),
      balance["closes"].get<bool>() ? "closes exactly" : "DOES NOT CLOSE",
      balance["rays"].get<uint64_t>(), balance["hits"].get<uint64_t>(),
      balance["collisions"].get<uint64_t>());
}

}  // namespace

std::string summary_text(const Json& result, bool verbose) {
  return "  " + run_state_text(result["state"]) + "\n" + illuminances(result) + fluxes(result) +
         signs(result) + whereabouts(result) + errors(result) + unlit(result) + effort(result) +
         (verbose ? internals(result) : "");
}

}  // namespace luxodus
