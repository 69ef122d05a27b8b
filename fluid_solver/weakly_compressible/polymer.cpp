#include "fluid_solver/weakly_compressible/polymer.hpp"

#include <algorithm>

namespace toryu::fluid {

namespace {

Symmetric<double> at(const Symmetric<Field>& field, std::size_t i) {
  return {field.xx[i], field.yy[i], field.xy[i]};
}
void set(Symmetric<Field>& field, std::size_t i, const Symmetric<double>& value) {
  field.xx[i] = value.xx, field.yy[i] = value.yy, field.xy[i] = value.xy;
}

/// Calls visit(mode, conformation, i) for each mode of each particle.
template <class Visit>
void for_each_conformation(const Viscoelasticity& medium, const Particles& fluid, Visit&& visit) {
  for (std::size_t k = 0; k < medium.modes.size(); ++k)
    for (std::size_t i = 0; i < fluid.count; ++i)
      visit(medium.modes[k], Conformation(at(fluid.log_conformation[k], i)), i);
}

}  // namespace

void allocate_polymer(const Viscoelasticity& medium, Particles& fluid) {
  const std::size_t size = padded(std::max<std::size_t>(fluid.count, 1));  // without values: absent
  for (std::size_t k = 0; k < medium.modes.size(); ++k)
    for (auto* field : {&fluid.log_conformation[k], &fluid.log_conformation_rate[k]}) resize(*field, size);
  resize(fluid.polymer_stress, size);
}

void find_polymer_stress(const Viscoelasticity& medium, Particles& fluid, std::size_t cluster) {
  for (std::size_t i = cluster * lane_count; i < (cluster + 1) * lane_count; ++i) {
    Symmetric<double> stress{0, 0, 0};
    for (std::size_t k = 0; k < medium.modes.size(); ++k) {
      const Symmetric<double> A = Conformation(at(fluid.log_conformation[k], i)).value();
      const double G = medium.modes[k].modulus();
      stress.xx += G * (A.xx - 1), stress.yy += G * (A.yy - 1), stress.xy += G * A.xy;
    }
    set(fluid.polymer_stress, i, stress);
  }
}

void find_log_conformation_rate(const Viscoelasticity& medium, const TensorLanes& grad_v, Particles& fluid,
                                std::size_t cluster) {
  for (std::size_t lane = 0; lane < lane_count; ++lane) {
    const std::size_t i = cluster * lane_count + lane;
    const VelocityGradientOfOne gradient{
        {{{grad_v[0][0][lane], grad_v[0][1][lane]}}, {{grad_v[1][0][lane], grad_v[1][1][lane]}}}};
    for (std::size_t k = 0; k < medium.modes.size(); ++k)
      set(fluid.log_conformation_rate[k], i,
          Conformation(at(fluid.log_conformation[k], i)).rate(medium.modes[k], gradient));
  }
}

PolymerExtremes polymer_extremes(const Viscoelasticity& medium, const Particles& fluid) {
  std::vector<double> modulus(fluid.count);  // G A over the direction in which it is largest
  PolymerExtremes largest;
  for_each_conformation(medium, fluid, [&](const PolymerMode& mode, const Conformation& A, std::size_t i) {
    modulus[i] += mode.modulus() * A.largest_eigenvalue();
    largest.elastic_speed = std::max(largest.elastic_speed, std::sqrt(modulus[i] / fluid.rho[i]));
    largest.relaxation_rate = std::max(largest.relaxation_rate, A.relaxation_rate(mode));
  });
  return largest;
}

double polymer_energy(const Viscoelasticity& medium, const Particles& fluid) {
  double sum = 0;
  for_each_conformation(medium, fluid, [&](const PolymerMode& mode, const Conformation& A, std::size_t i) {
    sum += fluid.m[i] / fluid.rho[i] * A.energy(mode);
  });
  return sum;
}

double dissipated_power(const Viscoelasticity& medium, const Particles& fluid, const Ranks* ranks) {
  const auto of_whole = [&](Field values) { return ranks ? ranks->of_whole(values) : std::move(values); };
  std::vector<Field> dissipations(medium.modes.size(), Field(padded(fluid.count)));
  Field V(padded(fluid.count));
  for (std::size_t i = 0; i < fluid.count; ++i) V[i] = fluid.m[i] / fluid.rho[i];
  for_each_conformation(medium, fluid, [&](const PolymerMode& mode, const Conformation& A, std::size_t i) {
    dissipations[static_cast<std::size_t>(&mode - medium.modes.data())][i] = A.dissipation(mode);
  });
  V = of_whole(std::move(V));
  double sum = 0;
  for (Field& of_mode : dissipations) {
    of_mode = of_whole(std::move(of_mode));
    for (std::size_t i = 0; i < V.size(); ++i) sum += V[i] * of_mode[i];
  }
  return sum;
}

}  // namespace toryu::fluid
