/// Space that repeats itself: `[case] periodic`. Pairs meet across the sides of the domain by lists of
/// neighbours that are near targets moved by a period (ClusterList), so that there are no copies of particles
/// and each pair is as equal and opposite as any other. Solids know no periods.
#pragma once

#include <vector>

#include "common/scene/scene.hpp"

namespace toryu::fluid {

class Period {
 public:
  /// The period is the domain's length. Throws BadInput where it is no multiple of `spacing` [m], which would
  /// leave a gap or a crowd at the seam, or shorter than twice `reach` [m], so that a particle would meet
  /// another from two sides.
  Period(const Scene& scene, double spacing, double reach);

  bool any() const { return !length_.isZero(0); }
  /// Zero first, then the moves by a period to each side and their sums [m].
  const std::vector<Vec>& shifts() const { return shifts_; }
  /// How far to move a point at `x` for it to lie in the domain [m].
  Vec back_into_domain(const Vec& x) const;
  /// `x_ij` [m] to the nearest image of j.
  Vec shortest(const Vec& x_ij) const;

 private:
  Vec begin_, length_ = Vec::Zero();  ///< length 0 where space does not repeat
  std::vector<Vec> shifts_;
};

}  // namespace toryu::fluid
