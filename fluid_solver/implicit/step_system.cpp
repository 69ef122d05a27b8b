#include "fluid_solver/implicit/step_system.hpp"

#include <cmath>
#include <limits>

#include "fluid_solver/held_pressure.hpp"
#include "fluid_solver/wall_extrapolation.hpp"
#include "fluid_solver/weakly_compressible/pair_loop.hpp"

namespace toryu::fluid {

namespace {

/// Of the grid of the preconditioner. A throat of n = 0.4, 20 across, takes 6 products a step with cells of h
/// to 3 h, and as walls hold by 0.2, 1, 4 and 16 it takes 9, 6, 4 and 3 (17 without the grid).
constexpr double cell_over_h = 2, hold_of_walls = 16;

/// Of a sum over neighbours, relative to one of its parts.
constexpr double rounding_of_sums = 16 * std::numeric_limits<double>::epsilon();

/// The first component of `count` particles, then the second; what is behind is not theirs.
void set_all(VecField& field, const StepSystem::Vector& all, std::size_t count) {
  const auto n = static_cast<Eigen::Index>(count);
  for (int a = 0; a < dim; ++a) Eigen::Map<StepSystem::Vector>(field[a].data(), n) = all.segment(a * n, n);
}

/// sums[b] += sum_j V_j (v_j - v_i)_b gradW_ij.
template <class W>
TORYU_INLINE void add_differences(const W& kernel, std::span<const ShiftedNeighbours> near,
                                  const VecLanes& x_i, const VecLanes& v_i, const Sources& s,
                                  const Positions& v, TensorLanes& sums) {
  over_neighbours(kernel, near, x_i, s.x, [&](std::uint32_t j, const Neighbour& n) TORYU_INLINE_LAMBDA {
    const VecLanes V_grad = n.gradient(s.V[j]);
    for (int b = 0; b < dim; ++b) add_product(sums[b], v[b][j] - v_i[b], V_grad);
  });
}

/// sum + factor a (x) b.
TORYU_INLINE void add_dyad(TensorLanes& sum, const Lanes& factor, const VecLanes& a, const VecLanes& b) {
  for (int k = 0; k < dim; ++k)
    for (int l = 0; l < dim; ++l) sum[k][l] += factor * a[k] * b[l];
}

}  // namespace

ImplicitTerms::ImplicitTerms(const Parameters& of_case, const Vec& gravity, const Kernel& W,
                             const EquationOfState& of_medium)
    : parameters(of_case),
      kernel(W),
      state(of_medium),
      body_force{.gravity = gravity},
      viscous_walls(of_case.wall_model.slip == WallSlip::no_slip) {
  if (const auto& l = of_case.laminar_viscosity)
    chosen.viscous = LaminarViscosityTerm{l->dynamic_viscosity};
  else if (is_viscous(of_case))
    chosen.viscous = VariableViscosityTerm{};
}

StepSystem::StepSystem(const ImplicitTerms& terms, Particles& fluid, const ClusterList& neighbours,
                       std::vector<Boundary>& boundaries, double dt)
    : terms_(terms),
      fluid_(fluid),
      neighbours_(neighbours),
      boundaries_(boundaries),
      dt_(dt),
      pistons_(boundaries, terms.parameters, terms.state, dt),
      p_offset_(terms.slides()
                    ? pressure_offset(terms.parameters.enclosed_medium, fluid, boundaries, terms.state)
                    : 0.0),
      v_n_(joined(fluid.v, pistons_.speeds())),
      p_n_(padded(fluid.count)),
      c2_(padded(fluid.count)) {
  const EquationOfState& s = terms.state;
  for (std::size_t i = 0; i < fluid.count; ++i) {
    const double rho = fluid.rho[i];
    fluid.V[i] = fluid.m[i] / rho;
    p_n_[i] = s.pressure(rho);
    c2_[i] = s.gamma * (p_n_[i] - s.p_b + s.p_0()) / rho;
  }
  for (Boundary& boundary : boundaries) {
    boundary.force_on_fluid.by_cluster.resize(fluid.clusters());
    if (terms.slides()) {
      resize(boundary.slip_velocity, boundary.V.size());
      boundary.shear_stress.resize(boundary.V.size());
    }
    if (!terms.viscosity_varies()) continue;
    boundary.eta.resize(boundary.V.size());
    resize(boundary.eta_grad_v, boundary.V.size());
  }
  pistons_.take_areas(fluid, terms.kernel);
  if (!terms.viscosity_varies()) return;
  moments_.resize(fluid.clusters());
  terms.kernel.visit([&](const auto& W) {
#pragma omp parallel for schedule(dynamic, 8)
    for (std::size_t c = 0; c < fluid.clusters(); ++c) find_moment(W, c);
  });
}

StepSystem::Vector StepSystem::joined(const VecField& field, const Vector& speeds) const {
  const auto n = static_cast<Eigen::Index>(fluid_.count);
  Vector all(components() + speeds.size());
  for (int a = 0; a < dim; ++a) all.segment(a * n, n) = Eigen::Map<const Vector>(field[a].data(), n);
  all.tail(speeds.size()) = speeds;
  return all;
}

void StepSystem::move_at(const Vector& v) {
  set_all(fluid_.v, v, fluid_.count);
  pistons_.move_at(v.tail(pistons_.count()));
}

StepSystem::Vector StepSystem::foreseen_velocities() const {
  return v_n_ + dt_ * joined(fluid_.a_before, pistons_.accelerations());
}

void StepSystem::finish(const Vector& v) {
  move_at(v);
  const Vector a = (v - v_n_) / dt_;
  set_all(fluid_.a, a, fluid_.count);
  set_all(fluid_.a_before, a, fluid_.count);
  pistons_.finish(v.tail(pistons_.count()));
}

template <class W>
void StepSystem::find_moment(const W& kernel, std::size_t cluster) {
  const VecLanes x_i = load(fluid_.x, cluster * lane_count);
  Moment& moment = moments_[cluster];
  const auto add = [&](const Sources& s, std::span<const ShiftedNeighbours> near) {
    over_neighbours(kernel, near, x_i, s.x, [&](std::uint32_t j, const Neighbour& n) TORYU_INLINE_LAMBDA {
      moment.add(n.x_ij, n.gradient(s.V[j]));
    });
  };
  add(sources(fluid_), neighbours_.near(cluster));
  if (terms_.viscous_walls)
    for (const Boundary& wall : boundaries_) add(sources(wall), wall.list_for_fluid.near(cluster));
  moment.invert();
}

template <class W>
void StepSystem::compress(const W& kernel, std::size_t cluster) {
  const std::size_t first = cluster * lane_count;
  const VecLanes x_i = load(fluid_.x, first), v_i = load(fluid_.v, first);
  TensorLanes of_fluid = zero_tensor(), of_walls = zero_tensor();
  add_differences(kernel, neighbours_.near(cluster), x_i, v_i, sources(fluid_), sources(fluid_).v, of_fluid);
  for (const Boundary& wall : boundaries_)
    add_differences(kernel, wall.list_for_fluid.near(cluster), x_i, v_i, sources(wall), sources(wall).v,
                    of_walls);
  if (terms_.viscosity_varies()) store(of_fluid, fluid_.eta_grad_v, first);
  const Lanes rho_i = load(fluid_.rho, first), inverse_rho = inverse(rho_i);
  const Lanes drho = -1.0 * rho_i * (of_fluid[0][0] + of_fluid[1][1] + of_walls[0][0] + of_walls[1][1]);
  const Lanes p = load(p_n_, first) + dt_ * load(c2_, first) * drho;
  store(drho, fluid_.drho, first);
  store(p, fluid_.p, first);
  store(p * inverse_rho * inverse_rho, fluid_.p_rho2, first);
}

template <class W>
void StepSystem::stresses(const W& kernel, std::size_t cluster, Viscosity viscosity) {
  const std::size_t first = cluster * lane_count;
  TensorLanes sums = load(fluid_.eta_grad_v, first), grad_v;  // of the fluid, as `compress` leaves them
  if (terms_.viscous_walls)
    for (const Boundary& wall : boundaries_)
      add_differences(kernel, wall.list_for_fluid.near(cluster), load(fluid_.x, first), load(fluid_.v, first),
                      sources(wall), sources(wall).v_viscous, sums);
  for (int b = 0; b < dim; ++b) {
    const VecLanes grad_v_b = moments_[cluster].renormalised(sums[b]);
    for (int a = 0; a < dim; ++a) grad_v[a][b] = grad_v_b[a];
  }
  if (viscosity == Viscosity::renewed) {
    const Lanes gdot = shear_rate(grad_v);
    store(gdot, fluid_.gdot, first);
    for (std::size_t lane = 0; lane < lane_count; ++lane)
      fluid_.eta[first + lane] = viscosity_of(terms_.parameters, gdot[lane]);
  }
  for (auto& row : grad_v)
    for (auto& component : row) component *= load(fluid_.eta, first);
  store(grad_v, fluid_.eta_grad_v, first);
}

void StepSystem::evaluate(Viscosity viscosity) {
  const PairSweeps sweeps = terms_.sweeps(terms_.chosen);
  terms_.kernel.visit([&](const auto& W) {
#pragma omp parallel
    {
#pragma omp for schedule(dynamic, 8)
      for (std::size_t c = 0; c < fluid_.clusters(); ++c) compress(W, c);
      for (Boundary& boundary : boundaries_) {
        extrapolate(boundary, fluid_, terms_.kernel, terms_.body_force.gravity);
        if (terms_.slides()) let_slide(boundary, fluid_, terms_.kernel, terms_.parameters, p_offset_);
      }
      if (terms_.viscosity_varies()) {
#pragma omp for schedule(dynamic, 8)
        for (std::size_t c = 0; c < fluid_.clusters(); ++c) stresses(W, c, viscosity);
        if (terms_.viscous_walls)
          for (Boundary& boundary : boundaries_) extrapolate_viscosity(boundary, fluid_, terms_.kernel);
      }
    }
    sweeps.rates(W, RatesOf::velocity, fluid_, neighbours_, boundaries_);
  });
}

StepSystem::Vector StepSystem::unbalance(const Vector& v, Viscosity viscosity) {
  move_at(v);
  evaluate(viscosity);
  Vector r = v_n_ + dt_ * joined(fluid_.a, Vector::Zero(pistons_.count())) - v;
  r.tail(pistons_.count()) = pistons_.unbalance(v.tail(pistons_.count()));
  return r;
}

StepSystem::Vector StepSystem::driving() {
  Vector r = unbalance(Vector::Zero(v_n_.size()), Viscosity::kept);
  r.tail(pistons_.count()) = pistons_.driving();
  return r;
}

StepSystem::Vector StepSystem::unbalance_between_stops(Vector& v) {
  Vector u = v.tail(pistons_.count());
  pistons_.release(u);
  v.tail(u.size()) = u;
  Vector r = unbalance(v, Viscosity::renewed);
  pistons_.hold_at_stops(u);
  r.tail(u.size()) = pistons_.unbalance(u);
  return r;
}

std::vector<StepSystem::Block> StepSystem::diagonal() const {
  std::vector<Block> blocks(fluid_.count);
  const double mu =
      terms_.parameters.laminar_viscosity ? terms_.parameters.laminar_viscosity->dynamic_viscosity : 0;
  const bool varies = terms_.viscosity_varies();
  const auto of_cluster = [&](const auto& W, std::size_t c) {
    const std::size_t first = c * lane_count;
    const VecLanes x_i = load(fluid_.x, first);
    const Lanes rho_i = load(fluid_.rho, first), V_i = load(fluid_.V, first), c2_i = load(c2_, first);
    const Lanes eta_i = varies ? load(fluid_.eta, first) : Lanes(mu);
    Lanes viscous = 0.0;
    VecLanes of_volume = zero_vector(), of_mass = zero_vector();
    TensorLanes of_pressure = zero_tensor();
    const auto add = [&](const Sources& s, std::span<const ShiftedNeighbours> near, bool is_fluid) {
      over_neighbours(W, near, x_i, s.x, [&](std::uint32_t j, const Neighbour& n) TORYU_INLINE_LAMBDA {
        const Lanes V_G = s.V[j] * n.G;
        if (is_fluid || terms_.viscous_walls) {
          const Lanes eta_j = varies ? Lanes(s.eta[j]) : Lanes(mu);
          viscous += 4.0 * eta_i * eta_j * inverse(max(eta_i + eta_j, 1e-300)) * V_G;
        }
        add_product(of_volume, V_G, n.x_ij);
        add_product(of_mass, s.m[j] * n.G, n.x_ij);
        if (is_fluid) add_dyad(of_pressure, V_G * n.G * V_i * c2_[j], n.x_ij, n.x_ij);
      });
    };
    add(sources(fluid_), neighbours_.near(c), true);
    for (const Boundary& wall : boundaries_) add(sources(wall), wall.list_for_fluid.near(c), false);
    add_dyad(of_pressure, c2_i * inverse(rho_i), of_mass, of_volume);
    const Lanes own = 1.0 - dt_ * viscous * inverse(rho_i);
    for (std::size_t i = first; i < std::min(first + lane_count, fluid_.count); ++i)
      for (int k = 0; k < dim; ++k)
        for (int l = 0; l < dim; ++l)
          blocks[i](k, l) = (k == l ? own[i - first] : 0.0) + dt_ * dt_ * of_pressure[k][l][i - first];
  };
  terms_.kernel.visit([&](const auto& W) {
#pragma omp parallel for schedule(dynamic, 8)
    for (std::size_t c = 0; c < fluid_.clusters(); ++c) of_cluster(W, c);
  });
  return blocks;
}

double StepSystem::rounding() const {
  double sum = 0;
  for (std::size_t i = 0; i < fluid_.count; ++i) {
    const double of_pressure = (std::abs(p_n_[i]) + fluid_.rho[i] * c2_[i]) / fluid_.rho[i];
    sum += of_pressure * of_pressure;
  }
  return rounding_of_sums * dt_ * std::sqrt(dim * sum) / terms_.parameters.spacing;
}

std::optional<CoarseFlow> StepSystem::coarse_flow() const {
  const Parameters& p = terms_.parameters;
  const bool varies = terms_.viscosity_varies();
  const double mu = p.laminar_viscosity ? p.laminar_viscosity->dynamic_viscosity : 0;
  const double hold = hold_of_walls / (p.spacing * p.spacing);
  if (!CoarseFlow::pays(fluid_.x, fluid_.count, cell_over_h * p.h())) return std::nullopt;
  CoarseFlow coarse(fluid_.x, fluid_.count, cell_over_h * p.h(), pistons_.of_coarse_flow());
  for (std::size_t i = 0; i < fluid_.count; ++i) {
    const double dt_V = dt_ * fluid_.V[i];
    coarse.add(at(fluid_.x, i), fluid_.m[i], dt_V * (varies ? fluid_.eta[i] : mu),
               dt_ * dt_V * fluid_.rho[i] * c2_[i]);
  }
  if (terms_.viscous_walls)
    for (const Boundary& wall : boundaries_) {
      const auto piston = pistons_.free_number_of(wall);
      for (const std::uint32_t cluster : wall.list_for_wall.active())
        for (std::size_t w = cluster * lane_count; w < (cluster + 1) * lane_count && w < wall.count; ++w) {
          const double weight = hold * dt_ * wall.V[w] * (varies ? wall.eta[w] : mu);
          if (piston)
            coarse.hold(at(wall.x, w), weight, *piston, pistons_.axis(*piston));
          else
            coarse.hold(at(wall.x, w), weight);
        }
    }
  coarse.factorise();
  return coarse;
}

}  // namespace toryu::fluid
