/// Space that repeats itself: `[case] periodic`. Pairs meet across the sides of the domain by lists of
/// neighbours that are near targets moved by a period (ClusterList), so that there are no copies of particles
/// and each pair is as equal and opposite as any other. The fluid and walls are kept in the domain. A solid
/// is not: it goes where it is carried, and what is near it is found by its images.
#pragma once

#include <vector>

#include "common/scene/scene.hpp"

namespace toryu {

class Period {
 public:
  /// Space that does not repeat itself.
  Period() = default;
  /// The period is the domain's length.
  explicit Period(const Scene& scene);
  /// The same for particles `spacing` [m] apart. Throws BadInput where the period is no multiple of that,
  /// which would leave a gap or a crowd at the seam, or shorter than twice `reach` [m], so that a particle
  /// would meet another from two sides.
  Period(const Scene& scene, double spacing, double reach);

  bool any() const { return !length_.isZero(0); }
  bool along(int axis) const { return length_[axis] > 0; }
  const Vec& length() const { return length_; }  ///< [m]; 0 where space does not repeat
  /// Zero first, then the moves by a period to each side and their sums [m].
  const std::vector<Vec>& shifts() const { return shifts_; }
  /// How far to move a point at `x` for it to lie in the domain [m].
  Vec back_into_domain(const Vec& x) const;
  /// `x` where it lies in the domain [m].
  Vec inside(const Vec& x) const { return x + back_into_domain(x); }
  /// `x_ij` [m] to the nearest image of j.
  Vec shortest(const Vec& x_ij) const;

 private:
  Vec begin_ = Vec::Zero(), length_ = Vec::Zero();
  std::vector<Vec> shifts_{Vec::Zero()};
};

/// `points` and their images in all of `shifts` [m], one after another.
std::vector<Vec> with_images(const std::vector<Vec>& points, const std::vector<Vec>& shifts);
/// The same of shapes.
std::vector<Box> with_images(const std::vector<Box>& boxes, const std::vector<Vec>& shifts);
/// Of the images of `holes`, but for the holes themselves, those that reach into one of `bodies` by more than
/// `least` [m].
std::vector<Box> images_in(const std::vector<Box>& bodies, const std::vector<Box>& holes,
                           const Period& period, double least);

}  // namespace toryu
