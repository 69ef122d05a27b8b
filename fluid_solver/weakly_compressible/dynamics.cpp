#include "fluid_solver/weakly_compressible/dynamics.hpp"

#include "fluid_solver/axis_images.hpp"
#include "fluid_solver/held_pressure.hpp"
#include "fluid_solver/terms/axisymmetry.hpp"
#include "fluid_solver/terms/density_gradient.hpp"
#include "fluid_solver/wall_extrapolation.hpp"
#include "fluid_solver/wall_turning.hpp"
#include "fluid_solver/weakly_compressible/consistent_gradients.hpp"
#include "fluid_solver/weakly_compressible/further_forces.hpp"
#include "fluid_solver/weakly_compressible/pair_loop.hpp"
#include "fluid_solver/weakly_compressible/polymer.hpp"

namespace toryu::fluid {

namespace {

/// By one thread of a team, while the others wait.
template <class Work>
void once(Work&& work) {
#pragma omp single
  work();
}

}  // namespace

Dynamics::Dynamics(const Parameters& parameters, const Vec& gravity, const Kernel& kernel,
                   const EquationOfState& state, Geometry geometry)
    : parameters_(parameters),
      body_force_{.gravity = gravity},
      medium_{parameters.density, parameters.sound_speed, parameters.spacing, kernel},
      state_(state),
      geometry_(geometry) {
  if (const auto& force = parameters.central_force) {
    body_force_.centre = force->centre;
    body_force_.central_rate_squared = force->rate * force->rate;
  }
  const double h = parameters.h(), c_0 = parameters.sound_speed;
  if (const auto& d = parameters.density_diffusion) {
    if (d->gradient == DiffusionGradient::renormalised)
      terms_.diffusion = DensityDiffusionTerm<true>{d->delta * h * c_0};
    else
      terms_.diffusion = DensityDiffusionTerm<false>{d->delta * h * c_0};
  }
  if (const auto& a = parameters.artificial_viscosity)
    terms_.artificial = ArtificialViscosityTerm{a->alpha, a->beta, h, c_0};
  if (const auto& l = parameters.laminar_viscosity)
    terms_.viscous = LaminarViscosityTerm{l->dynamic_viscosity};
  if (const auto& r = parameters.wall_repulsion) {
    const double d_0 = parameters.spacing;
    terms_.repulsion = WallRepulsionTerm{r->strength * c_0 * c_0 / (parameters.density * d_0 * d_0 * d_0),
                                         1 / (r->range * d_0)};
  }
  if (parameters.power_law) rheology_ = *parameters.power_law;
  if (parameters.herschel_bulkley) rheology_ = *parameters.herschel_bulkley;
  if (parameters.carreau) rheology_ = *parameters.carreau;
  if (viscosity_varies()) terms_.viscous = VariableViscosityTerm{};
  if (const auto& f = parameters.friction; f && !parameters.wall_slip)  // else the walls have it
    friction_.emplace(*f, parameters.spacing, c_0, medium_.kernel, geometry);
}

void Dynamics::allocate(Particles& fluid) const {
  const std::size_t size = fluid.rho.size();
  if (renormalised_diffusion()) resize(fluid.grad_rho, size);
  if (parameters_.viscoelasticity) allocate_polymer(*parameters_.viscoelasticity, fluid);
  if (!viscosity_varies()) return;
  fluid.gdot.assign(size, 0.0);
  fluid.eta.assign(size, viscosity_at_rest());
  resize(fluid.eta_grad_v, size);
}

void Dynamics::pressures(Particles& fluid) const {
#pragma omp for schedule(static)
  for (std::size_t c = 0; c < fluid.clusters(); ++c) {
    const std::size_t first = c * lane_count;
    const Lanes rho = load(fluid.rho, first), inverse_rho = inverse(rho);
    const Lanes p = state_.pressure(rho);
    store(p, fluid.p, first);
    store(p * inverse_rho * inverse_rho, fluid.p_rho2, first);
    Lanes V = load(fluid.m, first) * inverse_rho;
    if (axisymmetric()) V *= inverse(circumference(load(fluid.x[1], first)));
    store(V, fluid.V, first);
  }
}

void Dynamics::wall_densities(Boundary& boundary) const {
  const auto& active = boundary.list_for_wall.active();
#pragma omp for schedule(static)
  for (std::size_t k = 0; k < active.size(); ++k)
    for (std::size_t w = active[k] * lane_count; w < (active[k] + 1) * lane_count; ++w) {
      boundary.rho[w] = state_.density(std::max(boundary.p[w], state_.p_b - 0.5 * state_.p_0()));
      boundary.m[w] = boundary.rho[w] * boundary.V[w];
      boundary.p_rho2[w] = boundary.p[w] / (boundary.rho[w] * boundary.rho[w]);
    }
}

void Dynamics::density_gradients(Particles& fluid, const ClusterList& neighbours,
                                 const std::vector<std::uint32_t>* some) const {
  const std::size_t count = some ? some->size() : fluid.clusters();
  medium_.kernel.visit([&](const auto& W) {
#pragma omp for schedule(dynamic, 8)
    for (std::size_t k = 0; k < count; ++k) {
      const std::size_t c = some ? (*some)[k] : k;
      store(density_gradient(fluid, W, c * lane_count, neighbours.near(c)), fluid.grad_rho, c * lane_count);
    }
  });
}

void Dynamics::viscosities(Particles& fluid, const ClusterList& neighbours,
                           std::vector<Boundary>& boundaries) const {
  const auto of_cluster = [&](const auto& law, const auto& W, std::size_t c) {
    const std::size_t first = c * lane_count;
    TensorLanes grad_v = velocity_gradient(W, fluid, neighbours, boundaries, viscous_walls(), c);
    Lanes gdot = shear_rate(grad_v);
    if (axisymmetric()) {  // D has v_r/r too
      const Lanes D_hoop = load(fluid.v[1], first) * inverse(load(fluid.x[1], first));
      gdot = square_root(gdot * gdot + 2.0 * D_hoop * D_hoop);
    }
    const Lanes eta = viscosity(law, gdot);
    for (auto& row : grad_v)
      for (auto& component : row) component *= eta;
    store(gdot, fluid.gdot, first);
    store(eta, fluid.eta, first);
    store(grad_v, fluid.eta_grad_v, first);
  };
  const auto of_all = [&]<class Law>(const Law& law) {
    if constexpr (!std::is_same_v<Law, Absent>)
      medium_.kernel.visit([&](const auto& W) {
#pragma omp for schedule(dynamic, 8)
        for (std::size_t c = 0; c < fluid.clusters(); ++c) of_cluster(law, W, c);
      });
  };
  std::visit(of_all, rheology_);
  if (axisymmetric()) once([&] { mirror_viscosity(fluid); });
  if (viscous_walls())
    for (auto& wall : boundaries) {
      extrapolate_viscosity(wall, fluid, medium_.kernel);
      if (axisymmetric()) once([&] { mirror_viscosity(wall); });
    }
}

void Dynamics::polymer_stresses(Particles& fluid, std::vector<Boundary>& boundaries) const {
#pragma omp for schedule(static)
  for (std::size_t c = 0; c < fluid.clusters(); ++c)
    find_polymer_stress(*parameters_.viscoelasticity, fluid, c);
  for (auto& wall : boundaries) extrapolate_polymer_stress(wall, fluid, medium_.kernel);
}

void Dynamics::log_conformation_rates(Particles& fluid, const ClusterList& neighbours,
                                      const std::vector<Boundary>& boundaries,
                                      const std::vector<std::uint32_t>* some) const {
  const std::size_t count = some ? some->size() : fluid.clusters();
  medium_.kernel.visit([&](const auto& W) {
#pragma omp for schedule(dynamic, 8)
    for (std::size_t k = 0; k < count; ++k) {
      const std::size_t c = some ? (*some)[k] : k;
      find_log_conformation_rate(*parameters_.viscoelasticity,
                                 velocity_gradient(W, fluid, neighbours, boundaries, viscous_walls(), c),
                                 fluid, c);
    }
  });
}

void Dynamics::evaluate(RatesOf wanted, Particles& fluid, const ClusterList& neighbours,
                        std::vector<Boundary>& boundaries, Timers& timers, const Ranks* ranks) const {
  const Swept* swept = ranks ? &ranks->swept() : nullptr;
  const auto* own = swept ? &swept->own : nullptr;
  const bool density = wanted != RatesOf::velocity, velocity = wanted != RatesOf::density;
  const bool polymer = parameters_.viscoelasticity.has_value();
  for (auto& boundary : boundaries) boundary.force_on_fluid.make_room(fluid.clusters(), polymer);
  if (viscosity_varies())
    for (auto& boundary : boundaries) {
      boundary.eta.resize(boundary.V.size());
      resize(boundary.eta_grad_v, boundary.V.size());
    }
  if (parameters_.wall_slip)
    for (auto& boundary : boundaries) {
      resize(boundary.slip_velocity, boundary.V.size());
      boundary.shear_stress.resize(boundary.V.size());
    }
  if (polymer)
    for (auto& boundary : boundaries) resize(boundary.polymer_stress, boundary.V.size());
  {
    const auto timer = timers.measure("pressure, walls and density gradient");
    const double p_offset = parameters_.wall_slip ? pressure_offset(fluid, boundaries, ranks) : 0.0;
#pragma omp parallel
    {
      pressures(fluid);
      if (axisymmetric()) once([&] { mirror_bodies(fluid, boundaries); });
      if (velocity || polymer)  // whose rate is found with the density's
        for (auto& boundary : boundaries) {
          extrapolate(boundary, fluid, medium_.kernel, body_force_.gravity);
          if (parameters_.wall_slip) let_slide(boundary, fluid, medium_.kernel, parameters_, p_offset);
          if (parameters_.wall_model.density == WallDensity::from_pressure) wall_densities(boundary);
          if (axisymmetric()) once([&] { mirror_extrapolated(boundary); });
        }
      if (density && renormalised_diffusion()) {
        density_gradients(fluid, neighbours, swept ? &swept->near : nullptr);
        if (axisymmetric()) once([&] { mirror(fluid.grad_rho); });
      }
    }
  }
  if (velocity && viscosity_varies()) {
    const auto timer = timers.measure("shear rate and viscosity");
#pragma omp parallel
    viscosities(fluid, neighbours, boundaries);
  }
  if (polymer) {
    const auto timer = timers.measure("polymer");
#pragma omp parallel
    {
      if (velocity) polymer_stresses(fluid, boundaries);
      if (density) log_conformation_rates(fluid, neighbours, boundaries, own);
    }
  }
  const auto timer = timers.measure("rates");
  medium_.kernel.visit([&](const auto& W) { sweeps().rates(W, wanted, fluid, neighbours, boundaries, own); });
  if (parameters_.consistent_gradients)
    make_gradients_consistent(wanted, viscosity_varies() ? 0.0 : viscosity_at_rest(), fluid, neighbours,
                              medium_.kernel, own);
  if (velocity)
    medium_.kernel.visit([&](const auto& W) {
      add_further_forces(W, parameters_, medium_, fluid, neighbours, boundaries, own);
    });
  if (velocity && friction_) brake_by_friction(fluid, boundaries, ranks);
}

void Dynamics::renew_density_rates(Particles& fluid, const ClusterList& neighbours,
                                   std::vector<Boundary>& boundaries,
                                   const std::vector<std::uint32_t>& clusters) const {
  medium_.kernel.visit(
      [&](const auto& W) { sweeps().rates(W, RatesOf::density, fluid, neighbours, boundaries, &clusters); });
}

void Dynamics::brake_by_friction(Particles& fluid, std::vector<Boundary>& boundaries,
                                 const Ranks* ranks) const {
  const double p_offset = pressure_offset(fluid, boundaries, ranks);
  for (Boundary& boundary : boundaries)
    if (boundary.is_work_piece()) {
      friction_->measure_contact(boundary, fluid);
      friction_->brake_fluid(fluid, p_offset, boundary);
    }
}

double Dynamics::moment_beside_pairs(const Particles& fluid, const std::vector<Boundary>& boundaries,
                                     std::size_t b, const Ranks* ranks) const {
  const Boundary& wall = boundaries[b];
  const auto& viscosity = parameters_.laminar_viscosity;
  if (!viscosity || !viscous_walls()) return 0;
  return viscosity->dynamic_viscosity * wall.angular_velocity *
         wetted_surface_moment(wall, fluid, medium_.kernel, b, ranks);
}

double Dynamics::pressure_offset(const Particles& fluid, const std::vector<Boundary>& boundaries,
                                 const Ranks* ranks) const {
  return fluid::pressure_offset(parameters_.enclosed_medium, fluid, boundaries, state_, ranks);
}

void Dynamics::react(const Particles& fluid, double pressure_offset, Boundary& boundary) const {
  medium_.kernel.visit([&](const auto& W) {
    sweeps().reaction(W, fluid, boundary);
    add_further_reactions(W, parameters_, medium_, fluid, boundary);
  });
  react_by_friction(fluid, pressure_offset, boundary);
}

void Dynamics::react_by_friction(const Particles& fluid, double pressure_offset, Boundary& work_piece) const {
  if (friction_ && work_piece.is_work_piece()) friction_->drag_work_piece(work_piece, fluid, pressure_offset);
}

}  // namespace toryu::fluid
