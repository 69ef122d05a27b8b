/// The two sweeps over present neighbours of which the updated Lagrangian form consists: the rates of density
/// and stress, then the acceleration. The neighbours' physics is here, time is not.
#pragma once

#include <optional>

#include "common/sph/cluster_list.hpp"
#include "common/sph/kernel.hpp"
#include "common/sph/points.hpp"
#include "common/state/field.hpp"
#include "solid_solver/parameters.hpp"
#include "solid_solver/terms/hookes_law.hpp"

namespace toryu::solid {

static_assert(dim == 2, "the sums and the inverse have the components of the plane");

/// Particles of the updated form, in storage order, padded to whole lanes.
struct UpdatedParticles {
  Declared<VecField> x{"position", "m", FieldKind::derived};
  Declared<VecField> v{"velocity", "m/s", FieldKind::derived};
  Declared<Field> m{"mass", "kg/m", FieldKind::derived};
  Declared<Field> rho{"density", "kg/m3", FieldKind::state};
  Declared<Field> V{"volume", "m2", FieldKind::derived};
  Declared<Symmetric<Field>> s{"deviatoric stress", "Pa", FieldKind::state};
};
template <class Archive>
void serialize(Archive& archive, UpdatedParticles& particles) {
  auto& [x, v, m, rho, V, s] = particles;
  archive(x, v, m, rho, V, s);
}

/// What the first sweep finds.
struct UpdatedRates {
  /// A symplectic step takes its first half with that of the step before.
  Declared<Field> rho{"rate of density", "kg/(m3 s)", FieldKind::state};
  Declared<Symmetric<Field>> s{"rate of deviatoric stress", "Pa/s", FieldKind::derived};
  /// sigma/rho^2, times L if renormalised.
  Declared<Tensor<Field>> T{"stress over squared density", "m5/(kg s2)", FieldKind::derived};
  Declared<Symmetric<Field>> R{"artificial stress", "m5/(kg s2)", FieldKind::derived};
};
template <class Archive>
void serialize(Archive& archive, UpdatedRates& rates) {
  auto& [rho, s, T, R] = rates;
  archive(rho, s, T, R);
}

class PairSweeps {
 public:
  explicit PairSweeps(const Parameters& parameters);

  /// (17) Drho_i/Dt = -rho_i tr(grad v)_i and Ds/Dt of (7), with
  ///
  ///     (grad v)_i = sum_j V_j (v_j - v_i) (x) L_i gradW_ij
  ///
  /// L_i is the unit tensor, or with renormalised gradients [sum_j V_j (x_j - x_i) (x) gradW_ij]^-1 (unit
  /// where that is near singular, as for a particle torn off).
  void rates(const UpdatedParticles& particles, const ClusterList& list, std::size_t cluster,
             UpdatedRates& rates) const;
  /// Its two halves, for steps that need them apart: (grad v)_i [1/s], which reads nothing but x, v and V,
  Tensor<Lanes> velocity_gradient(const UpdatedParticles& particles, const ClusterList& list,
                                  std::size_t cluster) const;
  /// and T and R of the present stress.
  void stresses(const UpdatedParticles& particles, const ClusterList& list, std::size_t cluster,
                UpdatedRates& rates) const;

  /// (22) Dv_i/Dt = sum_j m_j [sigma_i L_i/rho_i^2 + sigma_j L_j/rho_j^2 - Pi_ij + (R_i + R_j) F_ij^n]
  /// gradW_ij. With renormalised gradients it is the adjoint of the velocity gradient.
  VecLanes acceleration(const UpdatedParticles& particles, const UpdatedRates& rates, const ClusterList& list,
                        std::size_t cluster) const;

 private:
  /// The gradient and, if renormalised, L.
  template <bool renormalised>
  void sweep(const UpdatedParticles& particles, const ClusterList& list, std::size_t cluster,
             Tensor<Lanes>& grad_v, Tensor<Lanes>& L) const;
  /// As `sweep`, chosen by the parameters.
  void sweep(const UpdatedParticles& particles, const ClusterList& list, std::size_t cluster,
             Tensor<Lanes>& grad_v, Tensor<Lanes>& L) const;
  /// T and R of the present stress, given L.
  void store_stresses(const UpdatedParticles& particles, const Tensor<Lanes>& L, std::size_t cluster,
                      UpdatedRates& rates) const;
  template <bool viscous, bool stressed>
  VecLanes acceleration_of(const UpdatedParticles& particles, const UpdatedRates& rates,
                           const ClusterList& list, std::size_t cluster) const;

  CubicSpline W_;
  double tiny_;  ///< added to r^2, so that a particle's own pair is zero [m2]
  HookesLaw law_;
  bool renormalised_;
  std::optional<ArtificialStress> stress_;
  std::optional<PairViscosity<>> viscosity_;
  double inverse_W_d0_;  ///< 1/W(d0) [m2]
};

}  // namespace toryu::solid
