/// What the particles of a body are made of, by slot: each has the law of its own material. Where two
/// materials are bonded the strain jumps, and H_i of a particle that sees both is a mean of the two sides.
/// Such a particle is taken as a laminate of both, of rank one, with the layers' normal N and the share phi
/// of the other material,
///
///     H_1 = H_i - phi c (x) N,   H_2 = H_i + (1 - phi) c (x) N,   [P_1(H_1) - P_2(H_2)] N = 0
///     psi_i = (1 - phi) psi_1 + phi psi_2,   P_i = (1 - phi) P_1 + phi P_2
///
/// (Hadamard's jump condition; laminates: Milton 2002, ch. 9.) The jump c makes psi_i least, so that P_i is
/// its derivative and energy is kept. phi is what H_i N is for a displacement that has a unit kink at the
/// interface,
///
///     phi_i = N.[sum_j V_j (1 - s_ij) (X_ij (x) gradW_ij) L_i] N   over the j of the other material,
///
/// with the share s_ij of the way to j that lies in the material of i. Layers are then exact, whether they
/// lie beside or behind each other. With P_i of one material alone the stiffer sees the strain of the softer,
/// and where it lies behind it the softer is too short by a spacing at each interface for moduli of 1 to 100;
/// as a laminate by a tenth, for any moduli (cases/bonded_beam). N follows from where the ways to j cross.
/// The hourglass penalty of a laminate is that of its softer material.
#pragma once

#include <cstdint>
#include <vector>

#include "solid_solver/body.hpp"
#include "solid_solver/total_lagrangian/laws.hpp"
#include "solid_solver/total_lagrangian/reference_pairs.hpp"

namespace toryu::solid {

class Composition {
 public:
  /// `number` of the particle in each slot; padding repeats the last.
  Composition(const Parameters& parameters, const Body& body, const std::vector<std::uint32_t>& number,
              std::size_t slots);
  /// Finds the laminates among the first `count` particles at X [m], of `volume` [m2]; what is `held` is
  /// none. `reach` [m] is that of the pairs.
  void find_laminates(const VecField& X, std::size_t count, const Held& held, const Field& volume,
                      const ReferencePairs& pairs, double reach);

  bool is_uniform() const { return uniform_; }
  const Law& law(std::size_t slot) const { return laws_[material_[slot]]; }
  /// P [Pa] of a cluster of several materials.
  Tensor<Lanes> stress(std::size_t cluster, const Tensor<Lanes>& H) const;
  double energy(std::size_t slot, const Tensor<double>& H) const;  ///< psi [J/m3]
  /// H of the particle's own material.
  Tensor<double> own_gradient(std::size_t slot, const Tensor<double>& H) const;
  /// Largest longitudinal modulus over that of the unloaded material of particles in a cluster, at least 1.
  double stiffening(const Tensor<Field>& H, std::size_t count) const;

  const Field& penalty() const { return penalty_; }          ///< k of the hourglass penalty [Pa]
  const Field& density() const { return density_; }          ///< of the unloaded particle [kg/m3]
  const Field& sound_speed() const { return sound_speed_; }  ///< of its bulk [m/s]
  const std::vector<Material>& materials() const { return materials_; }
  bool uses(std::size_t material) const { return used_[material] != 0; }

  struct Laminate {
    std::uint32_t slot, other;  ///< `other` material
    double share;               ///< phi
    Vec normal;                 ///< N
  };
  const std::vector<Laminate>& laminates() const { return laminates_; }

 private:
  struct Layer {
    Tensor<double> H, P;
  };
  struct Layers {
    Layer own, other;
  };
  /// Beside a surface phi is larger than on the other side. The larger is made less, so that each material
  /// has the volume that it has.
  void balance(const Field& volume);
  Layers layers(const Laminate& laminate, const Tensor<double>& H) const;
  Tensor<double> stress_of(std::uint32_t material, const Tensor<double>& H) const;

  std::vector<Material> materials_;
  std::vector<Law> laws_;                          ///< by material
  std::vector<double> penalty_of_;                 ///< k by material [Pa]
  std::vector<char> used_;                         ///< whether a region has it
  std::vector<std::uint32_t> material_;            ///< by slot
  std::vector<std::vector<std::uint32_t>> in_;     ///< materials in a cluster
  Field index_, penalty_, density_, sound_speed_;  ///< by slot; `index_` is `material_` as a number
  std::vector<Laminate> laminates_;                ///< in the order of their slots
  std::vector<std::uint32_t> laminate_of_;         ///< of a slot; their number where it has none
  bool uniform_ = true;
};

}  // namespace toryu::solid
