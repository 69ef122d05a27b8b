/// The stress that the total Lagrangian form shows: of a particle, and as stress_recovery.hpp finds it at a
/// surface and at an observer's point.
#include <algorithm>

#include "solid_solver/total_lagrangian/total_lagrangian.hpp"

namespace toryu::solid {

Stress TotalLagrangian::stress(std::size_t particle) const {
  const std::size_t k = slot_[particle];
  return stress_of(k, composition_.own_gradient(k, gradient(k)));
}

Stress TotalLagrangian::recovered_stress(std::size_t particle) const {
  const std::size_t index = surface_index_[particle];
  return index < of_surface_.size() ? recovered(of_surface_[index]) : stress(particle);
}

Stress TotalLagrangian::stress_at(std::size_t observer) const {
  const RecoveredPoint& point = of_observers_[observer];
  return point.fit.found() ? recovered(point) : SolidModel::stress_at(observer);
}

Stress TotalLagrangian::stress_of(std::size_t slot, const Tensor<double>& H) const {
  const Tensor<double> F_T{1.0 + H[0], H[2], H[1], 1.0 + H[3]};
  const double J = 1.0 + volume_change(H);
  return std::visit(
      [&](const auto& law) -> Stress {
        const Tensor<double> sigma = product(law.stress(H), F_T);
        return {sigma[0] / J, sigma[3] / J, law.stress_across(H) / J, sigma[1] / J};
      },
      composition_.law(slot));
}

void TotalLagrangian::find_recovered_points() {
  const BodyIndex index(body_);
  const auto know_pressure = [&](RecoveredPoint& point) {
    for (const auto& load : parameters_.loads)
      if (point.surface && load.pressure != 0 && load.box.contains(point.surface->place))
        point.surface->pressure += load.pressure;
  };
  for (const auto& observer : parameters_.observers)
    know_pressure(of_observers_.emplace_back(index, observer.point));
  surface_index_.assign(particle_count(), particle_count());
  for (std::size_t i = 0; i < particle_count(); ++i) {
    if (body_.held[i] || body_.area_vector[i].isZero()) continue;
    RecoveredPoint point(index, body_.X[i]);
    if (!point.fit.found() || !point.surface) continue;
    know_pressure(point);
    surface_index_[i] = of_surface_.size();
    of_surface_.push_back(std::move(point));
  }
}

bool TotalLagrangian::is_free(const FreeSurface& surface) const {
  if (bodies_) return false;
  return std::all_of(surface.faces.begin(), surface.faces.end(), [&](std::uint32_t i) {
    const bool pushed = walls_ && !at(state_.push, slot_[i]).isZero();
    return !pushed && !drive_.is_forced(i) && at(state_.external, slot_[i]) == steady_acceleration(i);
  });
}

Stress TotalLagrangian::recovered(const RecoveredPoint& point) const {
  const auto u = [&](std::uint32_t i) { return displacement(i); };
  Tensor<double> H = point.fit.gradient(u);
  const std::size_t slot = slot_[point.fit.nearest()];
  if (point.surface && is_free(*point.surface)) {
    const Vec& normal = point.surface->normal;
    std::visit(
        [&](const auto& law) {
          const auto P = [&](const Tensor<double>& gradient) { return law.stress(gradient); };
          const double share = point.surface->share;
          Vec t = share * traction(P(point.surface->deeper.gradient(u)), normal);
          if (point.surface->pressure != 0) t -= (1 - share) * point.surface->pressure * normal;
          H = with_traction(P, H, normal, t);
        },
        composition_.law(slot));
  }
  return stress_of(slot, H);
}

}  // namespace toryu::solid
