/// The fluid's particles as structure of arrays, in strip order, each field padded to whole lanes.
#pragma once

#include <cstdint>
#include <vector>

#include "common/sph/points.hpp"

namespace toryu::fluid {

struct Particles {
  std::size_t count = 0;
  std::vector<std::uint32_t> id;  ///< number at the start, which sorting keeps
  // state
  VecField x, v;  ///< [m], [m/s]
  Field rho, m;   ///< [kg/m3], [kg per metre depth]
  // derived at each evaluation
  Field V, p, p_rho2;  ///< m/rho [m2], [Pa], p/rho^2
  VecField grad_rho;   ///< renormalised <grad rho>, only where the density diffusion wants it [kg/m4]
  Field off_surface;   ///< 1 where no free surface is in reach, else 0; only where a term asks for it
  Field off_surface_and_walls;  ///< 1 where no wall is in reach either, else 0; only where a term asks for it
  // only where the medium is not Newtonian
  Field gdot, eta;         ///< shear rate [1/s], viscosity [Pa s]
  TensorField eta_grad_v;  ///< [a][b]: eta dv_b/dx_a [Pa]
  // rates
  VecField a;  ///< [m/s2]
  Field drho;  ///< [kg/m3/s]

  std::size_t clusters() const { return padded(count) / lane_count; }
};

/// What a pair loop reads of its sources, fluid or boundary alike.
struct Sources {
  std::array<const double*, dim> x, v, v_viscous, grad_rho;
  const double *m, *V, *rho, *p_rho2, *eta;
  std::array<std::array<const double*, dim>, dim> eta_grad_v;
};

inline std::array<const double*, dim> pointers(const VecField& field) {
  std::array<const double*, dim> first{};
  for (int a = 0; a < dim; ++a) first[a] = field[a].data();
  return first;
}

inline std::array<std::array<const double*, dim>, dim> pointers(const TensorField& field) {
  std::array<std::array<const double*, dim>, dim> first{};
  for (int a = 0; a < dim; ++a) first[a] = pointers(field[a]);
  return first;
}

inline Sources sources(const Particles& f) {
  const auto v = pointers(f.v);
  return {pointers(f.x),
          v,
          v,
          pointers(f.grad_rho),
          f.m.data(),
          f.V.data(),
          f.rho.data(),
          f.p_rho2.data(),
          f.eta.data(),
          pointers(f.eta_grad_v)};
}

}  // namespace toryu::fluid
