// Batch k has equal histories in both builds, so that a bin's differences d_k are small and mostly
// zero, and their mean is much more accurate than the bin itself. A history that takes another path
// because of rounding (it hits the other side of an edge) makes d_k large now and then; that is
// random, too, and is part of the standard error of the mean difference.
#include "tests/precision/compare.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>
#include <sstream>
#include <stdexcept>

namespace luxodus::precision {

namespace {

constexpr double particles = 1e9;
/// A difference is far below the statistical error if it is a tenth of it: errors add as squares,
/// so it adds half a percent.
constexpr double far_below = 0.1;
/// Limit for the difference's own standard error, in statistical errors of 1e9 particles: beyond it
/// the comparison proves nothing and needs more particles.
constexpr double sharp_enough = 0.1;
/// There are many bins: one of a thousand lies beyond 3.3 standard errors by chance.
constexpr double chance = 4;
/// The variance of a bin that few batches reach is unreliable.
constexpr double min_share_of_batches = 0.5;

struct Mean {
  double value = 0, error = 0;
};

template <class Of>
Mean mean_over(size_t batches, Of&& of) {
  const auto n = static_cast<double>(batches);
  double sum = 0;
  for (size_t k = 0; k < batches; ++k) sum += of(k);
  const double mean = sum / n;
  double squares = 0;
  for (size_t k = 0; k < batches; ++k) squares += (of(k) - mean) * (of(k) - mean);
  return {mean, std::sqrt(squares / (n - 1) / n)};
}

/// One line of the table.
struct Line {
  int bins = 0;
  double statistical = 0;  // mean square of relative errors at 1e9 particles
  double difference = 0;   // mean square of relative differences
  double ratio = 0;        // mean square of difference over statistical error
  double sharpness = 0;  // mean square of the difference's standard error over the statistical one
  double worst_ratio = 0, worst_sharpness = 0, worst_z = 0;
  bool passes = true;
};

void require_same(const Traced& a, const Traced& b) {
  if (a.precision != "single" || b.precision != "double")
    throw std::runtime_error("one file of each build is needed, that in single precision first");
  if (a.scene != b.scene || a.batch_particles != b.batch_particles || a.names != b.names ||
      a.rows.size() != b.rows.size() || a.rows.size() < 2)
    throw std::runtime_error("the files are of different scenes, bins or batches");
}

}  // namespace

void write(const Traced& traced, const std::filesystem::path& file) {
  std::ofstream out(file);
  out << traced.precision << '\n' << traced.scene << '\n';
  out << fmt::format("{} {} {}\n", traced.batch_particles, traced.names.size(), traced.rows.size());
  for (size_t i = 0; i < traced.names.size(); ++i)
    out << traced.kinds[i] << '\n' << traced.names[i] << '\n';
  for (const auto& row : traced.rows) {
    for (const double value : row) out << fmt::format("{:.0f} ", value);
    out << '\n';
  }
  if (!out.flush()) throw std::runtime_error("cannot write " + file.string());
}

Traced read(const std::filesystem::path& file) {
  std::ifstream in(file);
  Traced traced;
  size_t columns = 0, rows = 0;
  std::getline(in, traced.precision);
  std::getline(in, traced.scene);
  in >> traced.batch_particles >> columns >> rows;
  std::string line;
  std::getline(in, line);
  for (size_t i = 0; i < columns; ++i) {
    std::getline(in, traced.kinds.emplace_back());
    std::getline(in, traced.names.emplace_back());
  }
  for (size_t k = 0; k < rows; ++k) {
    std::vector<double>& row = traced.rows.emplace_back(columns);
    for (double& value : row) in >> value;
  }
  if (!in) throw std::runtime_error("cannot read " + file.string());
  return traced;
}

bool compare(const Traced& single, const Traced& twice) {
  require_same(single, twice);
  const size_t batches = single.rows.size();
  const double traced = static_cast<double>(batches) * single.batch_particles;
  std::map<std::string, Line> lines;
  size_t equal = 0, left_out = 0;
  for (size_t k = 0; k < batches; ++k) equal += single.rows[k] == twice.rows[k] ? 1 : 0;
  for (size_t i = 0; i < single.names.size(); ++i) {
    const auto reached = std::count_if(single.rows.begin(), single.rows.end(),
                                       [&](const auto& row) { return row[i] != 0; });
    if (static_cast<double>(reached) < min_share_of_batches * static_cast<double>(batches)) {
      ++left_out;
      continue;
    }
    const Mean bin = mean_over(batches, [&](size_t k) { return twice.rows[k][i]; });
    const Mean difference =
        mean_over(batches, [&](size_t k) { return single.rows[k][i] - twice.rows[k][i]; });
    const double statistical = bin.error * std::sqrt(traced / particles);
    if (!(statistical > 0)) continue;
    const double ratio = std::abs(difference.value) / statistical;
    const double sharpness = difference.error / statistical;
    Line& line = lines[single.kinds[i]];
    ++line.bins;
    line.statistical += std::pow(statistical / bin.value, 2);
    line.difference += std::pow(difference.value / bin.value, 2);
    line.ratio += ratio * ratio;
    line.sharpness += sharpness * sharpness;
    line.worst_ratio = std::max(line.worst_ratio, ratio);
    line.worst_sharpness = std::max(line.worst_sharpness, sharpness);
    if (difference.error > 0)
      line.worst_z = std::max(line.worst_z, std::abs(difference.value) / difference.error);
    line.passes = line.passes && ratio <= far_below + chance * sharpness;
  }
  fmt::print("\n{}: {} batches of {} particles, {} of them the same to the last bit\n",
             single.scene, batches, single.batch_particles, equal);
  fmt::print("{:<22}{:>6}{:>12}{:>12}{:>9}{:>9}{:>9}{:>9}{:>7}\n", "", "bins", "statist.",
             "differ.", "ratio", "worst", "s.e.", "worst", "|z|");
  bool passes = !lines.empty();
  for (auto& [kind, line] : lines) {
    const auto rms = [&](double sum) { return std::sqrt(sum / line.bins); };
    line.passes = line.passes && rms(line.sharpness) <= sharp_enough;
    fmt::print("{:<22}{:>6}{:>12.1e}{:>12.1e}{:>9.4f}{:>9.4f}{:>9.4f}{:>9.4f}{:>7.1f}{}\n", kind,
               line.bins, rms(line.statistical), rms(line.difference), rms(line.ratio),
               line.worst_ratio, rms(line.sharpness), line.worst_sharpness, line.worst_z,
               line.passes ? "" : "  FAILS");
    passes = passes && line.passes;
  }
  fmt::print("left out, since too few batches reach them: {} of {} bins\n", left_out,
             single.names.size());
  return passes;
}

}  // namespace luxodus::precision
