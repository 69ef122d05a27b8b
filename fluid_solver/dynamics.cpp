#include "fluid_solver/dynamics.hpp"

#include "fluid_solver/terms/density_gradient.hpp"
#include "fluid_solver/terms/velocity_gradient.hpp"

namespace toryu::fluid {

namespace {

/// A field that not every case has.
Lanes load_if_there(const Field& field, std::size_t first) {
  return field.empty() ? Lanes(0.0) : load(field, first);
}
VecLanes load_if_there(const VecField& field, std::size_t first) {
  return field[0].empty() ? zero_vector() : load(field, first);
}
TensorLanes load_if_there(const TensorField& field, std::size_t first) {
  return field[0][0].empty() ? zero_tensor() : load(field, first);
}

Targets load_targets(const Particles& f, std::size_t first) {
  const VecLanes v = load(f.v, first);
  return {load(f.x, first),
          v,
          v,
          load_if_there(f.grad_rho, first),
          load(f.rho, first),
          load(f.p_rho2, first),
          load_if_there(f.eta, first),
          load_if_there(f.eta_grad_v, first)};
}

Targets load_targets(const Boundary& b, std::size_t first) {
  return {load(b.x, first),
          load(b.v, first),
          load(b.v_viscous, first),
          zero_vector(),
          load(b.rho, first),
          load(b.p_rho2, first),
          load_if_there(b.eta, first),
          load_if_there(b.eta_grad_v, first)};
}

// Each term joins in where it has something to say.
TORYU_INLINE void add_density(const auto& term, const Targets& i, const Sources& s, std::size_t j,
                              const Pair& p, Rates& r) {
  if constexpr (requires { term.density(i, s, j, p, r); }) term.density(i, s, j, p, r);
}
TORYU_INLINE void add_diffusion(const auto& term, const Targets& i, const Sources& s, std::size_t j,
                                const Pair& p, Rates& r) {
  if constexpr (requires { term.diffusion(i, s, j, p, r); }) term.diffusion(i, s, j, p, r);
}
TORYU_INLINE void add_momentum(const auto& term, const Targets& i, const Sources& s, std::size_t j,
                               const Pair& p, Rates& r) {
  if constexpr (requires { term.momentum(i, s, j, p, r); }) term.momentum(i, s, j, p, r);
}
TORYU_INLINE void add_viscous(const auto& term, const Targets& i, const Sources& s, std::size_t j,
                              const Pair& p, Rates& r) {
  if constexpr (requires { term.viscous(i, s, j, p, r); }) term.viscous(i, s, j, p, r);
}

TORYU_INLINE void add_at_wall(const auto& term, const Targets& i, const Sources& s, std::size_t j,
                              const Pair& p, Rates& r) {
  if constexpr (requires { term.at_wall(i, s, j, p, r); }) term.at_wall(i, s, j, p, r);
}

Vec lane_sums(const Lanes& m, const VecLanes& after, const VecLanes& before) {
  Vec sum;
  for (int a = 0; a < dim; ++a) sum[a] = sum_of(m * (after[a] - before[a]));
  return sum;
}

/// What a pass over all pairs needs.
struct Sweep {
  const CubicSpline& kernel;
  Vec gravity;
  bool viscous_walls;
};

/// The rates of one cluster of `fluid` by `terms`.
template <class... Terms>
void rates_of_cluster(const Sweep& sweep, Particles& fluid, const ClusterList& neighbours,
                      const std::vector<Boundary>& boundaries, std::vector<Given>& given, std::size_t cluster,
                      const Terms... term) {
  const std::size_t first = cluster * lane_count;
  const Sources own = sources(fluid);
  const Targets i = load_targets(fluid, first);
  Rates rates;
  for (const std::uint32_t j : neighbours.sources(cluster)) {
    const Pair pair = make_pair(sweep.kernel, i, own, j);
    (add_density(term, i, own, j, pair, rates), ...);
    (add_diffusion(term, i, own, j, pair, rates), ...);
    (add_momentum(term, i, own, j, pair, rates), ...);
    (add_viscous(term, i, own, j, pair, rates), ...);
  }
  for (std::size_t b = 0; b < boundaries.size(); ++b) {
    given[b].by_cluster[cluster].setZero();
    const auto near = boundaries[b].near_fluid.sources(cluster);
    if (near.empty()) continue;
    const Sources wall = sources(boundaries[b]);
    const VecLanes before = rates.a;
    for (const std::uint32_t j : near) {
      const Pair pair = make_pair(sweep.kernel, i, wall, j);
      (add_density(term, i, wall, j, pair, rates), ...);
      (add_momentum(term, i, wall, j, pair, rates), ...);
      (add_at_wall(term, i, wall, j, pair, rates), ...);
      if (sweep.viscous_walls) (add_viscous(term, i, wall, j, pair, rates), ...);
    }
    given[b].by_cluster[cluster] = lane_sums(load(fluid.m, first), rates.a, before);
  }
  store(i.rho * rates.compression + rates.diffusion, fluid.drho, first);
  for (int a = 0; a < dim; ++a) store(rates.a[a] + sweep.gravity[a], fluid.a[a], first);
}

/// The momentum terms of the same pairs, gathered by one cluster of the boundary.
template <class... Terms>
void reaction_on_cluster(const Sweep& sweep, const Particles& fluid, Boundary& boundary, std::size_t cluster,
                         const Terms... term) {
  const std::size_t first = cluster * lane_count;
  const Sources own = sources(fluid);
  const Targets w = load_targets(boundary, first);
  Rates rates;
  for (const std::uint32_t i : boundary.fluid_near.sources(cluster)) {
    const Pair pair = make_pair(sweep.kernel, w, own, i);
    (add_momentum(term, w, own, i, pair, rates), ...);
    (add_at_wall(term, w, own, i, pair, rates), ...);
    if (sweep.viscous_walls) (add_viscous(term, w, own, i, pair, rates), ...);
  }
  for (int a = 0; a < dim; ++a) store(load(boundary.m, first) * rates.a[a], boundary.force[a], first);
}

}  // namespace

Vec Given::force() const {
  Vec sum = friction();
  for (const auto& part : by_cluster) sum += part;
  return sum;
}

Vec Given::friction() const {
  Vec sum = Vec::Zero();
  for (const auto& part : friction_by_cluster) sum += part;
  return sum;
}

Dynamics::Dynamics(const Parameters& parameters, const Vec& gravity)
    : parameters_(parameters),
      gravity_(gravity),
      kernel_(parameters.h()),
      state_{parameters.density, parameters.sound_speed, parameters.stiffness_exponent,
             parameters.background_pressure ? parameters.background_pressure->pressure : 0.0} {
  const double h = parameters.h(), c_0 = parameters.sound_speed;
  if (const auto& d = parameters.density_diffusion) {
    if (d->gradient == DiffusionGradient::renormalised)
      diffusion_ = DensityDiffusionTerm<true>{d->delta * h * c_0};
    else
      diffusion_ = DensityDiffusionTerm<false>{d->delta * h * c_0};
  }
  if (const auto& a = parameters.artificial_viscosity)
    artificial_ = ArtificialViscosityTerm{a->alpha, a->beta, h, c_0};
  if (const auto& l = parameters.laminar_viscosity) viscous_ = LaminarViscosityTerm{l->dynamic_viscosity};
  if (const auto& r = parameters.wall_repulsion) {
    const double d_0 = parameters.spacing;
    repulsion_ = WallRepulsionTerm{r->strength * c_0 * c_0 / (parameters.density * d_0 * d_0 * d_0),
                                   1 / (r->range * d_0)};
  }
  if (parameters.power_law) rheology_ = *parameters.power_law;
  if (parameters.carreau) rheology_ = *parameters.carreau;
  if (viscosity_varies()) viscous_ = VariableViscosityTerm{};
  if (const auto& f = parameters.friction) friction_.emplace(*f, parameters.spacing, c_0, kernel_);
}

void Dynamics::pressures(Particles& fluid) const {
#pragma omp for schedule(static)
  for (std::size_t c = 0; c < fluid.clusters(); ++c) {
    const std::size_t first = c * lane_count;
    const Lanes rho = load(fluid.rho, first), inverse_rho = inverse(rho);
    const Lanes p = state_.pressure(rho);
    store(p, fluid.p, first);
    store(p * inverse_rho * inverse_rho, fluid.p_rho2, first);
    store(load(fluid.m, first) * inverse_rho, fluid.V, first);
  }
}

void Dynamics::wall_densities(Boundary& boundary) const {
  const auto& active = boundary.fluid_near.active();
#pragma omp for schedule(static)
  for (std::size_t k = 0; k < active.size(); ++k)
    for (std::size_t w = active[k] * lane_count; w < (active[k] + 1) * lane_count; ++w) {
      boundary.rho[w] = state_.density(std::max(boundary.p[w], state_.p_b - 0.5 * state_.p_0()));
      boundary.m[w] = boundary.rho[w] * boundary.V[w];
      boundary.p_rho2[w] = boundary.p[w] / (boundary.rho[w] * boundary.rho[w]);
    }
}

double Dynamics::viscosity_at_rest() const {
  if (const auto& laminar = parameters_.laminar_viscosity) return laminar->dynamic_viscosity;
  return std::visit(
      []<class Law>(const Law& law) {
        if constexpr (std::is_same_v<Law, Absent>)
          return 0.0;
        else
          return viscosity(law, 0.0);
      },
      rheology_);
}

void Dynamics::viscosities(Particles& fluid, const ClusterList& neighbours,
                           std::vector<Boundary>& boundaries) const {
  std::visit(
      [&]<class Law>(const Law& law) {
        if constexpr (!std::is_same_v<Law, Absent>) {
#pragma omp for schedule(dynamic, 8)
          for (std::size_t c = 0; c < fluid.clusters(); ++c) {
            const std::size_t first = c * lane_count;
            VelocityGradient gradient(load(fluid.x, first), load(fluid.v, first));
            gradient.add(sources(fluid), neighbours.sources(c), kernel_);
            if (viscous_walls())
              for (const auto& wall : boundaries)
                gradient.add(sources(wall), wall.near_fluid.sources(c), kernel_);
            TensorLanes grad_v = gradient.value();
            const Lanes gdot = shear_rate(grad_v), eta = viscosity(law, gdot);
            for (auto& row : grad_v)
              for (auto& component : row) component *= eta;
            store(gdot, fluid.gdot, first);
            store(eta, fluid.eta, first);
            store(grad_v, fluid.eta_grad_v, first);
          }
          if (viscous_walls())
            for (auto& wall : boundaries) extrapolate_viscosity(wall, fluid, kernel_);
        }
      },
      rheology_);
}

void Dynamics::evaluate(Particles& fluid, const ClusterList& neighbours, std::vector<Boundary>& boundaries,
                        std::vector<Given>& given, Timers& timers) const {
  const bool renormalised = std::holds_alternative<DensityDiffusionTerm<true>>(diffusion_);
  given.resize(boundaries.size());
  for (auto& part : given) part.by_cluster.resize(fluid.clusters());
  if (viscosity_varies())
    for (auto& boundary : boundaries) {
      boundary.eta.resize(boundary.V.size());
      resize(boundary.eta_grad_v, boundary.V.size());
    }
  {
    const auto timer = timers.measure("pressure, walls and density gradient");
#pragma omp parallel
    {
      pressures(fluid);
      for (auto& boundary : boundaries) {
        extrapolate(boundary, fluid, kernel_, gravity_);
        if (parameters_.wall_model.density == WallDensity::from_pressure) wall_densities(boundary);
      }
      if (renormalised) {
#pragma omp for schedule(dynamic, 8)
        for (std::size_t c = 0; c < fluid.clusters(); ++c)
          store(density_gradient(fluid, kernel_, c * lane_count, neighbours.sources(c)), fluid.grad_rho,
                c * lane_count);
      }
    }
  }
  if (viscosity_varies()) {
    const auto timer = timers.measure("shear rate and viscosity");
#pragma omp parallel
    viscosities(fluid, neighbours, boundaries);
  }
  const auto timer = timers.measure("rates");
  std::visit(
      [&](const auto&... terms) {
        const Sweep sweep{kernel_, gravity_, viscous_walls()};
#pragma omp parallel for schedule(dynamic, 8)
        for (std::size_t c = 0; c < fluid.clusters(); ++c)
          rates_of_cluster(sweep, fluid, neighbours, boundaries, given, c, Continuity{}, Pressure{},
                           terms...);
      },
      diffusion_, artificial_, viscous_, repulsion_);
  if (!friction_) return;
  for (std::size_t b = 0; b < boundaries.size(); ++b)
    if (boundaries[b].is_work_piece()) {
      friction_->measure_contact(boundaries[b], fluid);
      friction_->brake_fluid(fluid, boundaries[b], given[b].friction_by_cluster);
    }
}

void Dynamics::react(const Particles& fluid, Boundary& boundary) const {
  for (auto& component : boundary.force) std::fill(component.begin(), component.end(), 0.0);
  const auto& active = boundary.fluid_near.active();
  std::visit(
      [&](const auto&... terms) {
        const Sweep sweep{kernel_, gravity_, viscous_walls()};
#pragma omp parallel for schedule(dynamic, 4)
        for (std::size_t k = 0; k < active.size(); ++k)
          reaction_on_cluster(sweep, fluid, boundary, active[k], Pressure{}, terms...);
      },
      artificial_, viscous_, repulsion_);
  react_by_friction(fluid, boundary);
}

void Dynamics::react_by_friction(const Particles& fluid, Boundary& work_piece) const {
  if (friction_ && work_piece.is_work_piece()) friction_->drag_work_piece(work_piece, fluid);
}

std::vector<ActiveTerm> Dynamics::active_terms() const {
  std::vector<ActiveTerm> terms;
  const double h = parameters_.h(), c_0 = parameters_.sound_speed;
  terms.push_back(
      {"equation of state", "p = rho_0 c_0^2/gamma [(rho/rho_0)^gamma - 1]", "Monaghan 1994, eq. 3",
       fmt::format("rho_0 {} kg/m3, c_0 {} m/s, gamma {}", state_.rho_0, state_.c_0, state_.gamma)});
  if (parameters_.background_pressure)
    terms.push_back({"background pressure", "p_b added to the equation of state",
                     "Colagrossi, Bouscasse, Antuono & Marrone 2012", fmt::format("p_b {} Pa", state_.p_b)});
  terms.push_back({"continuity", "Drho_i/Dt = rho_i sum_j V_j v_ij . gradW_ij", "eq. 18",
                   fmt::format("cubic spline, h = {:.4g} m = {} d_0", h, parameters_.smoothing_ratio)});
  terms.push_back({"pressure", "- sum_j m_j (p_i/rho_i^2 + p_j/rho_j^2) gradW_ij", "eq. 22", ""});
  if (const auto& d = parameters_.density_diffusion)
    terms.push_back({"density diffusion", "delta h c_0 sum_j V_j psi_ij . gradW_ij",
                     d->gradient == DiffusionGradient::renormalised ? "Marrone et al. 2011, eq. 18-21"
                                                                    : "Molteni & Colagrossi 2009",
                     fmt::format("delta {}", d->delta)});
  if (const auto& a = parameters_.artificial_viscosity)
    terms.push_back({"artificial viscosity", "- sum_j m_j Pi_ij gradW_ij", "Monaghan 1992, eq. 23-24",
                     fmt::format("alpha {}, beta {}; acts like a kinematic viscosity of {:.3g} m2/s",
                                 a->alpha, a->beta, effective_kinematic_viscosity(a->alpha, h, c_0))});
  if (const auto& l = parameters_.laminar_viscosity)
    terms.push_back({"laminar viscosity",
                     "sum_j m_j 2 mu/(rho_i rho_j) x_ij . gradW_ij/(r^2 + 0.01 h^2) v_ij",
                     "Morris, Fox & Zhu 1997", fmt::format("mu {} Pa s", l->dynamic_viscosity)});
  if (const auto& law = parameters_.power_law)
    terms.push_back({"power law", "eta = m gdot^(n-1), harmonic mean of a pair",
                     "Ostwald 1925, de Waele 1923",
                     fmt::format("m {} Pa s^n, n {}, {} to {} Pa s", law->consistency, law->exponent,
                                 law->smallest_viscosity, law->largest_viscosity)});
  if (const auto& law = parameters_.carreau)
    terms.push_back(
        {"Carreau", "eta = eta_inf + (eta_0 - eta_inf) (1 + (lambda gdot)^2)^((n-1)/2)", "Carreau 1972",
         fmt::format("eta_0 {} Pa s, eta_inf {} Pa s, lambda {} s, n {}", law->zero_shear_viscosity,
                     law->infinite_shear_viscosity, law->relaxation_time, law->exponent)});
  if (const auto& r = parameters_.wall_repulsion)
    terms.push_back({"wall repulsion", "m_i m_w/(rho_0 d_0^2) B c_0^2/d_0 (1 - r/r_0), r < r_0",
                     "in the manner of Monaghan & Kajtar 2009",
                     fmt::format("B {}, r_0 {} d_0", r->strength, r->range)});
  if (friction_)
    terms.push_back({"friction", "F_s = mu_A sum_f V_f max(p_f, 0) d_s v_fs/sqrt(v_fs^2 + eps^2) W_sf",
                     "eq. 33, mended", friction_->parameters()});
  terms.push_back({"walls", "pressure and velocity extrapolated from the fluid",
                   "Adami, Hu & Adams 2012, eq. 27-29",
                   parameters_.wall_model.slip == WallSlip::no_slip ? "no slip" : "free slip"});
  if (gravity_.norm() > 0)
    terms.push_back({"gravity", "g", "", fmt::format("({}, {}) m/s2", gravity_[0], gravity_[1])});
  return terms;
}

}  // namespace toryu::fluid
