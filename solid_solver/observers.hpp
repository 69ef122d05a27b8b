/// Points of the material whose displacement, and stress if asked for, a run reports.
#pragma once

#include <string>
#include <type_traits>
#include <vector>

#include "common/case/parameter_table.hpp"
#include "common/sph/points.hpp"
#include "solid_solver/shape.hpp"

namespace toryu::solid {

/// `name` becomes the columns NAME_displacement_x[m] and NAME_displacement_y[m], with `stress` also
/// NAME_stress_xx[Pa], NAME_stress_yy[Pa] and NAME_stress_xy[Pa] of Cauchy's.
struct PointObserver {
  std::string name;
  Vec point = Vec::Zero();  ///< in the unloaded body [m]
  bool stress = false;      ///< whether the stress is reported too
};
void describe(ParameterTable& table, PointObserver& observer);

/// How particles that come off are looked for: see detachment.hpp.
struct Detachment {
  double bond_length = 0;  ///< over the spacing; 0: the support of the kernel, 2h
  double interval = 1e-3;  ///< between two looks [s]
};
void describe(ParameterTable& table, Detachment& detachment);

/// When a bond (bonds.hpp) is torn or clumped.
struct BondLimits {
  double torn_at = 2.0;     ///< stretch beyond which a bond is torn
  double clumped_at = 0.5;  ///< stretch below which its particles have clumped
  bool stop = false;        ///< whether that ends the run
};
void describe(ParameterTable& table, BondLimits& limits);

/// A material point that lies anywhere in or on the body, as a weighted sum of particles: the linear function
/// fitted by least squares, with the kernel as weight, to the particles about the point. Exact where the
/// displacement is linear, also outside the outermost row of particles (a corner of the body, half a spacing
/// away); where the body bends with curvature kappa, off by about kappa d0^2.
class MaterialPoint {
 public:
  /// `X` [m] are the reference positions of the first `count` particles, numbered as they shall be asked for;
  /// `reach` [m] is 2h. Throws std::invalid_argument if fewer than three particles, or only a row of them,
  /// lie within reach. Those beyond empty space, of another body or behind a slot, have no part in it. The
  /// body repeats itself by `shifts` [m] (Period).
  MaterialPoint(const Vec& point, const std::vector<Vec>& X, double reach, const Shape& shape = {},
                const std::vector<Vec>& shifts = {Vec::Zero()});

  /// Value at the point of a field given per particle number.
  template <class FieldOfParticle>
  auto value(const FieldOfParticle& field) const {
    std::decay_t<decltype(field(0u))> sum = weights_[0] * field(particles_[0]);
    for (std::size_t k = 1; k < particles_.size(); ++k) sum += weights_[k] * field(particles_[k]);
    return sum;
  }

  /// Calls take(particle, weight) for each: how they share what acts at the point.
  template <class Take>
  void share(const Take& take) const {
    for (std::size_t k = 0; k < particles_.size(); ++k) take(particles_[k], weights_[k]);
  }

 private:
  std::vector<std::uint32_t> particles_;
  std::vector<double> weights_;
};

}  // namespace toryu::solid
