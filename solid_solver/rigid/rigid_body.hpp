/// The solid as rigid bodies, one unless the case names several: x, y and angle of the point of reference of
/// each, the centre of mass or the pivot of its mounting. All regions of a body are one with each other,
/// whether they touch or not. Bodies do not push each other: where two meet the run ends.
///
///     m Dv/Dt = sum_i f_i + F,   I domega/dt = sum_i r_i x f_i + M
///
/// with f_i of gravity, loads, walls and the fluid on particle i, F and M of what holds it (mounting.hpp). In
/// q = (x, y, angle), with the matrix A of the inertia, C of the dampers, and Z of the fluid's impedance
/// where the load has one, a step is a leapfrog in which what resists motion is implicit, and stable for any
/// size of it,
///
///     (A + dt/2 (C + Z)) w = A v_n + dt/2 (f(q_n) + Z w_c),   q_n+1 = q_n + dt w
///     A v_n+1 = A w + dt/2 (f(q_n+1) - C w + Z (w_c - w))
///
/// with Z = sum_i z_i g_i g_i^T, g_i = (n_i, r_i x n_i), as SolidModel::brake_by_impedance has it for one
/// particle. It is of second order; under a constant force it is exact, and the momentum of a free body is
/// kept to rounding.
///
/// Each particle brings its mass density V and, so that a rectangle of any number of them has its exact
/// moment of inertia, that of its cell, m (a^2 + b^2)/12.
#pragma once

#include "solid_solver/rigid/rigid_part.hpp"
#include "solid_solver/solid_model.hpp"

namespace toryu::solid {

class RigidBody final : public SolidModel {
 public:
  RigidBody(const Parameters& parameters, const Body& body, const Scene& scene);

  /// A share of what resolves the motion: 1/20 radian of the fastest spring, damper, turn or sine of a load,
  /// 1/2 of a wall it touches, and 1/20 of the interval of frames (without frames 1/1000 of the run) and of
  /// the shortest between rows of a load's table.
  double time_step_limit() const override;
  std::string_view time_step_rule() const override { return "accuracy"; }
  void advance(double dt) override;
  void save() override;
  void restore() override;
  void write_state(std::ostream& stream) const override;
  void read_state(std::istream& stream) override;
  std::vector<ActiveTerm> active_terms() const override;
  std::vector<Observation> places() const override;
  /// With the mass of each whole body, which moves with whatever the fluid touches, shared out to it.
  Interface interface(double reach) const override;
  bool has_stress() const override { return false; }
  Stress stress(std::size_t /*particle*/) const override { return {}; }
  std::vector<Observation> internal_energies() const override;

  /// Of a body: since the start [m], [m], [rad].
  const Coordinates& coordinates(std::size_t body = 0) const { return form_.q[body]; }
  /// [m/s], [m/s], [rad/s].
  const Coordinates& velocities(std::size_t body = 0) const { return form_.v[body]; }
  /// m, m [kg/m], I [kg.m2/m].
  const Coordinates& inertia(std::size_t body = 0) const { return parts_[body].inertia; }

 protected:
  /// Throws where two bodies have met.
  void check_strain(double time) const override;
  std::string_view what_holds() const override {
    return "a [solid.mounting], or walls by [solid.wall_contact], hold a rigid body";
  }
  double kinetic_energy() const override;

 private:
  struct FormState {
    std::vector<Coordinates> q, v;  ///< by body
    template <class Archive>
    friend void serialize(Archive& archive, FormState& state) {
      auto& [q, v] = state;
      archive(q, v);
    }
  };
  /// What resists the motion in a step.
  struct Resistance {
    Coordinates drift;  ///< w
    Coordinates force;  ///< - C w + Z (w_c - w)
  };

  void find_start(std::size_t body);
  Pose pose(std::size_t body) const { return parts_[body].pose(form_.q[body], form_.v[body]); }
  /// Of the particle in a slot; padding repeats the last.
  std::uint32_t part_in(std::size_t slot) const {
    return part_of_[state_.number[std::min(slot, particle_count() - 1)]];
  }
  Vec arm(const Pose& pose, std::size_t particle) const {
    return pose.turned(body_.X[particle] - pose.about);
  }
  Coordinates force(std::size_t body) const;  ///< at the present place [N/m], [N.m/m]
  /// Finds w and what goes with it; counts what the impedance takes.
  Resistance resist(std::size_t body, double dt);
  void place_particles();  ///< with their velocities, and what walls do to them there
  void move_particles();   ///< their velocities alone
  double spring_energy() const;
  /// How fast the angle would swing by the moments of gravity and loads alone, at most [rad/s].
  double frequency_of_loads(const RigidPart& part) const;

  std::vector<RigidPart> parts_;
  std::vector<std::uint32_t> part_of_;  ///< of a particle
  double longest_step_;                 ///< [s]
  Vec first_momentum_ = Vec::Zero();    ///< [N.s/m]
  VecField x_;                          ///< present positions in the domain, if walls act on the solid [m]
  FormState form_, saved_form_;
};

}  // namespace toryu::solid
