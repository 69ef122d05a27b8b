/// What a model does that holds a part of a fluid.

#include <algorithm>

#include "fluid_solver/fluid_model.hpp"

namespace toryu::fluid {

/// How many reaches of ghosts an own particle needs. It sees one reach far: to particles and walls whose
/// gradients and pressures see one more. Shifting sees how its neighbours shift, who keep off a surface one
/// reach from them. A viscosity that varies comes to walls from particles whose shear rates other walls make.
int FluidModel::reaches_of_ghosts() const {
  const Parameters& p = parameters_;
  if (p.power_law || p.herschel_bulkley || p.carreau) return 4;
  return p.seeks_free_surface() ? 3 : 2;
}

void FluidModel::spread_over(Ranks& ranks) {
  ranks_ = &ranks;
  state_.neighbours.keep_ghosts(reaches_of_ghosts());
  for (Boundary& boundary : state_.boundaries) boundary.force_on_fluid.of_part = true;
  ranks.begin(state_.fluid, state_.boundaries);
  state_.neighbours.divide(state_.fluid, state_.boundaries, ranks);
}

FluidModel::Begun FluidModel::begun() const {
  return {state_.largest, start_volume_, state_.potential_of_moves, state_.neighbours.begun()};
}

void FluidModel::spread_over(Ranks& ranks, const Begun& begun, Particles fluid) {
  if (fluid.count > 0) state_.fluid = std::move(fluid);
  state_.largest = begun.largest;
  start_volume_ = begun.start_volume;
  state_.potential_of_moves = begun.potential_of_moves;
  if (begun.lists.builds > 0) state_.neighbours.begin_with(begun.lists, state_.fluid, state_.boundaries);
  spread_over(ranks);
}

/// What the fluid does to the particles of a boundary.
void FluidModel::collect_at(Boundary& boundary) {
  std::vector<Field*> fields;
  const auto add = [&](Field& component) {
    if (!component.empty()) fields.push_back(&component);
  };
  for_each_field(boundary, [&](auto& field) {
    if (field.kind == FieldKind::derived) for_each_component(field, add);
  });
  for (Field* field : {&boundary.m, &boundary.rho}) add(*field);  // which may follow from the pressure
  ranks_->collect_at(static_cast<std::size_t>(&boundary - state_.boundaries.data()), fields);
}

void FluidModel::collect(FluidModel* whole, bool all) {
  for (Boundary& boundary : state_.boundaries) collect_at(boundary);
  if (all) Neighbours::collect(state_.neighbours, *ranks_, whole ? &whole->state_.neighbours : nullptr);
  collect_fluid(whole ? &whole->state_.fluid : nullptr, all);
  if (!whole) return;
  State& to = whole->state_;
  to.time = state_.time;
  for (std::size_t b = 0; b < to.boundaries.size(); ++b)
    to.boundaries[b].take_all_but_lists(state_.boundaries[b]);
  to.gravity_impulse = state_.gravity_impulse;
  to.work_of_gravity_change = state_.work_of_gravity_change;
  to.potential_of_moves = state_.potential_of_moves;
  to.largest = state_.largest;
  to.density_rate_known = state_.density_rate_known;
  to.contact_changed = state_.contact_changed;
  to.impedance_wanted = state_.impedance_wanted;
}

void FluidModel::forget() {
  for_each_field(state_.fluid,
                 [](auto& field) { for_each_component(field, [](Field& component) { component = {}; }); });
  state_.fluid.id = {};
  state_.neighbours.forget(state_.boundaries);
}

void FluidModel::collect_fluid(Particles* whole, bool all) {
  const auto components = [&](Particles& fluid) {
    std::vector<Field*> found;
    const auto add = [&](auto& field) {
      for_each_component(field, [&](Field& component) { found.push_back(&component); });
    };
    const auto reported = [&](auto&... field) { (add(field), ...); };
    if (all)
      for_each_field(fluid, add);
    else
      reported(fluid.x, fluid.v, fluid.rho, fluid.m, fluid.off_surface_and_walls, fluid.gdot, fluid.eta,
               fluid.polymer_stress);
    return found;
  };
  Field number(state_.fluid.id.begin(), state_.fluid.id.end()),
      number_in_whole(padded(ranks_->count_of_whole()));
  std::vector<const Field*> of_part{&number};
  std::vector<Field*> of_whole;
  if (whole) of_whole.push_back(&number_in_whole);
  const auto here = components(state_.fluid), there = whole ? components(*whole) : std::vector<Field*>{};
  for (std::size_t n = 0; n < here.size(); ++n) {
    if (here[n]->empty()) continue;
    of_part.push_back(here[n]);
    if (whole) of_whole.push_back(there[n]), there[n]->resize(number_in_whole.size());
  }
  ranks_->collect(of_part, of_whole);
  if (!whole) return;
  const auto end = static_cast<std::ptrdiff_t>(whole->count);
  whole->id.assign(number_in_whole.begin(), number_in_whole.begin() + end);
  for (Field* field : of_whole) std::fill(field->begin() + end, field->end(), (*field)[whole->count - 1]);
  std::fill(whole->m.begin() + end, whole->m.end(), 0.0);  // idle lanes weigh nothing
}

}  // namespace toryu::fluid
