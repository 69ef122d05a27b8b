#include "common/exchange/exchange_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>

#include "common/error/counted.hpp"

namespace toryu {

namespace {

constexpr const char* file_name = "exchange.h5";
/// Windows that a replay goes back and forth between.
constexpr std::size_t most_kept = 4;

/// Of the time: by how much a window may begin beside the end of the one before.
constexpr double rounding = 1e-9;

/// Which of the vectors that may be absent are there, in this order: friction force, impedance, impulse.
using Presence = std::array<double, 3>;

struct SeriesField {
  const char *name, *unit;
  HdfSeriesFile::Shape shape;  ///< of a row
};

/// What is kept of each window, of an interface of `count` particles.
std::vector<SeriesField> series_of(hsize_t count) {
  return {{"window_start", "s", {}},
          {"window_length", "s", {}},
          {"presence", "1", {Presence{}.size()}},
          {"pressure", "Pa", {count}},
          {"force", "N/m", {count, dim}},
          {"friction_force", "N/m", {count, dim}},
          {"impedance", "kg/(s.m)", {count, dim}},
          {"impulse_on_fluid", "N.s/m", {dim}},
          {"work_of_impulse_on_fluid", "J/m", {}},
          {"time_step_limit", "s", {}},
          {"fluid_energies", "J/m", {2}},
          {"fluid_momentum", "N.s/m", {dim}},
          {"position", "m", {count, dim}},
          {"velocity", "m/s", {count, dim}},
          {"impulse", "N.s/m", {count, dim}},
          {"work_of_impulse_on_solid", "J/m", {}},
          {"impulse_taken", "N.s/m", {dim}},
          {"solid_energies", "J/m", {2}},
          {"solid_momentum", "N.s/m", {dim}}};
}

}  // namespace

ExchangeWriter::ExchangeWriter(const std::filesystem::path& out, const CouplingStart& start)
    : none_(start.motion.position.size(), 0.0), file_(out / file_name) {
  const Interface& interface = start.interface;
  const hsize_t count = interface.size();
  const auto number = [&](const char* name, const char* unit, double value) {
    file_.constant(name, unit, {1}, std::span<const double>(&value, 1));
  };
  number("fluid_reach", "m", start.traits.reach);
  number("fluid_time_step_limit", "s", start.traits.time_step_limit);
  number("fluid_density", "kg/m3", start.traits.density);
  number("fluid_sound_speed", "m/s", start.traits.sound_speed);
  number("fluid_spacing", "m", start.traits.spacing);
  number("interface_spacing", "m", interface.spacing);
  file_.constant("id", "1", {count}, std::span(interface.id));
  file_.constant("reference_position", "m", {count, dim}, interface.position);
  file_.constant("volume", "m2", {count}, interface.volume);
  file_.constant("area_vector", "m", {count, dim}, interface.area_vector);
  file_.constant("mass", "kg/m", {count}, interface.mass);
  file_.constant("start_position", "m", {count, dim}, start.motion.position);
  file_.constant("start_velocity", "m/s", {count, dim}, start.motion.velocity);
  for (const auto& [name, unit, shape] : series_of(count)) file_.series(name, unit, shape);
}

void ExchangeWriter::write(const Window& window, const FluidAnswer& fluid, const SolidAnswer& solid) {
  const InterfaceLoad& load = fluid.load;
  const InterfaceMotion& motion = solid.motion;
  const auto row = [&](const std::vector<double>& values) {
    return values.empty() ? none_.data() : values.data();
  };
  const auto is_there = [](const std::vector<double>& values) { return values.empty() ? 0.0 : 1.0; };
  const Presence presence{is_there(load.friction_force), is_there(load.impedance), is_there(motion.impulse)};
  const std::array fluid_energies{fluid.health.kinetic_energy, fluid.health.potential_energy},
      solid_energies{solid.health.kinetic_energy, solid.health.potential_energy};
  file_.append({&window.time, &window.dt, presence.data(), load.pressure.data(), load.force.data(),
                row(load.friction_force), row(load.impedance), load.impulse_on_fluid.data(),
                &load.work_of_impulse, &fluid.time_step_limit, fluid_energies.data(),
                fluid.health.momentum.data(), motion.position.data(), motion.velocity.data(),
                row(motion.impulse), &motion.work_of_impulse, solid.impulse_taken.data(),
                solid_energies.data(), solid.health.momentum.data()});
}

ExchangeReader::ExchangeReader(const std::filesystem::path& out) : path_(out / file_name), file_(path_) {
  const auto number = [&](const char* name) { return file_.row(name, 0)[0]; };
  start_.traits = {.reach = number("fluid_reach"),
                   .time_step_limit = number("fluid_time_step_limit"),
                   .density = number("fluid_density"),
                   .sound_speed = number("fluid_sound_speed"),
                   .spacing = number("fluid_spacing")};
  for (const double id : file_.all("id")) start_.interface.id.push_back(static_cast<std::uint32_t>(id));
  start_.interface.position = file_.all("reference_position");
  start_.interface.volume = file_.all("volume");
  start_.interface.area_vector = file_.all("area_vector");
  start_.interface.mass = file_.all("mass");
  start_.interface.spacing = number("interface_spacing");
  start_.motion = {file_.all("start_position"), file_.all("start_velocity")};
  starts_ = file_.all("window_start");
  lengths_ = file_.all("window_length");
  for (std::size_t n = 0; n < std::min(starts_.size(), lengths_.size()); ++n)
    ends_.push_back(starts_[n] + lengths_[n]);
  check_windows();
}

void ExchangeReader::refuse(const std::string& why) const {
  throw BadInput({{.place = path_.string(), .message = why}});
}

void ExchangeReader::check_windows() {
  if (ends_.empty()) refuse("it holds no window");
  for (std::size_t n = 0; n < ends_.size(); ++n) {
    const double before = n == 0 ? 0.0 : ends_[n - 1];
    if (!(lengths_[n] > 0) || !(std::abs(starts_[n] - before) <= rounding * ends_[n]))
      refuse(fmt::format("its window {} does not begin where the one before ends, or has no length", n));
  }
  for (const auto& [name, unit, shape] : series_of(start_.interface.size())) {
    const auto size = std::accumulate(shape.begin(), shape.end(), hsize_t{1}, std::multiplies<>());
    if (const auto found = file_.row(name, 0).size(); found != size || file_.rows(name) < ends_.size())
      refuse(fmt::format("its '{}' has {} of {}, not {} of {}", name, counted(file_.rows(name), "row"), found,
                         ends_.size(), size));
  }
}

std::size_t ExchangeReader::at(double time) const {
  const auto found = std::lower_bound(ends_.begin(), ends_.end(), time);
  return std::min(static_cast<std::size_t>(found - ends_.begin()), ends_.size() - 1);
}

const RecordedWindow& ExchangeReader::window(std::size_t number) {
  const auto found =
      std::find_if(kept_.begin(), kept_.end(), [&](const auto& one) { return one.first == number; });
  if (found != kept_.end()) return found->second;
  if (kept_.size() == most_kept) kept_.erase(kept_.begin());
  return kept_.emplace_back(number, read(number)).second;
}

RecordedWindow ExchangeReader::read(std::size_t n) {
  const auto row = [&](const char* name) {
    auto values = file_.row(name, n);
    if (!std::all_of(values.begin(), values.end(), [](double value) { return std::isfinite(value); }))
      refuse(fmt::format("'{}' of its window {} holds what is no number", name, n));
    return values;
  };
  const auto vector = [&](const char* name) -> Vec { return vector_of(row(name), 0); };
  const auto number = [&](const char* name) { return row(name)[0]; };
  const auto presence = row("presence");
  const auto if_there = [&](std::size_t k, const char* name) {
    return presence[k] != 0 ? row(name) : std::vector<double>{};
  };
  const auto health = [&](const char* energies, const char* momentum) {
    const auto of = row(energies);
    return Health{.kinetic_energy = of[0], .potential_energy = of[1], .momentum = vector(momentum)};
  };
  RecordedWindow found;
  found.window = {.number = n + 1, .iteration = 0, .time = starts_[n], .dt = lengths_[n]};
  found.fluid.load = {.pressure = row("pressure"),
                      .force = row("force"),
                      .friction_force = if_there(0, "friction_force"),
                      .impulse_on_fluid = vector("impulse_on_fluid"),
                      .work_of_impulse = number("work_of_impulse_on_fluid"),
                      .impedance = if_there(1, "impedance")};
  found.fluid.time_step_limit = number("time_step_limit");
  found.fluid.health = health("fluid_energies", "fluid_momentum");
  found.solid.motion = {.position = row("position"),
                        .velocity = row("velocity"),
                        .impulse = if_there(2, "impulse"),
                        .work_of_impulse = number("work_of_impulse_on_solid")};
  found.solid.impulse_taken = vector("impulse_taken");
  found.solid.health = health("solid_energies", "solid_momentum");
  return found;
}

}  // namespace toryu
