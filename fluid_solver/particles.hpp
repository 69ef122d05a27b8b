/// The fluid's particles as structure of arrays, in strip order, each field padded to whole lanes.
#pragma once

#include <cstdint>
#include <vector>

#include "common/sph/neighbour_loop.hpp"
#include "common/state/field.hpp"

namespace toryu::fluid {

/// So many modes may the stress of a viscoelastic medium have.
inline constexpr std::size_t most_polymer_modes = 4;
/// One symmetric tensor a mode.
using ModeFields = std::array<Symmetric<Field>, most_polymer_modes>;

struct Particles {
  std::size_t count = 0;
  /// Number at the start; who comes in later gets the next one. Sorting keeps it.
  std::vector<std::uint32_t> id;

  Declared<VecField> x{"position", "m", FieldKind::state}, v{"velocity", "m/s", FieldKind::state};
  Declared<Field> rho{"density", "kg/m3", FieldKind::state}, m{"mass", "kg/m", FieldKind::state};
  /// m/rho of the last evaluation, which the search for the free surface reads before the next one.
  Declared<Field> V{"volume", "m2", FieldKind::state};
  Declared<Field> p{"pressure", "Pa", FieldKind::derived},
      p_rho2{"p/rho^2", "m5/(kg.s2)", FieldKind::derived};
  /// Renormalised <grad rho>, where the density diffusion wants it; beside an interface the rate of the
  /// density is found anew with that of the last evaluation.
  Declared<VecField> grad_rho{"density_gradient", "kg/m4", FieldKind::state, Presence::on_demand};
  /// 1 where no free surface is in reach, else 0; and 1 where no wall is in reach either.
  Declared<Field> off_surface{"off_surface", "1", FieldKind::derived, Presence::on_demand};
  Declared<Field> off_surface_and_walls{"off_surface_and_walls", "1", FieldKind::derived,
                                        Presence::on_demand};
  // where the medium is not Newtonian
  Declared<Field> gdot{"shear_rate", "1/s", FieldKind::derived, Presence::on_demand};
  Declared<Field> eta{"viscosity", "Pa.s", FieldKind::derived, Presence::on_demand};
  Declared<TensorField> eta_grad_v{"viscosity_times_velocity_gradient", "Pa", FieldKind::derived,
                                   Presence::on_demand};  ///< [a][b]: eta dv_b/dx_a
  // where the medium is viscoelastic, of each mode that it has
  Declared<ModeFields> log_conformation{"log_conformation", "1", FieldKind::state, Presence::on_demand};
  /// The symplectic step begins with that of the end of the last one.
  Declared<ModeFields> log_conformation_rate{"log_conformation_rate", "1/s", FieldKind::state,
                                             Presence::on_demand};
  Declared<Symmetric<Field>> polymer_stress{"polymer_stress", "Pa", FieldKind::derived, Presence::on_demand};
  Declared<VecField> a{"acceleration", "m/s2", FieldKind::derived};
  /// That of the last step, by which an implicit one foresees its velocities.
  Declared<VecField> a_before{"acceleration_of_last_step", "m/s2", FieldKind::state, Presence::on_demand};
  /// The symplectic step begins with that of the end of the last one.
  Declared<Field> drho{"density_rate", "kg/(m3.s)", FieldKind::state};
  /// Of a channel with open ends: 0 in the fluid, else 1 and up, the end in whose layer the particle is.
  Declared<Field> open_end{"open_end", "1", FieldKind::state, Presence::on_demand};

  std::size_t clusters() const { return padded(count) / lane_count; }
  /// Whether a particle is in no layer of an open end.
  bool is_inside(std::size_t i) const { return open_end.empty() || open_end[i] == 0; }
};

template <class Archive>
void serialize(Archive& archive, Particles& particles) {
  auto& [count, id, x, v, rho, m, V, p, p_rho2, grad_rho, off_surface, off_surface_and_walls, gdot, eta,
         eta_grad_v, log_conformation, log_conformation_rate, polymer_stress, a, a_before, drho, open_end] =
      particles;
  archive(count, id, x, v, rho, m, V, p, p_rho2, grad_rho, off_surface, off_surface_and_walls, gdot, eta,
          eta_grad_v, log_conformation, log_conformation_rate, polymer_stress, a, a_before, drho, open_end);
}

/// What a pair loop reads of its sources, fluid or boundary alike.
struct Sources {
  Positions x, v, v_viscous, grad_rho;
  const double *m, *V, *rho, *p_rho2, *eta;
  std::array<Positions, dim> eta_grad_v;
  std::array<const double*, 3> polymer_stress;  ///< xx, yy, xy
};

inline std::array<const double*, 3> pointers(const Symmetric<Field>& field) {
  return {field.xx.data(), field.yy.data(), field.xy.data()};
}

inline Sources sources(const Particles& f) {
  const auto v = pointers(f.v);
  return {.x = pointers(f.x),
          .v = v,
          .v_viscous = v,
          .grad_rho = pointers(f.grad_rho),
          .m = f.m.data(),
          .V = f.V.data(),
          .rho = f.rho.data(),
          .p_rho2 = f.p_rho2.data(),
          .eta = f.eta.data(),
          .eta_grad_v = pointers(f.eta_grad_v),
          .polymer_stress = pointers(f.polymer_stress)};
}

}  // namespace toryu::fluid
