#include "fluid_solver/weakly_compressible/found_values.hpp"

namespace toryu::fluid {

namespace {

/// Calls visit(component) for each field of the particles that an evaluation finds.
template <class Visit>
void for_each_found(Particles& f, Visit&& visit) {
  const auto walk = [&](auto&... field) { (for_each_component(field, visit), ...); };
  walk(f.V, f.p, f.p_rho2, f.grad_rho, f.gdot, f.eta, f.eta_grad_v, f.log_conformation_rate, f.polymer_stress,
       f.a, f.drho);
}
template <class Visit>
void for_each_found(Boundary& b, Visit&& visit) {
  const auto walk = [&](auto&... field) { (for_each_component(field, visit), ...); };
  walk(b.m, b.rho, b.p, b.p_rho2, b.v_viscous, b.eta, b.eta_grad_v, b.slip_velocity, b.shear_stress,
       b.polymer_stress, b.friction_length);
}

/// Calls visit(w) for each place of a field of `size` values that is near the fluid, or an image of one.
template <class Visit>
void for_each_reached(const Boundary& boundary, std::size_t size, Visit&& visit) {
  for (const auto c : boundary.list_for_wall.active())
    for (std::size_t w = c * lane_count; w < (c + 1) * lane_count; ++w) visit(w);
  for (std::size_t w = padded(boundary.count); w < size; ++w) visit(w);
}

}  // namespace

FoundValues::FoundValues(Particles& fluid, std::vector<Boundary>& boundaries)
    : fluid_(fluid), boundaries_(boundaries) {
  for_each_found(fluid, [&](const Field& component) { of_fluid_.push_back(component); });
  for (Boundary& boundary : boundaries) {
    const ForceOnFluid& force = boundary.force_on_fluid;
    OfBoundary& kept = of_boundaries_.emplace_back(
        OfBoundary{.force_by_cluster = force.by_cluster, .friction_by_cluster = force.friction_by_cluster});
    for_each_found(boundary, [&](const Field& component) {
      auto& values = kept.values.emplace_back();
      if (component.empty()) return;
      values.emplace();
      for_each_reached(boundary, component.size(), [&](std::size_t w) { values->push_back(component[w]); });
    });
  }
}

void FoundValues::bring_back() {
  auto of_fluid = of_fluid_.begin();
  for_each_found(fluid_, [&](Field& component) { component.swap(*of_fluid++); });
  for (std::size_t b = 0; b < boundaries_.size(); ++b) {
    Boundary& boundary = boundaries_[b];
    boundary.force_on_fluid.by_cluster.swap(of_boundaries_[b].force_by_cluster);
    boundary.force_on_fluid.friction_by_cluster.swap(of_boundaries_[b].friction_by_cluster);
    auto of_field = of_boundaries_[b].values.begin();
    for_each_found(boundary, [&](Field& component) {
      const std::optional<Field>& values = *of_field++;
      if (!values) return void(component = {});
      auto value = values->begin();
      for_each_reached(boundary, component.size(), [&](std::size_t w) { component[w] = *value++; });
    });
  }
}

}  // namespace toryu::fluid
