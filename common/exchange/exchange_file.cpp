#include "common/exchange/exchange_file.hpp"

#include <algorithm>

namespace toryu {

namespace {

constexpr const char* file_name = "exchange.h5";
/// Windows that a replay goes back and forth between.
constexpr std::size_t most_kept = 4;

/// Which of the vectors that may be absent are there, in this order: friction force, impedance, impulse.
using Presence = std::array<double, 3>;

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
  file_.series("window_start", "s", {});
  file_.series("window_length", "s", {});
  file_.series("presence", "1", {Presence{}.size()});
  file_.series("pressure", "Pa", {count});
  file_.series("force", "N/m", {count, dim});
  file_.series("friction_force", "N/m", {count, dim});
  file_.series("impedance", "kg/(s.m)", {count, dim});
  file_.series("impulse_on_fluid", "N.s/m", {dim});
  file_.series("work_of_impulse_on_fluid", "J/m", {});
  file_.series("time_step_limit", "s", {});
  file_.series("fluid_energies", "J/m", {2});
  file_.series("fluid_momentum", "N.s/m", {dim});
  file_.series("position", "m", {count, dim});
  file_.series("velocity", "m/s", {count, dim});
  file_.series("impulse", "N.s/m", {count, dim});
  file_.series("work_of_impulse_on_solid", "J/m", {});
  file_.series("impulse_taken", "N.s/m", {dim});
  file_.series("solid_energies", "J/m", {2});
  file_.series("solid_momentum", "N.s/m", {dim});
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
  if (ends_.empty()) throw BadInput({{.place = path_.string(), .message = "it holds no window"}});
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
  const auto vector = [&](const char* name) -> Vec { return vector_of(file_.row(name, n), 0); };
  const auto number = [&](const char* name) { return file_.row(name, n)[0]; };
  const auto presence = file_.row("presence", n);
  const auto if_there = [&](std::size_t k, const char* name) {
    return presence.at(k) != 0 ? file_.row(name, n) : std::vector<double>{};
  };
  const auto health = [&](const char* energies, const char* momentum) {
    const auto of = file_.row(energies, n);
    return Health{.kinetic_energy = of.at(0), .potential_energy = of.at(1), .momentum = vector(momentum)};
  };
  RecordedWindow found;
  found.window = {.number = n + 1, .iteration = 0, .time = starts_[n], .dt = lengths_[n]};
  found.fluid.load = {.pressure = file_.row("pressure", n),
                      .force = file_.row("force", n),
                      .friction_force = if_there(0, "friction_force"),
                      .impulse_on_fluid = vector("impulse_on_fluid"),
                      .work_of_impulse = number("work_of_impulse_on_fluid"),
                      .impedance = if_there(1, "impedance")};
  found.fluid.time_step_limit = number("time_step_limit");
  found.fluid.health = health("fluid_energies", "fluid_momentum");
  found.solid.motion = {.position = file_.row("position", n),
                        .velocity = file_.row("velocity", n),
                        .impulse = if_there(2, "impulse"),
                        .work_of_impulse = number("work_of_impulse_on_solid")};
  found.solid.impulse_taken = vector("impulse_taken");
  found.solid.health = health("solid_energies", "solid_momentum");
  return found;
}

}  // namespace toryu
