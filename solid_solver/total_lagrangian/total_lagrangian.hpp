/// The solid in total Lagrangian form: the neighbours of the unloaded body are kept for ever.
///
///     H_i = sum_j V_j (u_j - u_i) (x) L_i gradW_ij(X),   P_i = P(I + H_i)          by a law of laws.hpp
///     rho_0 V_i Dv_i/Dt = sum_j V_i V_j (P_i L_i + P_j L_j) gradW_ij + penalty + loads
///
/// (Rabczuk, Belytschko & Xiao 2004; Ganzenmueller 2015.) The force is the exact gradient of the energies, so
/// that with the leapfrog (kick, drift, kick; one evaluation a step) energy is kept but for oscillations of
/// order dt^2, and momentum and angular momentum to rounding. It cannot tear. A particle whose volume is no
/// longer positive ends the run, in whichever step it was.
#pragma once

#include <memory>
#include <optional>

#include "solid_solver/solid_model.hpp"
#include "solid_solver/total_lagrangian/composition.hpp"
#include "solid_solver/total_lagrangian/laws.hpp"
#include "solid_solver/total_lagrangian/reference_pairs.hpp"
#include "solid_solver/total_lagrangian/stress_recovery.hpp"

namespace toryu::solid {

class TotalLagrangian final : public SolidModel {
 public:
  TotalLagrangian(const Parameters& parameters, const Body& body, const Scene& scene);

  /// The exact limit of the leapfrog, 2/omega with the highest angular frequency of the unloaded body found
  /// by power iteration, less what viscosity takes and what the law's stiffening does: the largest
  /// longitudinal modulus of a particle over that of the unloaded solid.
  double time_step_limit() const override;
  std::string_view time_step_rule() const override { return "acoustic"; }
  void advance(double dt) override;
  void save() override;
  void restore() override;
  void write_state(std::ostream& stream) const override;
  void read_state(std::istream& stream) override;
  std::vector<ActiveTerm> active_terms() const override;
  Stress stress(std::size_t particle) const override;
  /// Of a particle of the surface by stress_recovery.hpp, as at an observer's point.
  Stress recovered_stress(std::size_t particle) const override;
  std::vector<Observation> internal_energies() const override;

  /// Highest angular frequency of small motions about the present state [1/s].
  double find_highest_frequency();

 protected:
  void check_strain(double time) const override;
  Stress stress_at(std::size_t observer) const override;

 private:
  void kick_and_drift(double dt);
  /// Clamps that turn see the displacement turned back with them: there what they hold is at rest to the
  /// solid, as clamp_faces.hpp has it, and the forces are turned with them again.
  void turn_back();
  const VecField& seen() const { return drive_.turns() ? turned_back_ : state_.u; }
  void find_stresses();
  void find_accelerations();
  /// sum_j V_j rho_j/rho_i Pi_ij gradW_ij of a cluster.
  VecLanes viscous(std::size_t cluster) const;
  void kick(double dt);
  /// All accelerations from u and v, within a parallel region.
  void evaluate();
  Tensor<double> gradient(std::size_t slot) const;
  void find_recovered_points();
  Stress recovered(const RecoveredPoint& point) const;
  Stress stress_of(std::size_t slot, const Tensor<double>& H) const;  ///< by the law of a particle
  template <class Stress>
  void find_stresses_by(const Stress& stress);     ///< P = stress(cluster, H)
  bool is_free(const FreeSurface& surface) const;  ///< nothing but gravity acts on its particles at present
  void touch();
  void record_inverted(const Tensor<Lanes>& H, std::size_t first_slot);

  /// The first particle whose volume was no longer positive, looked for in every step.
  struct Inverted {
    std::size_t slot;
    double time, volume_ratio;
    template <class Archive>
    friend void serialize(Archive& archive, Inverted& inverted) {
      auto& [slot, time, volume_ratio] = inverted;
      archive(slot, time, volume_ratio);
    }
  };
  /// What this form adds to the state.
  struct FormState {
    Declared<Tensor<Field>> H{"displacement gradient", "1", FieldKind::derived};
    std::optional<Inverted> inverted;
    template <class Archive>
    friend void serialize(Archive& archive, FormState& state) {
      auto& [H, inverted] = state;
      archive(H, inverted);
    }
  };

  FormState form_, saved_form_;
  std::vector<RecoveredPoint> of_observers_, of_surface_;
  std::vector<std::size_t> surface_index_;  ///< of a particle in `of_surface_`; its size where it has none
  Field volume_;
  std::unique_ptr<ReferencePairs> pairs_;
  Composition composition_;
  Tensor<Field> T_;               ///< P L - (k/2) H: what a particle brings to the pairs [Pa]
  VecField turned_back_;          ///< displacement, if clamps turn [m]
  VecField x_;                    ///< present positions, if walls or other bodies act on the solid [m]
  double highest_frequency_ = 0;  ///< of the unloaded body [1/s]
};

}  // namespace toryu::solid
