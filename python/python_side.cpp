#include "python/python_side.hpp"

#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include "common/error/failure.hpp"
#include "common/state/serialize.hpp"

namespace toryu::python {

namespace {

using Array = py::array_t<double, py::array::c_style>;

/// A vector a particle.
Array vectors(const std::vector<double>& values) {
  return Array({values.size() / dim, std::size_t{dim}}, values.data());
}

Array scalars(const std::vector<double>& values) {
  return Array(values.size(), values.data());
}

/// Of what a scheme or a scene may do without.
py::object vectors_if_any(const std::vector<double>& values) {
  if (values.empty()) return py::none();
  return vectors(values);
}

std::vector<double> values(const py::dict& told, const char* name) {
  const py::object value = told[name];
  if (value.is_none()) return {};
  const auto numbers = value.cast<Array>();
  return {numbers.data(), numbers.data() + numbers.size()};
}

double number(const py::dict& told, const char* name) {
  return told[name].cast<double>();
}

Vec vector(const py::dict& told, const char* name) {
  return vector_of(values(told, name), 0);
}

InterfaceMotion motion_of(const py::dict& told) {
  return {.position = values(told, "position"),
          .velocity = values(told, "velocity"),
          .impulse = values(told, "impulse"),
          .work_of_impulse = number(told, "work_of_impulse")};
}

}  // namespace

PythonSide::PythonSide(std::string program, const py::object& make, const std::string& case_as_json)
    : program_(std::move(program)), side_(make) {
  side_ = ask("__call__", case_as_json);
}

void PythonSide::rethrow(py::error_already_set& error) const {
  if (ending_) std::rethrow_exception(ending_);
  if (error.trace()) PyException_SetTraceback(error.value().ptr(), error.trace().ptr());
  const auto [code, reason] = py::module_::import("toryu.participant")
                                  .attr("ending_of")(error.value())
                                  .cast<std::pair<int, std::string>>();
  if (code == static_cast<int>(ExitCode::physics_failed)) throw PhysicsFailure(reason);
  if (code == static_cast<int>(ExitCode::bad_input)) throw BadInput({{.place = program_, .message = reason}});
  throw std::runtime_error(reason);
}

void PythonSide::count_steps_by(std::function<void()> count) {
  ask("count_steps_by", py::cpp_function([this, count = std::move(count)] {
        try {
          count();
        } catch (...) {
          ending_ = std::current_exception();
          PyErr_SetNone(PyExc_KeyboardInterrupt);  // which `except Exception` lets pass
          throw py::error_already_set();
        }
      }));
}

Health PythonSide::health() const {
  const py::dict told = ask("health");
  return {.kinetic_energy = number(told, "kinetic_energy"),
          .potential_energy = number(told, "potential_energy"),
          .momentum = vector(told, "momentum")};
}

void PythonSide::write_state(std::ostream& stream) const {
  write_states(stream, ask("state_as_bytes").cast<std::string>());
}

void PythonSide::read_state(std::istream& stream) {
  std::string bytes;
  read_states(stream, bytes);
  ask("take_state", py::bytes(bytes));
}

std::vector<Observation> PythonSide::observe() const {
  std::vector<Observation> row;
  for (const auto& [name, unit, value] :
       ask("observe").cast<std::vector<std::tuple<std::string, std::string, double>>>())
    row.push_back({name, unit, value});
  return row;
}

py::dict PythonSide::ask_window(double dt, const py::dict& given) {
  const auto scope = timers_.measure("python");
  return ask("advance", window_.number, window_.iteration, window_.time, dt, given);
}

FluidTraits PythonFluid::traits() const {
  const py::dict told = ask("traits");
  return {.reach = number(told, "reach"),
          .time_step_limit = number(told, "time_step_limit"),
          .density = number(told, "density"),
          .sound_speed = number(told, "sound_speed"),
          .spacing = number(told, "spacing")};
}

double PythonFluid::time_step_limit() const {
  return traits().time_step_limit;
}

void PythonFluid::attach(const Interface& interface) {
  interface_ = interface;
  py::dict told;
  told["id"] = py::array_t<std::uint32_t>(interface.id.size(), interface.id.data());
  told["position"] = vectors(interface.position);
  told["volume"] = scalars(interface.volume);
  told["area_vector"] = vectors(interface.area_vector);
  told["mass"] = scalars(interface.mass);
  told["spacing"] = interface.spacing;
  ask("begin", told);
}

void PythonFluid::begin_window(const FluidLink::Turn& turn) {
  window_ = turn;
  motion_ = turn.motion;
}

void PythonFluid::advance(double dt) {
  py::dict given;
  given["position"] = vectors(motion_.position);
  given["velocity"] = vectors(motion_.velocity);
  given["impulse"] = vectors_if_any(motion_.impulse);
  given["work_of_impulse"] = motion_.work_of_impulse;
  const py::dict told = ask_window(dt, given);
  load_ = {.pressure = values(told, "pressure"),
           .force = values(told, "force"),
           .friction_force = values(told, "friction_force"),
           .impulse_on_fluid = vector(told, "impulse_on_fluid"),
           .work_of_impulse = number(told, "work_of_impulse"),
           .impedance = values(told, "impedance")};
}

const Interface& PythonSolid::interface(double reach) {
  const py::dict told = ask("begin", reach);
  interface_ = {.id = told["id"].cast<std::vector<std::uint32_t>>(),
                .position = values(told, "position"),
                .volume = values(told, "volume"),
                .area_vector = values(told, "area_vector"),
                .mass = values(told, "mass"),
                .spacing = number(told, "spacing")};
  motion_ = {.position = interface_.position, .velocity = values(told, "velocity")};
  return interface_;
}

void PythonSolid::begin_window(const SolidLink::Turn& turn) {
  window_ = turn;
  load_ = turn.load;
}

void PythonSolid::advance(double dt) {
  py::dict given;
  given["pressure"] = scalars(load_.pressure);
  given["force"] = vectors(load_.force);
  given["friction_force"] = vectors_if_any(load_.friction_force);
  given["impedance"] = vectors_if_any(load_.impedance);
  given["velocity"] = vectors_if_any(load_.velocity);
  const py::dict told = ask_window(dt, given);
  motion_ = motion_of(told);
  impulse_taken_ = vector(told, "impulse_taken");
}

Frame PythonSolid::frame() const {
  std::vector<double> displacement = motion_.position;
  for (std::size_t k = 0; k < displacement.size(); ++k) displacement[k] -= interface_.position[k];
  return {.positions = motion_.position,
          .fields = {{.name = "displacement",
                      .unit = "m",
                      .description = "from the reference configuration",
                      .components = dim,
                      .values = std::move(displacement)},
                     {.name = "velocity",
                      .unit = "m/s",
                      .description = "of the particle",
                      .components = dim,
                      .values = motion_.velocity}}};
}

}  // namespace toryu::python
