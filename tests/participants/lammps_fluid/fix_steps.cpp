#include "fix_steps.hpp"

#include <cmath>

namespace toryu::lammps_fluid {

PairSph& FixSteps::pair() const {
  return dynamic_cast<PairSph&>(*force->pair);
}

int FixSteps::setmask() {
  return LAMMPS_NS::FixConst::INITIAL_INTEGRATE | LAMMPS_NS::FixConst::FINAL_INTEGRATE;
}

template <class Visit>
void FixSteps::over_fluid(Visit&& visit) const {
  for (int i = 0; i < atom->nlocal; ++i)
    if (atom->type[i] == Type::fluid) visit(i);
}

void FixSteps::move_interface(double when) {
  const PairSph& sph = pair();
  for (int i = 0; i < atom->nlocal; ++i) {
    if (atom->type[i] != Type::interface) continue;
    for (int a = 0; a < dim; ++a) {
      const auto n = static_cast<std::size_t>(dim * sph.place(i) + a);
      atom->x[i][a] = interface.position(n, when);
      atom->v[i][a] = interface.velocity(n);
    }
  }
}

void FixSteps::note(int i, char quantity, double value, double second) {
  const long number = atom->tag[i] - 1;
  if (number < extremes.number) {
    extremes.number = number;
    extremes.quantity = quantity;
    extremes.value[0] = value;
    extremes.value[1] = second;
  }
}

/// A particle that left physics stays where it is: the step ends, and the run with it. LAMMPS would end by
/// itself where one leaves its box.
bool FixSteps::is_sound(int i) {
  const Physics& f = pair().physics;
  const double *x = atom->x[i], *v = atom->v[i], speed = std::hypot(v[0], v[1]);
  bool is_inside = true;
  for (int a = 0; a < dim; ++a) is_inside = is_inside && x[a] >= f.low[a] && x[a] < f.high[a];
  if (!(speed <= f.largest_speed))
    note(i, 's', speed);
  else if (!is_inside)
    note(i, 'x', x[0], x[1]);
  else
    return true;
  return false;
}

void FixSteps::drift(double length) {
  over_fluid([&](int i) {
    if (!is_sound(i)) return;
    for (int a = 0; a < dim; ++a) atom->x[i][a] += length * atom->v[i][a];
  });
}

void FixSteps::thicken(double length) {
  double *rho = custom("rho"), *drho = custom("drho");
  const Physics& f = pair().physics;
  over_fluid([&](int i) {
    const double next = rho[i] + length * drho[i];
    if (std::abs(next / f.rho_0 - 1) <= f.largest_change)
      rho[i] = next;
    else
      note(i, 'd', next);
  });
}

/// x, v and rho from the start of the step, by the rates at hand: x by the velocity of the evaluation.
void FixSteps::advance_from_start(double length) {
  double *rho = custom("rho"), *rho_0 = custom("rho_0");
  double *x_0[dim] = {custom("x_0"), custom("y_0")}, *v_0[dim] = {custom("vx_0"), custom("vy_0")};
  const bool begins = half_ == 0;
  over_fluid([&](int i) {
    if (begins) {
      rho_0[i] = rho[i];
      for (int a = 0; a < dim; ++a) x_0[a][i] = atom->x[i][a], v_0[a][i] = atom->v[i][a];
    }
    if (!is_sound(i)) return;
    for (int a = 0; a < dim; ++a) {
      atom->x[i][a] = x_0[a][i] + length * atom->v[i][a];
      atom->v[i][a] = v_0[a][i] + length * atom->f[i][a];
    }
    rho[i] = rho_0[i];
  });
  thicken(length);
}

void FixSteps::initial_integrate(int) {
  PairSph& sph = pair();
  const bool midpoint = sph.physics.midpoint;
  if (!midpoint) {
    drift(0.5 * dt);
    if (half_ == 0) thicken(0.5 * dt);
    sph.wanted = half_ == 0 ? RatesOf::velocity : RatesOf::density;
    move_interface(time + (half_ == 0 ? 0.5 : 1.0) * dt);
  } else {
    sph.wanted = RatesOf::both;
    move_interface(time + 0.5 * half_ * dt);
  }
}

void FixSteps::final_integrate() {
  PairSph& sph = pair();
  const bool midpoint = sph.physics.midpoint, last = half_ == 1;
  over_fluid([&](int i) {
    if (midpoint ? last : !last)
      extremes.acceleration = std::max(extremes.acceleration, std::hypot(atom->f[i][0], atom->f[i][1]));
  });
  if (midpoint) {
    advance_from_start(last ? dt : 0.5 * dt);
    if (last) sph.add_load(dt);
    if (last) move_interface(time + dt);
  } else if (!last) {
    over_fluid([&](int i) {
      for (int a = 0; a < dim; ++a) atom->v[i][a] += dt * atom->f[i][a];
    });
    sph.add_load(dt);
  } else {
    thicken(0.5 * dt);
  }
  if (last) {
    time += dt;
    over_fluid(
        [&](int i) { extremes.speed = std::max(extremes.speed, std::hypot(atom->v[i][0], atom->v[i][1])); });
  }
  half_ = 1;
}

}  // namespace toryu::lammps_fluid
