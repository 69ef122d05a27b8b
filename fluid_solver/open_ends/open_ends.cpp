#include "fluid_solver/open_ends/open_ends.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace toryu::fluid {

namespace {

/// The number that a particle in the layer of an end carries; 0 in the fluid.
double mark_of(std::size_t end) {
  return static_cast<double>(end + 1);
}

/// Share of a particle at the distance `r` in means that reach to `reach`.
double weight(double r, double reach) {
  const double q = std::max(0.0, 1 - std::abs(r) / reach);
  return q * q;
}

/// Rows of particles that a mean across a row takes in on either side.
constexpr double rows_in_mean = 2;
/// K L/c: velocity and pressure are held the sooner, and the more sound comes back, the larger it is.
constexpr double relaxation_by_transit = 0.25;

/// Squares of distances that spread by less, over the spacing's, tell no slope.
constexpr double least_spread = 0.01;

/// Linear in between, constant beyond.
double wave_at(const std::vector<PassingWave>& passing, double time) {
  const auto later = std::partition_point(passing.begin(), passing.end(),
                                          [&](const PassingWave& seen) { return seen.time <= time; });
  if (later == passing.begin()) return passing.front().wave;
  const PassingWave& before = *(later - 1);
  if (later == passing.end()) return before.wave;
  return before.wave + (later->wave - before.wave) * (time - before.time) / (later->time - before.time);
}

/// Along s, of all of the fluid [m].
double length_of_fluid(const Parameters& p, const Section& section) {
  double nearest = 0, farthest = 0;
  for (const Region& region : p.regions)
    for (const Vec& corner : {region.box.min, region.box.max}) {
      nearest = std::min(nearest, section.distance(corner));
      farthest = std::max(farthest, section.distance(corner));
    }
  return farthest - nearest;
}

}  // namespace

OpenEnds::OpenEnds(const Parameters& p, const EquationOfState& equation_of_state)
    : sections_(sections_of(p)),
      inlets_(p.inlets),
      outlets_(p.outlets),
      equation_of_state_(equation_of_state),
      support_(2 * p.h()),
      skin_(p.neighbour_skin * 2 * p.h()),
      spacing_(p.spacing),
      state_(sections_.size()),
      layer_(sections_.size()),
      near_(sections_.size()),
      velocities_(sections_.size()) {
  for (const Inlet& inlet : inlets_) names_.push_back(inlet.name);
  for (const Outlet& outlet : outlets_) names_.push_back(outlet.name);
  for (std::size_t end = 0; end < size(); ++end) {
    transits_.push_back(length_of_fluid(p, sections_[end]) / p.sound_speed);
    velocities_[end].resize(
        static_cast<std::size_t>(std::max(1.0, std::round(sections_[end].length / spacing_))));
  }
}

void OpenEnds::assign_layers(Particles& fluid) {
  next_id_ = static_cast<std::uint32_t>(fluid.count);
  fluid.open_end.assign(fluid.x[0].size(), 0.0);
  cell_.assign(size(), 0.0);
  std::vector<double> count(size());
  for (std::size_t i = 0; i < fluid.count; ++i)
    for (std::size_t end = 0; end < size(); ++end) {
      const Vec x = at(fluid.x, i);
      const double s = sections_[end].distance(x);
      if (!sections_[end].spans(x) || s >= 0 || s < -sections_[end].depth) continue;
      fluid.open_end[i] = mark_of(end);
      ++count[end];
    }
  for (std::size_t end = 0; end < size(); ++end)
    cell_[end] = sections_[end].length * sections_[end].depth / std::max(1.0, count[end]);
  find(fluid);
}

void OpenEnds::find(const Particles& fluid) {
  for (std::size_t end = 0; end < size(); ++end) {
    const Section& section = sections_[end];
    layer_[end].clear();
    near_[end].clear();
    for (std::uint32_t i = 0; i < fluid.count; ++i)
      if (fluid.open_end[i] == mark_of(end)) {
        layer_[end].push_back(i);
      } else if (fluid.open_end[i] == 0) {
        const Vec x = at(fluid.x, i);
        // beyond the support by what they may move until the lists are built again: those that have not add 0
        if (std::abs(section.distance(x)) < support_ + skin_ && section.spans(x)) near_[end].push_back(i);
      }
    state_[end].layer_mass = 0;
    for (const std::uint32_t i : layer_[end]) state_[end].layer_mass += fluid.m[i];
  }
}

void OpenEnds::find_crossings(const Particles& fluid) {
  crossings_.clear();
  kept_.clear();
  for (std::uint32_t i = 0; i < fluid.count; ++i) {
    const Vec x = at(fluid.x, i);
    bool stays = true;
    for (std::size_t end = 0; end < size(); ++end) {
      const Section& section = sections_[end];
      const double s = section.distance(x);
      if (fluid.open_end[i] == mark_of(end)) {
        if (s >= 0) crossings_.push_back({i, end, 1});
        stays = s >= -section.depth;
      } else if (fluid.open_end[i] == 0 && s < 0 && s >= -section.depth && section.spans(x)) {
        crossings_.push_back({i, end, -1});
      }
    }
    if (stays) kept_.push_back(i);
  }
}

/// Behind the last of each row of a layer that runs inward, a spacing apart, up to the end of the layer.
void OpenEnds::find_new(const Particles& fluid) {
  new_.clear();
  for (std::size_t end = 0; end < size(); ++end) {
    const Section& section = sections_[end];
    const auto rows = static_cast<double>(velocities_[end].size());
    last_.assign(velocities_[end].size(), {});
    for (std::uint32_t k = 0; k < kept_.size(); ++k) {
      if (fluid.open_end[kept_[k]] != mark_of(end)) continue;
      const Vec x = at(fluid.x, kept_[k]);
      const double row = std::floor(section.place(x) / section.length * rows);
      Last& last = last_[static_cast<std::size_t>(std::clamp(row, 0.0, rows - 1))];
      const double s = section.distance(x);
      if (!last.there || s < last.distance) last = {true, k, s};
    }
    for (std::size_t row = 0; row < last_.size(); ++row) {
      const auto& [there, k, distance] = last_[row];
      if (!there || !(section.inward.dot(at(fluid.v, kept_[k])) > 0)) continue;
      const double place = (static_cast<double>(row) + 0.5) / rows * section.length;
      for (double s = distance - spacing_; s >= -section.depth; s -= spacing_)
        new_.push_back({k, end, section.point(place, s)});
    }
  }
}

void OpenEnds::rearrange(Particles& fluid) {
  for (const Crossing& crossing : crossings_)
    fluid.open_end[crossing.particle] = crossing.sign > 0 ? 0 : mark_of(crossing.end);
  find_new(fluid);
  const std::size_t kept = kept_.size(), count = kept + new_.size();
  if (new_.empty() && kept == fluid.count) return;
  resize_present_fields(fluid, padded(std::max(fluid.count, count)));
  fluid.id.resize(std::max(fluid.count, count));
  const auto move = [&](auto& values) {  // in place: who is kept moves to the front, if at all
    for (std::size_t k = 0; k < kept; ++k) values[k] = values[kept_[k]];
    for (std::size_t n = 0; n < new_.size(); ++n) values[kept + n] = values[new_[n].like];
  };
  for_each_field(fluid, [&](auto& field) {
    for_each_component(field, [&](Field& component) {
      if (!component.empty()) move(component);
    });
  });
  move(fluid.id);
  fluid.count = count;
  fluid.id.resize(count);
  resize_present_fields(fluid, padded(count));
  for (std::size_t n = 0; n < new_.size(); ++n) {
    const double cell = cell_[new_[n].end];
    set(fluid.x, kept + n, new_[n].place);
    fluid.V[kept + n] = cell;
    fluid.m[kept + n] = fluid.rho[kept + n] * cell;
    fluid.id[kept + n] = next_id_++;
  }
}

/// Of the fluid before each row of the line: lines across the row, and what they miss in the mean. Who is how
/// near to the line changes from row to row, so that a mean of all would swing with it.
void OpenEnds::find_velocities(const Particles& fluid, std::size_t end) {
  const Section& section = sections_[end];
  std::vector<double>& rows = velocities_[end];
  const double height = section.length / static_cast<double>(rows.size()), reach = rows_in_mean * height;
  sums_.assign(rows.size(), {});
  for (const std::uint32_t i : near_[end]) {
    const Vec x = at(fluid.x, i);
    const double y = section.place(x), u = section.inward.dot(at(fluid.v, i));
    const double w = fluid.m[i] / fluid.rho[i] * weight(section.distance(x), support_);
    const auto first = static_cast<std::size_t>(std::max(0.0, std::ceil((y - reach) / height - 0.5)));
    for (std::size_t row = first; row < rows.size(); ++row) {
      const double from_row = y - (static_cast<double>(row) + 0.5) * height;
      if (from_row <= -reach) break;
      sums_[row].add(w * weight(from_row, reach), from_row, u);
    }
  }
  for (std::size_t row = 0; row < rows.size(); ++row)
    rows[row] = sums_[row].at(0, least_spread * height * height);
  LineSums missed;
  for (const std::uint32_t i : near_[end]) {
    const Vec x = at(fluid.x, i);
    const double w = fluid.m[i] / fluid.rho[i] * weight(section.distance(x), support_);
    missed.add(w, 0, section.inward.dot(at(fluid.v, i)) - velocity_before(end, section.place(x)));
  }
  for (double& row : rows) row += missed.mean();
}

SectionMeans OpenEnds::means(const Particles& fluid, std::size_t end) const {
  const Section& section = sections_[end];
  LineSums pressure;
  for (const std::uint32_t i : near_[end]) {
    const Vec x = at(fluid.x, i);
    const double s = section.distance(x);
    const double p =
        equation_of_state_.pressure(fluid.rho[i]) - equation_of_state_.p_b - weight_across(end, x);
    pressure.add(fluid.m[i] / fluid.rho[i] * weight(s, support_), s, p);
  }
  const double gradient = pressure.slope(least_spread * spacing_ * spacing_);
  const double held = state_[end].begun ? state_[end].gradient : gradient;
  const std::vector<double>& rows = velocities_[end];
  return {pressure.mean() - held * pressure.mean_x(), gradient, pressure.mean_x(),
          std::accumulate(rows.begin(), rows.end(), 0.0) / static_cast<double>(rows.size())};
}

double OpenEnds::weight_across(std::size_t end, const Vec& x) const {
  const Section& section = sections_[end];
  return equation_of_state_.rho_0 * gravity_.dot(section.along) * (section.place(x) - 0.5 * section.length);
}

double OpenEnds::velocity_before(std::size_t end, double place) const {
  const std::vector<double>& rows = velocities_[end];
  const auto last = static_cast<double>(rows.size() - 1);
  const double row =
      std::clamp(place / sections_[end].length * static_cast<double>(rows.size()) - 0.5, 0.0, last);
  const auto below = static_cast<std::size_t>(row);
  const double share = row - static_cast<double>(below);
  return (1 - share) * rows[below] + share * rows[std::min(below + 1, rows.size() - 1)];
}

double OpenEnds::given_mean(std::size_t end, double time) const {
  double discharge = 0, width = 0;
  for (std::size_t other = 0; other < size(); ++other)
    if (is_inlet(other))
      discharge += inlets_[other].mean_at(time) * sections_[other].length;
    else
      width += sections_[other].length;
  return is_inlet(end) ? inlets_[end].mean_at(time) : -discharge / width;
}

double OpenEnds::expected_pressure(std::size_t end, double time) const {
  if (!is_inlet(end)) return outlets_[end - inlets_.size()].pressure_at(time);
  const Inlet& inlet = inlets_[end];
  return equation_of_state_.rho_0 * equation_of_state_.c_0 *
         (inlet.mean_at(time) - inlet.mean_at(time - transits_[end]));
}

void OpenEnds::note_passing(std::size_t end, double time, double wave) {
  std::vector<PassingWave>& passing = state_[end].passing;
  if (!passing.empty() && passing.back().time >= time) passing.pop_back();
  passing.push_back({time, wave});
  const double oldest = time - 2 * sections_[end].depth / equation_of_state_.c_0;
  const auto past = [&](const PassingWave& seen) { return seen.time < oldest; };
  const auto first = std::find_if_not(passing.begin(), passing.end() - 1, past);
  if (first != passing.begin()) passing.erase(passing.begin(), first - 1);
}

void OpenEnds::impose(Particles& fluid, double time, const Vec& gravity) {
  gravity_ = gravity;
  const double rho_c = equation_of_state_.rho_0 * equation_of_state_.c_0;
  for (std::size_t end = 0; end < size(); ++end) {
    const Section& section = sections_[end];
    State& state = state_[end];
    const bool inlet = is_inlet(end);
    find_velocities(fluid, end);
    state.means = means(fluid, end);
    const double P = expected_pressure(end, time);
    const double U = given_mean(end, time);
    state.wave = 0.5 * ((state.means.pressure - P) / rho_c - (state.means.velocity - U));
    if (!state.begun) {
      state.begun = true;
      state.slow_wave = state.wave;
      state.gradient = state.means.gradient;
    }
    const double fast = state.wave - state.slow_wave;
    note_passing(end, time, fast);
    const double p_0 = inlet ? state.means.pressure - rho_c * fast : P;
    for (const std::uint32_t i : layer_[end]) {
      const Vec x = at(fluid.x, i);
      const double y = section.place(x), s = section.distance(x);
      const double there = wave_at(state.passing, time - (state.means.place - s) / equation_of_state_.c_0);
      const double u =
          inlet ? inlets_[end].speed_at(y, time) - there : velocity_before(end, y) + fast - there;
      set(fluid.v, i, u * section.inward);
      fluid.rho[i] = equation_of_state_.density(equation_of_state_.p_b + p_0 + rho_c * there +
                                                state.gradient * s + weight_across(end, x));
    }
  }
}

void OpenEnds::take_rates(Particles& fluid, bool velocity, bool density) {
  for (std::size_t end = 0; end < size(); ++end) {
    State& state = state_[end];
    if (velocity) state.force.setZero(), state.power = 0;
    if (density) state.pressure_power = 0;
    for (const std::uint32_t i : layer_[end]) {
      if (velocity) {
        const Vec force = fluid.m[i] * (at(fluid.a, i) - gravity_);
        state.force += force;
        state.power += force.dot(at(fluid.v, i));
        set(fluid.a, i, Vec::Zero());
      }
      if (density) {
        state.pressure_power += fluid.m[i] * equation_of_state_.pressure(fluid.rho[i]) /
                                (fluid.rho[i] * fluid.rho[i]) * fluid.drho[i];
        fluid.drho[i] = 0;
      }
    }
  }
}

void OpenEnds::exclude_from_corrections(Particles& fluid) const {
  for (const auto& layer : layer_)
    for (const std::uint32_t i : layer) fluid.off_surface[i] = 0;
}

void OpenEnds::count(double dt) {
  for (std::size_t end = 0; end < size(); ++end) {
    State& state = state_[end];
    state.impulse -= dt * state.force;
    state.work -= dt * (state.power + state.pressure_power);
    const double share = 1 - std::exp(-relaxation_by_transit * dt / transits_[end]);
    state.slow_wave += share * (state.wave - state.slow_wave);
    state.gradient += share * (state.means.gradient - state.gradient);
  }
}

double OpenEnds::layer_mass() const {
  double sum = 0;
  for (const State& state : state_) sum += state.layer_mass;
  return sum;
}

std::vector<Observation> OpenEnds::observe(std::size_t end) const {
  const State& now = state_[end];
  const double sign = is_inlet(end) ? 1 : -1;  // along the flow
  const std::string& name = names_[end];
  return {{"mass_through_" + name, "kg/m", sign * now.mass},
          {"flow_rate_through_" + name, "m2/s", sign * now.means.velocity * sections_[end].length},
          {"pressure_at_" + name, "Pa", now.means.pressure},
          {"impulse_from_" + name + "_x", "N.s/m", now.impulse[0]},
          {"impulse_from_" + name + "_y", "N.s/m", now.impulse[1]},
          {"work_from_" + name, "J/m", now.work}};
}

std::optional<Vec> OpenEnds::first_in_layer(const std::vector<Vec>& points) const {
  for (const Vec& x : points)
    for (const Section& section : sections_)
      if (section.layer().contains(x)) return x;
  return {};
}

}  // namespace toryu::fluid
