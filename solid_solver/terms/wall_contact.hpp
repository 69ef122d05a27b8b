/// Rigid walls acting on the solid, in the present configuration and alike in both formulations. In the
/// manner of Adami et al. (2012) the walls are particles whose pressure is extrapolated from the solid:
///
///     p_i = stiffness K max(0, sum_w V_w W_iw/S_0 - 1)         contact pressure of solid particle i
///     p_w = sum_i p_i W_wi/sum_i W_wi
///     Dv_i/Dt += -1/rho_0 sum_w V_w (p_i + p_w) gradW_iw
///
/// S_0 is the sum of a particle half a spacing off a plane wall, where solid and wall touch: walls push but
/// do not pull, and there is no friction. The walls' lattice has the solid's spacing. Penetration under a
/// pressure p is about p/(3 K) spacings.
#pragma once

#include "common/scene/scene.hpp"
#include "common/sph/cluster_list.hpp"
#include "common/sph/kernel.hpp"
#include "common/sph/strip_order.hpp"

namespace toryu {

struct WallContact {
  double stiffness = 1.0;  ///< contact pressure of doubled overlap, over the bulk modulus
};
inline void describe(ParameterTable& table, WallContact& p) {
  table.number(
      "stiffness", p.stiffness,
      {.minimum = 0, .maximum = 10, .above_minimum = true, .help = "of the contact, over the bulk modulus"});
}

/// The walls of a scene as particles, and the force of their contact.
class ContactWalls {
 public:
  /// `pressure_scale` [Pa] is stiffness times K, `spacing` and `h` [m] the solid's, `density` [kg/m3] too.
  ContactWalls(const std::vector<Wall>& walls, double spacing, double h, double pressure_scale,
               double density);

  /// Puts the walls where they are at `time` [s].
  void move(double time);
  /// Adds to `acceleration` [m/s2] of the solid's particles at x [m]; `particle_volume` [m2] weighs nothing
  /// here but the walls' own. Returns whether anything touches.
  bool add_acceleration(const VecField& x, std::size_t count, VecField& acceleration);

  std::size_t particle_count() const { return count_; }
  double touching_sum() const { return S_0_; }  ///< S_0
  /// Energy [J per metre] is not stored: contact is judged by momentum. Force on the solid in the last call
  /// [N per metre].
  const Vec& force_over_mass_sum() const { return sum_; }

 private:
  CubicSpline W_;
  double spacing_, scale_, density_, S_0_ = 0;
  std::size_t count_ = 0;
  Vec sum_ = Vec::Zero();
};

}  // namespace toryu
