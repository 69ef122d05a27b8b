/// Who is near whom: keeps the particles in strip order and the cluster lists up to date. The lists reach a
/// skin beyond the kernel's support and are built anew only when something may have moved by half of it.
#pragma once

#include <vector>

#include "common/sph/cluster_list.hpp"
#include "fluid_solver/boundary.hpp"
#include "fluid_solver/particles.hpp"

namespace toryu::fluid {

class Neighbours {
 public:
  /// `support` and `skin` [m]; `strip_width` [m] of the storage order; `shifts` [m], zero first, by which
  /// space repeats itself.
  Neighbours(double support, double skin, double strip_width, std::vector<Vec> shifts)
      : support_(support), skin_(skin), shifts_(std::move(shifts)), strips_(strip_width) {}

  /// Whether the next `dt` [s] at the present speeds may exhaust the skin.
  bool exhausted(const Particles& fluid, const std::vector<Boundary>& boundaries, double dt) const;
  /// Sorts the particles and builds the lists anew.
  void build(Particles& fluid, std::vector<Boundary>& boundaries);

  const ClusterList& of_fluid() const { return of_fluid_; }
  long builds() const { return builds_; }

 private:
  double support_, skin_;
  std::vector<Vec> shifts_;
  StripOrder strips_;
  ClusterList of_fluid_;
  VecField built_fluid_;
  std::vector<VecField> built_boundaries_;
  long builds_ = 0;
};

/// Largest |v| of the first `count` entries.
double largest_norm(const VecField& v, std::size_t count);

}  // namespace toryu::fluid
