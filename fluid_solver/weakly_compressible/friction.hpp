/// The passes of the friction term over the work pieces; terms/friction.hpp has the formula. They are apart
/// from the loop over all pairs, so that a case without friction does not carry it.
#pragma once

#include "fluid_solver/boundary.hpp"
#include "fluid_solver/ranks/ranks.hpp"
#include "fluid_solver/terms/friction.hpp"

namespace toryu::fluid {

class WorkPieceFriction {
 public:
  WorkPieceFriction(const Friction& parameters, double spacing, double sound_speed, const Kernel& kernel,
                    Geometry geometry = Geometry::plane);

  /// Fills `work_piece.friction_length`, the d_s, for the fluid's places and volumes.
  void measure_contact(Boundary& work_piece, const Particles& fluid) const;
  /// Adds to the acceleration of the fluid, whose pressure is `p_offset` [Pa] higher than its p, and tells
  /// the work piece what it does to the fluid.
  void brake_fluid(Particles& fluid, double p_offset, Boundary& work_piece) const;
  /// Fills `work_piece.friction_force`, the exact reaction.
  void drag_work_piece(Boundary& work_piece, const Particles& fluid, double p_offset) const;

  /// What friction takes from the fluid's energy, sum F_fs . v_fs [W per metre depth]. Of a part of a fluid
  /// over `ranks`, on rank 0, from that of the whole.
  double power(const Particles& fluid, double p_offset, const std::vector<Boundary>& boundaries,
               const Ranks* ranks) const;

  /// The fastest rate [1/s] at which friction brakes fluid of density `rho` under the pressure `p`: that of
  /// the linear drag at rest, on the row next to a plane interface.
  double rate(double p, double rho) const;

 private:
  template <class W>
  void brake_cluster(const W& kernel, Particles& fluid, double p_offset, Boundary& work_piece,
                     std::size_t cluster) const;
  template <class W>
  Lanes power_of_cluster(const W& kernel, const Particles& fluid, double p_offset, const Boundary& work_piece,
                         std::size_t cluster) const;
  template <class W>
  void drag_cluster(const W& kernel, Boundary& work_piece, const Particles& fluid, double p_offset,
                    std::size_t cluster) const;

  /// Of a particle of the fluid [m2], about an axis of its ring [m3].
  double volume(const Particles& fluid, std::size_t f) const;
  Lanes volumes(const Particles& fluid, std::size_t first) const;

  FrictionForm form_;
  double spacing_;
  FrictionTerm term_;
  Kernel kernel_;
  Geometry geometry_;
};

}  // namespace toryu::fluid
