/// Where the solid is held. A clamp's face is that of the held particles' cells, between the rows, and
/// nothing moves on it. A free particle i sees a held one j as the point where the line between them enters
/// the held cells, at a share s of the way, at rest:
///
///     X_ij -> s X_ij,   w_ij -> w_ij/s^2
///
/// The weight is such that sum_j V_j w_ij X_ij (x) X_ij, and so L_i, are as before. For a plane face this is
/// the displacement mirrored about the face, u_j = -u_i (1 - s)/s, as no-slip walls do it with velocities
/// (Takeda, Miyama & Sekiya 1994). H_i is then exact in all linear displacements that vanish on the face,
/// where held particles that stand for themselves smear the step of the strain over their own rows: square
/// and energy of a smeared step are less, and the clamp gives way by a share of a spacing (0.3 in bending,
/// less in stretch and shear, so that no factor mends all three).
///
/// For the held particles the same pairs are there the other way round, which keeps momentum pair by pair.
/// They bear no stress, and pairs of two held ones count nothing.
#pragma once

#include <cstdint>
#include <optional>
#include <unordered_map>

#include "common/sph/cluster_list.hpp"
#include "common/sph/points.hpp"

namespace toryu::solid {

/// What of a body is held, by slot.
struct Held {
  const Field& mobile;    ///< 0 where a clamp holds, else 1
  const VecField& cells;  ///< sides of the particles' cells [m]
  /// Whether the cells are no boxes, but what is nearer to one particle than to others.
  bool fitted = false;
};

class ClampFaces {
 public:
  /// `neighbours` lists at least what is within `reach` [m] of each of the particles at X.
  ClampFaces(const VecField& X, std::size_t count, const Held& held, const ClusterList& neighbours,
             double reach);

  /// s of a pair of which one is held: 1 beyond the reach. Nothing if none is; 0 if both are.
  std::optional<double> share(std::size_t i, std::size_t j) const;

  bool holds(std::size_t i) const { return held_.mobile[i] == 0; }

 private:
  void find_shares(const VecField& X, std::size_t i, std::span<const ShiftedNeighbours> neighbours,
                   double reach);

  Held held_;
  std::unordered_map<std::uint64_t, double> shares_;  ///< by slots, the free particle's first
};

}  // namespace toryu::solid
