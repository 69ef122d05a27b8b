#include "engine.hpp"

#include <fmt/format.h>

#include <cstring>

namespace toryu::lammps_fluid {

namespace {

LAMMPS_NS::Pair* make_pair(LAMMPS_NS::LAMMPS* lmp) {
  return new PairSph(lmp);
}
LAMMPS_NS::Fix* make_fix(LAMMPS_NS::LAMMPS* lmp, int argc, char** argv) {
  return new FixSteps(lmp, argc, argv);
}

/// Adds what all ranks have, each entry of which is zero on all ranks but one: rank 0 has the sum.
void gather(Numbers& values) {
  int rank = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  MPI_Reduce(rank == 0 ? MPI_IN_PLACE : values.data(), values.data(), static_cast<int>(values.size()),
             MPI_DOUBLE, MPI_SUM, 0, MPI_COMM_WORLD);
}

double largest(double value) {
  MPI_Allreduce(MPI_IN_PLACE, &value, 1, MPI_DOUBLE, MPI_MAX, MPI_COMM_WORLD);
  return value;
}

}  // namespace

Engine::Engine() {
  char name[] = "lammps", screen[] = "-screen", log[] = "-log", none[] = "none";
  char* arguments[] = {name, screen, none, log, none};
  lammps_ = std::make_unique<LAMMPS_NS::LAMMPS>(5, arguments, MPI_COMM_WORLD);
  (*lammps_->force->pair_map)["toryu/sph"] = make_pair;
  (*lammps_->modify->fix_map)["toryu/steps"] = make_fix;
}
Engine::~Engine() = default;

PairSph& Engine::pair() {
  return dynamic_cast<PairSph&>(*lammps_->force->pair);
}
FixSteps& Engine::steps() {
  return dynamic_cast<FixSteps&>(*lammps_->modify->fix[lammps_->modify->find_fix("steps")]);
}
void Engine::command(const std::string& line) {
  lammps_->input->one(line);
}
template <class Visit>
void Engine::over_fluid(Visit&& visit) {
  for (int i = 0; i < lammps_->atom->nlocal; ++i)
    if (lammps_->atom->type[i] == Type::fluid) visit(i);
}

Numbers Engine::obey(Order order, Numbers in) {
  switch (order) {
    case Order::fill:
      return fill(in);
    case Order::begin_window:
      return begin_window(in);
    case Order::step:
      return step(in[0]);
    case Order::take_load:
      return take_load(in[0] != 0);
    case Order::give_state:
      return give_state();
    case Order::take_state:
      return take_state(in);
    case Order::observe:
      return observe(in);
    case Order::end:
      break;
  }
  return {};
}

/// In: the physics, then x, y, v_x, v_y, rho and m of each particle.
Numbers Engine::fill(const Numbers& in) {
  std::memcpy(static_cast<void*>(&physics_), in.data(), sizeof physics_);
  const Physics& f = physics_;
  const double *values = in.data() + (sizeof physics_ + 7) / 8, margin = 4 * f.support();
  const int count = f.fluid_count + f.wall_count + f.interface_count;
  for (const char* line : {"units si", "dimension 2", "boundary f f p", "atom_style atomic", "newton off",
                           "comm_style tiled", "comm_modify vel yes"})
    command(line);
  command(fmt::format("region box block {:.17g} {:.17g} {:.17g} {:.17g} {:.17g} {:.17g} units box",
                      f.low[0] - margin, f.high[0] + margin, f.low[1] - margin, f.high[1] + margin,
                      -f.spacing, f.spacing));
  command("create_box 3 box");
  for (const char* line :
       {"mass * 1", "fix shared all property/atom rmass d_rho ghost yes",
        "fix own all property/atom d_drho d_rho_0 d_x_0 d_y_0 d_vx_0 d_vy_0 d_load_p d_load_x d_load_y",
        "pair_style toryu/sph", "pair_coeff * *", "fix steps all toryu/steps",
        "neigh_modify every 1 delay 0 check yes exclude type 2 2 exclude type 2 3 exclude type 3 3",
        "thermo_style custom step", "thermo 0", "timer off"})
    command(line);
  command(fmt::format("neighbor {:.17g} bin", f.skin));
  std::vector<int> number(static_cast<std::size_t>(count)), type(number.size());
  Numbers x(3 * number.size()), v(x.size());
  for (int k = 0; k < count; ++k) {
    const auto n = static_cast<std::size_t>(k);
    number[n] = k + 1;
    type[n] = k < f.fluid_count                  ? Type::fluid
              : k < f.fluid_count + f.wall_count ? Type::wall
                                                 : Type::interface;
    for (std::size_t a = 0; a < dim; ++a)
      x[3 * n + a] = values[6 * n + a], v[3 * n + a] = values[6 * n + 2 + a];
  }
  lammps_create_atoms(lammps_.get(), count, number.data(), type.data(), x.data(), v.data(), nullptr, 0);
  double* const rho = pair().custom("rho");
  Numbers places(static_cast<std::size_t>(dim * f.interface_count));
  for (int i = 0; i < lammps_->atom->nlocal; ++i) {
    const auto n = static_cast<std::size_t>(lammps_->atom->tag[i] - 1);
    rho[i] = values[6 * n + 4];
    lammps_->atom->rmass[i] = values[6 * n + 5];
  }
  for (std::size_t k = 0; k < places.size(); ++k)
    places[k] = values[6 * (static_cast<std::size_t>(f.fluid_count + f.wall_count) + k / dim) + k % dim];
  pair().physics = f;
  pair().wall_acceleration.assign(places.size(), 0.0);
  steps().interface = MovedInterface(places, f.support() / f.c_0);
  if (lammps_->comm->nprocs > 1) {
    command("balance 1.05 rcb");
    command("fix balance all balance 500 1.05 rcb");
  }
  command("run 0 post no");
  return {};
}

/// In: time, length, whether there is an impulse; then positions, velocities and impulses of the interface.
Numbers Engine::begin_window(const Numbers& in) {
  const auto size = static_cast<std::size_t>(dim * physics_.interface_count);
  const bool has_impulse = in[2] != 0;
  const double *position = in.data() + 3, *velocity = position + size, *impulse = velocity + size;
  MovedInterface& interface = steps().interface;
  interface.begin_window(position, velocity, has_impulse, in[0], in[1]);
  steps().time = in[0];
  for (std::size_t n = 0; n < size; ++n) pair().wall_acceleration[n] = interface.acceleration(n);
  if (!has_impulse) return {};
  steps().move_interface(in[0]);
  lammps_->comm->forward_comm();
  pair().give_impulse(impulse);
  lammps_->comm->forward_comm();
  if (!physics_.midpoint) pair().evaluate(RatesOf::density);  // with the velocities as they are now
  return {};
}

/// Out: the extremes of all ranks.
Numbers Engine::step(double dt) {
  steps().begin(dt);
  command("run 2 pre no post no");
  const Extremes own = steps().extremes;
  long first = own.number;
  MPI_Allreduce(MPI_IN_PLACE, &first, 1, MPI_LONG, MPI_MIN, MPI_COMM_WORLD);
  const bool is_ours = first == own.number && first != Extremes::none;
  Numbers failed{is_ours ? static_cast<double>(own.quantity) : 0, is_ours ? own.value[0] : 0,
                 is_ours ? own.value[1] : 0};
  gather(failed);
  return {largest(own.speed), largest(own.acceleration), static_cast<double>(first), failed[0], failed[1],
          failed[2]};
}

/// Out: impulse on the fluid and the work of impulses; then by place sums of pressure, force and, if it is
/// wanted, the impedance.
Numbers Engine::take_load(bool with_impedance) {
  const auto count = static_cast<std::size_t>(physics_.interface_count);
  Numbers out((with_impedance ? 5 : 3) * count);
  double* const load[] = {pair().custom("load_p"), pair().custom("load_x"), pair().custom("load_y")};
  for (int i = 0; i < lammps_->atom->nlocal; ++i) {
    if (lammps_->atom->type[i] != Type::interface) continue;
    const auto k = static_cast<std::size_t>(pair().place(i));
    out[k] = load[0][i];
    out[count + 2 * k] = load[1][i];
    out[count + 2 * k + 1] = load[2][i];
    for (double* values : load) values[i] = 0;
  }
  if (with_impedance) pair().add_impedance(out.data() + 3 * count);
  gather(out);
  const auto impulse = pair().take_impulse().total();
  out.insert(out.begin(), impulse.begin(), impulse.end());
  return out;
}

/// Out: x, y, v_x, v_y, rho and drho of each particle of the fluid, then the interface's motion.
Numbers Engine::give_state() {
  Numbers out(6 * static_cast<std::size_t>(physics_.fluid_count));
  double *rho = pair().custom("rho"), *drho = pair().custom("drho");
  over_fluid([&](int i) {
    double* values = &out[6 * static_cast<std::size_t>(lammps_->atom->tag[i] - 1)];
    const double *x = lammps_->atom->x[i], *v = lammps_->atom->v[i];
    for (const double value : {x[0], x[1], v[0], v[1], rho[i], drho[i]}) *values++ = value;
  });
  gather(out);
  const Numbers motion = steps().interface.state();
  out.insert(out.end(), motion.begin(), motion.end());
  return out;
}

Numbers Engine::take_state(const Numbers& in) {
  const auto of = [&](int i) { return &in[6 * static_cast<std::size_t>(lammps_->atom->tag[i] - 1)]; };
  double* const rho = pair().custom("rho");
  over_fluid([&](int i) {
    for (int a = 0; a < dim; ++a) lammps_->atom->x[i][a] = of(i)[a], lammps_->atom->v[i][a] = of(i)[2 + a];
    rho[i] = of(i)[4];
  });
  steps().interface.set_state(&in[6 * static_cast<std::size_t>(physics_.fluid_count)]);
  steps().move_interface(steps().interface.end_time());
  command("run 0 post no");  // whose lists are of these places
  double* const drho = pair().custom("drho");
  over_fluid([&](int i) { drho[i] = of(i)[5]; });
  return {};
}

/// In: points of pressure probes. Out: kinetic and potential energy, momentum, the largest x, pressures.
Numbers Engine::observe(const Numbers& in) {
  ExactSums<2 + dim> sums;
  double front = -1e300;
  const auto* rho = pair().custom("rho");
  Numbers out;
  over_fluid([&](int i) {
    const double *x = lammps_->atom->x[i], *v = lammps_->atom->v[i], m = lammps_->atom->rmass[i];
    sums.add(0, 0.5 * m * (v[0] * v[0] + v[1] * v[1]));
    sums.add(1, -m * (physics_.gravity[0] * x[0] + physics_.gravity[1] * x[1]));
    for (std::size_t a = 0; a < dim; ++a) sums.add(2 + a, m * v[a]);
    front = std::max(front, x[0]);
  });
  for (const double sum : sums.total()) out.push_back(sum);
  out.push_back(largest(front));
  for (std::size_t k = 0; k < in.size(); k += dim) {
    ExactSums<2> mean;
    const CubicSpline cubic(physics_.h);
    const WendlandC2 wendland(physics_.h);
    over_fluid([&](int i) {
      const double r = std::hypot(lammps_->atom->x[i][0] - in[k], lammps_->atom->x[i][1] - in[k + 1]);
      const double W = physics_.wendland ? wendland.value(r) : cubic.value(r);
      mean.add(0, W);
      mean.add(1, W * physics_.pressure(rho[i]));
    });
    const auto [W, p] = mean.total();
    out.push_back(W > 0 ? p / W : 0);
  }
  return out;
}

}  // namespace toryu::lammps_fluid
