/// What the solid shows of itself: energies and observers for the series, frames, active terms.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "solid_solver/solid_model.hpp"

namespace toryu::solid {

static_assert(dim == 2, "columns and frames have the components of the plane");

std::vector<std::pair<std::string, double>> SolidModel::figures() const {
  if (!bonds_) return {};
  const Stretches& worst = state_.bonds.worst;
  return {{"torn_bonds", static_cast<double>(worst.torn)},
          {"clumped_bonds", static_cast<double>(worst.clumped)},
          {"largest_energy_gain", state_.energy.largest_gain},
          {"largest_bond_strain", worst.strain()},
          {"largest_bond_turn", worst.turn},
          {"largest_rearrangement", worst.rearranged}};
}

void SolidModel::observe_regions(std::vector<Observation>& row) const {
  for (std::size_t r = 0; r < parameters_.regions.size(); ++r) {
    if (!parameters_.regions[r].observed) continue;
    double m = 0;
    Vec moved = Vec::Zero(), momentum = Vec::Zero();
    for (std::size_t i = 0; i < particle_count(); ++i) {
      if (body_.region[i] != r) continue;
      m += mass(i);
      moved += mass(i) * displacement(i);
      momentum += mass(i) * velocity(i);
    }
    const std::string& name = parameters_.regions[r].name;
    row.push_back({name + "_displacement_x", "m", moved[0] / m});
    row.push_back({name + "_displacement_y", "m", moved[1] / m});
    row.push_back({name + "_velocity_x", "m/s", momentum[0] / m});
    row.push_back({name + "_velocity_y", "m/s", momentum[1] / m});
  }
}

void SolidModel::observe_bonds(std::vector<Observation>& row) const {
  const Stretches stretches = bonds_->stretches(positions());
  row.push_back({"largest_stretch", "1", stretches.largest});
  if (detachment_) row.push_back({"largest_strain", "1", stretches.strain()});
  if (!parameters_.bonds) return;
  row.push_back({"smallest_stretch", "1", stretches.smallest});
  row.push_back({"torn_bonds", "1", static_cast<double>(stretches.torn)});
  row.push_back({"clumped_bonds", "1", static_cast<double>(stretches.clumped)});
}

void SolidModel::observe_detachment(std::vector<Observation>& row) const {
  double count = 0, sum = 0, largest = 0;
  for (std::size_t i = 0; i < particle_count(); ++i) {
    largest = std::max(largest, recovered_stress(i).von_mises());
    if (!state_.detachment.detached[i]) continue;
    count += 1;
    sum += mass(i);
  }
  row.push_back({"detached_particles", "1", count});
  row.push_back({"detached_mass", "kg/m", sum});
  row.push_back({"largest_von_mises_stress", "Pa", largest});
}

Health SolidModel::health() const {
  double stored = potential_energy();
  for (const auto& energy : internal_energies()) stored += energy.value;
  return {.kinetic_energy = kinetic_energy(), .potential_energy = stored, .momentum = momentum()};
}

Stress SolidModel::stress_at(std::size_t observer) const {
  const MaterialPoint& point = observers_[observer].second;
  const auto mean = [&](double Stress::*part) {
    return point.value([&](std::size_t i) { return stress(i).*part; });
  };
  return {mean(&Stress::xx), mean(&Stress::yy), mean(&Stress::zz), mean(&Stress::xy)};
}

std::vector<Observation> SolidModel::observe() const {
  std::vector<Observation> row = places();
  for (Observation& observation : balance()) row.push_back(std::move(observation));
  return row;
}

std::vector<Observation> SolidModel::places() const {
  std::vector<Observation> row;
  for (std::size_t n = 0; n < observers_.size(); ++n) {
    const auto& asked = observers_[n].first;
    const auto& point = observers_[n].second;
    const Vec u = point.value([&](std::size_t i) { return displacement(i); });
    row.push_back({asked.name + "_displacement_x", "m", u[0]});
    row.push_back({asked.name + "_displacement_y", "m", u[1]});
    if (!asked.stress) continue;
    const Stress sigma = stress_at(n);
    row.push_back({asked.name + "_stress_xx", "Pa", sigma.xx});
    row.push_back({asked.name + "_stress_yy", "Pa", sigma.yy});
    row.push_back({asked.name + "_stress_xy", "Pa", sigma.xy});
  }
  observe_regions(row);
  return row;
}

std::vector<Observation> SolidModel::balance() const {
  std::vector<Observation> row;
  const double kinetic = kinetic_energy(), potential = potential_energy(), work = interface_work();
  row.push_back({"kinetic_energy", "J/m", kinetic});
  double held = 0;
  for (const auto& energy : internal_energies()) {
    held += energy.value;
    row.push_back(energy);
  }
  if (walls_ || bodies_) {
    row.push_back({"contact_energy", "J/m", contact_energy()});
    held += row.back().value;
  }
  row.push_back({"potential_energy", "J/m", potential});
  row.push_back({"interface_work", "J/m", work});
  double driven = 0;
  if (!drive_.clamps().empty()) {
    row.push_back({"work_of_clamps", "J/m", state_.work_of_clamps});
    driven += state_.work_of_clamps;
  }
  if (drive_.changes()) {
    row.push_back({"work_of_changes", "J/m", state_.work_of_changes});
    driven += state_.work_of_changes;
  }
  row.push_back({"dissipated_energy", "J/m", first_energy_ + work + driven - kinetic - held - potential});
  const Vec p = momentum();
  row.push_back({"momentum_x", "N.s/m", p[0]});
  row.push_back({"momentum_y", "N.s/m", p[1]});
  const auto append = [&](const std::string& name, const Vec& impulse) {
    row.push_back({"impulse_from_" + name + "_x", "N.s/m", impulse[0]});
    row.push_back({"impulse_from_" + name + "_y", "N.s/m", impulse[1]});
  };
  append("load", state_.impulses.loads);
  append("clamps", state_.impulses.clamps);
  if (walls_) append("walls", state_.impulses.walls);
  if (detachment_) observe_detachment(row);
  if (detachment_ || parameters_.bonds) observe_bonds(row);
  return row;
}

void SolidModel::append_stress(std::vector<FrameField>& fields) const {
  FrameField stress_field{"stress", "Pa", "Cauchy stress in the plane", dim * dim, {}};
  FrameField von_mises_field{"von_mises_stress", "Pa", "sqrt(3/2 s:s), s the deviatoric stress", 1, {}};
  FrameField pressure_field{"pressure", "Pa", "minus a third of the trace of the stress", 1, {}};
  for (std::size_t i = 0; i < particle_count(); ++i) {
    const Stress sigma = recovered_stress(i);
    stress_field.values.insert(stress_field.values.end(), {sigma.xx, sigma.xy, sigma.xy, sigma.yy});
    von_mises_field.values.push_back(sigma.von_mises());
    pressure_field.values.push_back(sigma.pressure());
  }
  for (auto* field : {&stress_field, &von_mises_field, &pressure_field}) fields.push_back(std::move(*field));
}

Frame SolidModel::frame() const {
  Frame frame;
  FrameField displacement_field{"displacement", "m", "from the unloaded position", dim, {}};
  FrameField velocity_field{"velocity", "m/s", "of the particle", dim, {}};
  FrameField held_field{"held", "1", "1 where a clamp holds the particle", 1, {}};
  const auto append = [](std::vector<double>& values, const Vec& value) {
    values.insert(values.end(), value.begin(), value.end());
  };
  for (std::size_t i = 0; i < particle_count(); ++i) {
    append(frame.positions, period_.inside(body_.X[i] + displacement(i)));
    append(displacement_field.values, displacement(i));
    append(velocity_field.values, velocity(i));
    held_field.values.push_back(body_.held[i]);
  }
  frame.fields = {std::move(velocity_field), std::move(displacement_field)};
  if (has_stress()) append_stress(frame.fields);
  frame.fields.push_back(std::move(held_field));
  if (!parameters_.materials.empty())
    frame.fields.push_back({"material",
                            "1",
                            "0: that of [solid]; else the place in the list of [[solid.material]], from 1",
                            1,
                            {body_.material.begin(), body_.material.end()}});
  if (detachment_) {
    const auto& detached = state_.detachment.detached;
    frame.fields.push_back({"detached",
                            "1",
                            "1 where no chain of neighbours joins the particle to a clamp",
                            1,
                            {detached.begin(), detached.end()}});
  }
  return frame;
}

std::vector<ActiveTerm> SolidModel::active_terms() const {
  std::vector<ActiveTerm> terms;
  if (!gravity_.isZero())
    terms.push_back(
        {"gravity", "Dv/Dt = g", "", fmt::format("g = ({:g}, {:g}) m/s2", gravity_[0], gravity_[1])});
  if (!parameters_.loads.empty())
    terms.push_back({"loads", "f_i = F/N on the N particles of a box, or -p A_i on their surface", "",
                     fmt::format("{} boxes", parameters_.loads.size())});
  if (parameters_.artificial_viscosity)
    terms.push_back({"artificial viscosity",
                     "Pi_ij = (-A c theta_ij + B theta_ij^2)/rho_0 where particles approach",
                     "Monaghan 1992; thesis eq. 23-24",
                     fmt::format("A {:g}, B {:g}, {}", parameters_.artificial_viscosity->alpha,
                                 parameters_.artificial_viscosity->beta,
                                 parameters_.materials.empty()
                                     ? fmt::format("c {:.4g} m/s", parameters_.material.bulk_sound_speed())
                                     : "c of each material, means between two")});
  if (walls_)
    terms.push_back(
        {"wall contact", "p_i = stiffness K max(0, S_i/S_0 - 1), Dv_i/Dt = -p_i/rho_0 grad S_i",
         "in the manner of Adami, Hu & Adams 2012",
         fmt::format("stiffness {:g}, S_0 {:.4g}, {} wall particles", parameters_.wall_contact->stiffness,
                     walls_->touching_sum(), walls_->particle_count())});
  if (bodies_)
    terms.push_back(
        {"body contact",
         "p_i = stiffness K max(0, S_i/S_0 - 1), Dv_i/Dt = -1/rho_0 sum_j V_j (p_i + p_j) gradW_ij",
         "in the manner of Adami, Hu & Adams 2012",
         fmt::format(
             "stiffness {:g}, S_0 {:.4g}, {}", parameters_.body_contact->stiffness, bodies_->touching_sum(),
             bodies_->body_count() == 1 ? "1 body" : fmt::format("{} bodies", bodies_->body_count()))});
  if (parameters_.damping)
    terms.push_back({"damping", "dv/dt = -rate v", "dynamic relaxation: Otter 1965",
                     fmt::format("rate {:g} 1/s", parameters_.damping->rate)});
  return terms;
}

}  // namespace toryu::solid
