/// The solid in updated Lagrangian form (Gray, Monaghan & Swift 2001; the thesis): stress is carried along
/// and grows by its rate, the neighbours are the present ones. It can tear, needs the artificial stress not
/// to tear by itself, and is too soft in plates of few rows.
///
/// Midpoint steps (thesis eq. 31-32) of x, v, rho and s, two evaluations a step:
///
///     phi^(n+1/2) = phi^n + dt/2 F(phi^n);   phi^(n+1) = phi^n + dt F(phi^(n+1/2))
///
/// An undamped mode grows by (w dt)^4/8 a step: without artificial viscosity it is weakly unstable.
///
/// Symplectic steps, by choice, one evaluation a step: the Stoermer-Verlet scheme (Hairer, Lubich & Wanner
/// 2003), in which rho and s stand where forces come from the positions,
///
///     v^(n+1/2) = v^n + dt/2 a^n;   x^(n+1/2) = x^n + dt/2 v^(n+1/2)
///     rho, s:  n to n+1 with grad v of x^(n+1/2), v^(n+1/2);   x^(n+1) = x^(n+1/2) + dt/2 v^(n+1/2)
///     v^(n+1) = v^(n+1/2) + dt/2 a(x^(n+1), rho^(n+1), s^(n+1))
///
/// Neutral for undamped modes up to w dt = 2. Renormalised gradients need L at both places, half an
/// evaluation more. A step takes 0.55 of the processor time of a midpoint step, 0.70 with renormalised
/// gradients (colliding rings, three runs of each in turn).
///
/// With artificial viscosity midpoint
/// steps may be longer than the usual 0.25 h/c_L. Largest courant_number at which a struck block came to rest
/// (4 x 24 particles, h = 1.2 d0; at an eighth more, or a quarter, it did not):
///
///     alpha                        0     0.05    0.2     0.5    1      2      4
///     plain gradients           < 0.25   0.375   0.625   1.0    1.25   1.25   0.5 (the viscous limit)
///     renormalised gradients                     0.25           0.5
#pragma once

#include "solid_solver/solid_model.hpp"
#include "solid_solver/updated_lagrangian/pair_sweeps.hpp"

namespace toryu::solid {

class UpdatedLagrangian final : public SolidModel {
 public:
  UpdatedLagrangian(const Parameters& parameters, const Body& body, const Scene& scene);

  /// The smallest of courant_number h/(c_L + |v|) (acoustic), 0.125 h^2/nu with the artificial viscosity's
  /// nu = alpha h c/8 (viscous), and 0.25 sqrt(h/|dv/dt|) (force), times the share.
  double time_step_limit() const override { return limit().first; }
  std::string_view time_step_rule() const override { return limit().second; }
  void advance(double dt) override;
  void save() override;
  void restore() override;
  void write_state(std::ostream& stream) const override;
  void read_state(std::istream& stream) override;
  std::vector<ActiveTerm> active_terms() const override;
  Stress stress(std::size_t particle) const override;
  std::vector<Observation> internal_energies() const override;

 protected:
  void check_strain(double time) const override;

 private:
  /// What this form adds to the state.
  struct FormState {
    UpdatedParticles particles;
    UpdatedRates rates;
    Declared<VecField> x_listed{"position at the last search", "m", FieldKind::state};
    ClusterList list;  ///< built from x_listed
    template <class Archive>
    friend void serialize(Archive& archive, FormState& state) {
      auto& [particles, rates, x_listed, list] = state;
      archive(particles, rates, x_listed);
    }
  };
  /// What a midpoint step starts from.
  struct StartOfStep {
    Declared<VecField> u{"displacement", "m", FieldKind::derived};
    Declared<VecField> v{"velocity", "m/s", FieldKind::derived};
    Declared<Field> rho{"density", "kg/m3", FieldKind::derived};
    Declared<Symmetric<Field>> s{"deviatoric stress", "Pa", FieldKind::derived};
    template <class Archive>
    friend void serialize(Archive& archive, StartOfStep& start) {
      auto& [u, v, rho, s] = start;
      archive(u, v, rho, s);
    }
  };

  void find_masses();  ///< after sorting
  void find_neighbours_if_moved();
  void find_neighbours();
  void list_neighbours();  ///< of x_listed
  void midpoint_step(double dt);
  void symplectic_step(double dt);
  void keep_start();
  // All below within a parallel region.
  /// Tells the sweeps where the particles are; V by the density `ahead` [s] in time.
  void place(double ahead);
  /// Accelerations by T, R and walls.
  void accelerate();
  /// Half a step `dt` [s] of the velocity, times shares that damping keeps.
  void kick(double dt, double kept_before, double kept_after);
  void drift(double dt);
  /// Density and stress after `dt` [s] of the present gradient of the velocity.
  void strain(double dt);
  /// Accelerations and rates of the present state, within a parallel region.
  void evaluate();
  /// State = start + dt * rates, within a parallel region.
  void move(double dt);
  std::pair<double, std::string_view> limit() const;

  PairSweeps sweeps_;
  HookesLaw law_;
  FormState form_, saved_form_;
  StartOfStep start_;
  double skin_;  ///< [m]
};

}  // namespace toryu::solid
