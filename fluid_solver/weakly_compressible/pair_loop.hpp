/// The pair loop of the fluid: a cluster of targets, of the fluid or of a boundary, against the sources near
/// it.
#pragma once

#include "fluid_solver/boundary.hpp"
#include "fluid_solver/terms/pair.hpp"
#include "fluid_solver/terms/velocity_gradient.hpp"

namespace toryu::fluid {

/// A field that not every case has.
inline Lanes load_if_there(const Field& field, std::size_t first) {
  return field.empty() ? Lanes(0.0) : load(field, first);
}
inline VecLanes load_if_there(const VecField& field, std::size_t first) {
  return field[0].empty() ? zero_vector() : load(field, first);
}
inline TensorLanes load_if_there(const TensorField& field, std::size_t first) {
  return field[0][0].empty() ? zero_tensor() : load(field, first);
}
inline Symmetric<Lanes> load_if_there(const Symmetric<Field>& field, std::size_t first) {
  return field.xx.empty() ? Symmetric<Lanes>{0.0, 0.0, 0.0} : load(field, first);
}

inline Targets load_targets(const Particles& f, std::size_t first) {
  const VecLanes v = load(f.v, first);
  return {load(f.x, first),
          v,
          v,
          load_if_there(f.grad_rho, first),
          load(f.rho, first),
          load(f.p_rho2, first),
          load_if_there(f.eta, first),
          load_if_there(f.eta_grad_v, first),
          load_if_there(f.polymer_stress, first)};
}

inline Targets load_targets(const Boundary& b, std::size_t first) {
  return {load(b.x, first),
          load(b.v, first),
          load(b.v_viscous, first),
          zero_vector(),
          load(b.rho, first),
          load(b.p_rho2, first),
          load_if_there(b.eta, first),
          load_if_there(b.eta_grad_v, first),
          load_if_there(b.polymer_stress, first)};
}

/// [a][b]: dv_b/dx_a of a cluster of the fluid [1/s], from it and, where walls stick, from them.
template <class W>
TensorLanes velocity_gradient(const W& kernel, const Particles& fluid, const ClusterList& neighbours,
                              const std::vector<Boundary>& boundaries, bool viscous_walls,
                              std::size_t cluster) {
  const std::size_t first = cluster * lane_count;
  VelocityGradient gradient(load(fluid.x, first), load(fluid.v, first));
  gradient.add(sources(fluid), neighbours.near(cluster), kernel);
  if (viscous_walls)
    for (const auto& wall : boundaries)
      gradient.add(sources(wall), wall.list_for_fluid.near(cluster), kernel);
  return gradient.value();
}

/// Adds the sums over `sources` near a cluster of targets `i`, pair by pair.
template <PairsOf pairs = PairsOf::fluid_and_wall, class W, class Add>
TORYU_INLINE void over_pairs(const W& kernel, std::span<const ShiftedNeighbours> lists, const Targets& i,
                             const Sources& sources, Add&& add) {
  over_neighbours(kernel, lists, i.x, sources.x,
                  [&](std::uint32_t j, const Neighbour& n)
                      TORYU_INLINE_LAMBDA { add(j, make_pair<pairs>(kernel, n, i, sources, j)); });
}

}  // namespace toryu::fluid
