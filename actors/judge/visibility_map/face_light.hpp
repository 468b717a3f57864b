// What the supports of one face have found: the glow of their lines, the light from beyond the
// face, and the light that the room throws on it. Thread rule: one thread changes it; any thread
// asks.
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <vector>

#include "actors/judge/assess/arriving_beside.hpp"
#include "actors/judge/visibility_map/sight_line.hpp"
#include "actors/judge/visibility_map/support_field.hpp"
#include "actors/judge/visibility_map/traced_views.hpp"

namespace luxodus {

/// Lines that take less light away have no veil, and no glow to be divided by [share].
inline constexpr double least_taken = 1e-6;

/// A place from which a face is looked at by traced paths.
struct Support {
  glm::dvec3 eye{0};
  size_t view = 0;                  // in TracedViews
  double passed_scene = 1;          // of its line
  std::array<double, 2> arrives{};  // of the sign's own light, by part [share]
  std::array<double, 2> own{};      // luminance at the face, by part [cd/m2]
};

class FaceLight {
 public:
  explicit FaceLight(size_t mixtures) : reflected_(mixtures), glow_(mixtures), beyond_(mixtures) {}

  const std::vector<Support>& supports() const { return supports_; }
  void add(const Support& support) { supports_.push_back(support); }

  /// Takes the light of all paths so far. Light of which a batch found more than is counted is
  /// bounded by nothing: the glow and the light from beyond of that support, and with its glow also
  /// the light that the room throws on the face, to which all supports contribute.
  void read(const TracedViews& traced, const FaceOfSign& face, const GroupFactors& factors);
  /// Compares a support with its neighbours, which it is not among.
  void test(uint32_t support, std::span<const NearSupport> others);

  /// Room light on the two parts of the face.
  const std::array<Uncertain, 2>& reflected(size_t mixture) const { return reflected_[mixture]; }
  const SupportField& glow(size_t mixture) const { return glow_[mixture]; }
  const SupportField& beyond(size_t mixture) const { return beyond_[mixture]; }

 private:
  void read_reflected(const TracedViews& traced, size_t mixture);
  void read_glow(const TracedViews& traced, const FaceOfSign& face, const GroupFactors& factors,
                 size_t mixture, uint32_t number);
  void read_beyond(const TracedViews& traced, size_t mixture, uint32_t number);

  std::vector<Support> supports_;
  std::vector<std::array<Uncertain, 2>> reflected_;  // by mixture
  std::vector<SupportField> glow_, beyond_;          // by mixture
};

}  // namespace luxodus
