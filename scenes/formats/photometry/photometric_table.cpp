#include "scenes/formats/photometry/photometric_table.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

#include "scenes/formats/photometry/photometric_text.hpp"

namespace luxodus {
namespace {

// Width of the step from the last listed value to darkness. It holds less than 1e-5 of a full
// cell's light, and a double still resolves it to eight digits.
constexpr double edge_deg = 1e-5;

// Two planes closer than this are one plane, listed twice or equal to its own mirror image.
constexpr double same_plane_deg = 1e-6;

// Planes of one measurement agree at the poles to 2 %; there light below a thousandth of the peak
// is noise.
constexpr double odd_pole_share = 0.02, faint_share = 1e-3;

double on_circle(double azimuth) {
  const double turned = azimuth - 360 * std::floor(azimuth / 360);
  return turned >= 360 - same_plane_deg ? 0.0 : turned;
}

using Planes = std::map<double, const std::vector<double>*>;

void put(Planes& planes, double azimuth, const std::vector<double>* values) {
  const double at = on_circle(azimuth);
  const auto next = planes.lower_bound(at - same_plane_deg);
  if (next != planes.end() && next->first <= at + same_plane_deg) return;
  planes.emplace(at, values);
}

/// Mirror images of a plane, itself first.
std::vector<double> images(double azimuth, WebSymmetry symmetry) {
  switch (symmetry) {
    case WebSymmetry::about_0_180:
      return {azimuth, 360 - azimuth};
    case WebSymmetry::about_90_270:
      return {azimuth, 180 - azimuth};
    case WebSymmetry::about_both:
      return {azimuth, 360 - azimuth, 180 - azimuth, 180 + azimuth};
    case WebSymmetry::none:
    case WebSymmetry::rotational:
      break;
  }
  return {azimuth};
}

}  // namespace

glm::dmat3 type_c_axes() {
  return glm::dmat3(glm::dvec3(1, 0, 0), glm::dvec3(0, 1, 0), glm::dvec3(0, 0, -1));
}

glm::dmat3 type_b_axes() {
  return glm::dmat3(glm::dvec3(0, 0, -1), glm::dvec3(1, 0, 0), glm::dvec3(0, 1, 0));
}

PhotometricTable around(const PhotometricTable& table, WebSymmetry symmetry, double gap_deg) {
  PhotometricTable whole;
  whole.polar_deg = table.polar_deg;
  if (symmetry == WebSymmetry::rotational) {
    whole.azimuth_deg = {0, 360};
    whole.columns = {table.columns.front(), table.columns.front()};
    return whole;
  }
  Planes planes;
  for (size_t a = 0; a < table.columns.size(); ++a) {
    for (double image : images(table.azimuth_deg[a], symmetry)) {
      put(planes, image, &table.columns[a]);
    }
  }
  const std::vector<double> dark(table.polar_deg.size(), 0.0);
  const Planes listed = planes;
  for (auto it = listed.begin(); it != listed.end(); ++it) {
    const bool last = std::next(it) == listed.end();
    const double following = last ? listed.begin()->first + 360 : std::next(it)->first;
    if (following - it->first <= gap_deg) continue;
    put(planes, it->first + edge_deg, &dark);
    put(planes, following - edge_deg, &dark);
  }
  // The circle must be cut at 0: where no plane is listed there, interpolation between its
  // neighbours gives one.
  std::vector<double> seam;
  if (planes.begin()->first > 0) {
    const auto [after, near] = *planes.begin();
    const auto [before, far] = *planes.rbegin();
    const double s = (360 - before) / (360 - before + after);
    for (size_t p = 0; p < dark.size(); ++p) {
      seam.push_back((1 - s) * (*far)[p] + s * (*near)[p]);
    }
    planes.emplace(0.0, &seam);
  }
  for (const auto& [azimuth, values] : planes) {
    whole.azimuth_deg.push_back(azimuth);
    whole.columns.push_back(*values);
  }
  whole.azimuth_deg.push_back(360);
  whole.columns.push_back(whole.columns.front());
  return whole;
}

PhotometricTable pole_to_pole(PhotometricTable table) {
  std::vector<double>& polar = table.polar_deg;
  const auto add = [&table](bool in_front, double angle) {
    std::vector<double>& angles = table.polar_deg;
    angles.insert(in_front ? angles.begin() : angles.end(), angle);
    for (auto& column : table.columns) {
      column.insert(in_front ? column.begin() : column.end(), 0.0);
    }
  };
  if (polar.front() > 2 * edge_deg) {
    add(true, polar.front() - edge_deg);
    add(true, 0);
  }
  if (polar.back() < 180 - 2 * edge_deg) {
    add(false, polar.back() + edge_deg);
    add(false, 180);
  }
  polar.front() = 0;
  polar.back() = 180;
  return table;
}

Result<std::shared_ptr<const PhotometricWeb>> web_of(const PhotometricTable& table,
                                                     const glm::dmat3& axes,
                                                     const SourcePlace& where) {
  std::vector<double> candela;
  candela.reserve(table.azimuth_deg.size() * table.polar_deg.size());
  for (const auto& column : table.columns) {
    candela.insert(candela.end(), column.begin(), column.end());
  }
  auto web = PhotometricWeb::make(table.azimuth_deg, table.polar_deg, std::move(candela), axes);
  if (!web) return problem_in(where, web.problem());
  return std::shared_ptr<const PhotometricWeb>(
      std::make_shared<PhotometricWeb>(std::move(web).value()));
}

std::optional<std::string> odd_pole(const PhotometricTable& table) {
  double peak = 0;
  for (const auto& column : table.columns)
    peak = std::max(peak, *std::max_element(column.begin(), column.end()));
  const auto at = [&](size_t row, const char* where) -> std::optional<std::string> {
    double least = peak, most = 0;
    for (const auto& column : table.columns) {
      least = std::min(least, column[row]);
      most = std::max(most, column[row]);
    }
    if (most <= faint_share * peak || most - least <= odd_pole_share * most) return std::nullopt;
    return std::string("straight ") + where + " the planes state " + shown(least) + " to " +
           shown(most) +
           " cd for one and the same direction: planes of different measurements, or " +
           "a wrong factor?";
  };
  if (table.polar_deg.front() < same_plane_deg)
    if (auto odd = at(0, "down (nadir)")) return odd;
  if (table.polar_deg.back() > 180 - same_plane_deg)
    return at(table.polar_deg.size() - 1, "up (zenith)");
  return std::nullopt;
}

std::optional<double> missing_deg(const std::vector<double>& azimuth_deg) {
  constexpr double rounding_deg = 0.01;
  if (azimuth_deg.size() < 2) return std::nullopt;
  double widest = 0;
  for (size_t a = 1; a < azimuth_deg.size(); ++a)
    widest = std::max(widest, azimuth_deg[a] - azimuth_deg[a - 1]);
  const double gap = 360 - (azimuth_deg.back() - azimuth_deg.front());
  return gap > widest + rounding_deg ? std::optional(gap) : std::nullopt;
}

std::optional<std::string> odd_step(const std::vector<double>& azimuth_deg) {
  constexpr double wide_deg = 45, times_usual = 3;
  if (azimuth_deg.size() < 4) return std::nullopt;
  std::vector<double> steps;
  for (size_t a = 1; a < azimuth_deg.size(); ++a)
    steps.push_back(azimuth_deg[a] - azimuth_deg[a - 1]);
  const auto widest = std::max_element(steps.begin(), steps.end());
  const auto at = static_cast<size_t>(widest - steps.begin());
  const double wide = *widest;
  std::nth_element(steps.begin(), steps.begin() + static_cast<ptrdiff_t>(steps.size() / 2),
                   steps.end());
  if (wide < wide_deg || wide < times_usual * steps[steps.size() / 2]) return std::nullopt;
  return "between the planes " + shown(azimuth_deg[at]) + " and " + shown(azimuth_deg[at + 1]) +
         " degrees, a step far wider than the others, the intensities are made up from these two: "
         "are planes missing?";
}

double down_share_of(const PhotometricWeb& web) {
  constexpr int polar_steps = 360;
  constexpr int azimuth_steps = 360;
  constexpr double pi = std::numbers::pi;
  double down = 0;
  double all = 0;
  for (int p = 0; p < polar_steps; ++p) {
    const double polar = (p + 0.5) * pi / polar_steps;
    double ring = 0;
    for (int a = 0; a < azimuth_steps; ++a) {
      const double azimuth = (a + 0.5) * 2 * pi / azimuth_steps;
      ring += web.intensity({std::sin(polar) * std::cos(azimuth),
                             std::sin(polar) * std::sin(azimuth), -std::cos(polar)});
    }
    all += ring * std::sin(polar);
    if (polar < pi / 2) down += ring * std::sin(polar);
  }
  return all > 0 ? down / all : 0;
}

}  // namespace luxodus
