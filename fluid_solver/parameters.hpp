/// The `[fluid]` section of a case file.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "common/case/parameter_table.hpp"
#include "common/scene/scene.hpp"
#include "fluid_solver/implicit/solver_parameters.hpp"
#include "fluid_solver/named_medium.hpp"
#include "fluid_solver/open_ends/parameters.hpp"
#include "fluid_solver/similarity.hpp"
#include "fluid_solver/temperature.hpp"
#include "fluid_solver/terms.hpp"

namespace toryu::fluid {

/// A box or another shape filled with fluid at the start.
struct Region {
  std::string name;
  Box box;
  Vec velocity = Vec::Zero();  ///< at the start [m/s]
  BodyShape shape = {};
};
void describe(ParameterTable& table, Region& region);

/// A box or another shape cut out of the fluid.
struct Hole : Box {
  std::string name;  ///< by which a case that builds on this one replaces it; empty if it has none
  BodyShape shape = {};
};
void describe(ParameterTable& table, Hole& hole);

/// A flow that all of the fluid starts with, see initial_flow.hpp.
enum class FlowProfile { taylor_green, rotation, strain, standing_wave };
struct InitialFlow {
  FlowProfile profile = FlowProfile::taylor_green;
  double speed = 0;          ///< U [m/s]
  double length = 0;         ///< of the period; of a rotation or strain where U is reached [m]
  double depth = 0;          ///< of the water under a standing wave [m]
  Vec centre = Vec::Zero();  ///< [m]
};
void describe(ParameterTable& table, InitialFlow& flow);

/// Start at rest under gravity: density from the equation of state for the weight of the fluid above.
struct HydrostaticStart {
  double surface_level = 0;  ///< height of the free surface against gravity [m]
};
void describe(ParameterTable& table, HydrostaticStart& start);

enum class WallSlip { no_slip, free_slip };
enum class WallDensity { rest, from_pressure };
enum class WallExtrapolation { mean, fit };
struct WallModel {
  WallSlip slip = WallSlip::no_slip;
  WallDensity density = WallDensity::rest;
  WallExtrapolation extrapolation = WallExtrapolation::mean;
  bool suction = true;  ///< false: walls push and never pull
};
void describe(ParameterTable& table, WallModel& model);

/// Bounds beyond which a run is stopped as unphysical.
struct Limits {
  double largest_speed = 0;             ///< [m/s]; 0: the speed of sound
  double largest_density_change = 0.3;  ///< |rho/rho_0 - 1|
  // see run_watch.hpp
  double largest_mean_density_change = 0.1;  ///< of mass over volume since the start
  double largest_share_in_walls = 0.05;      ///< of the particles
  double largest_energy_gain = 1;            ///< over the largest energy turned over
};
void describe(ParameterTable& table, Limits& limits);

enum class Quantity { front_x, pressure, flow_rate, flow_amplitude, flow_error, largest_void, volume_flux };
enum class Axis { x, y };
/// A number that the run reports over time.
struct Observer {
  std::string name;
  Quantity quantity = Quantity::pressure;
  Vec point = Vec::Zero();  ///< [m], of a pressure probe
  std::optional<Box> box;   ///< of a flow rate, a volume flux, a largest void
  Axis axis = Axis::y;      ///< of a flow rate, a volume flux
  BodyShape shape = {};
};
void describe(ParameterTable& table, Observer& observer);

/// How the state advances: `weakly_compressible/` or `implicit/`.
enum class Model { weakly_compressible, implicit };
enum class KernelForm { cubic_spline, wendland_c2 };
enum class Integrator { midpoint, symplectic };

struct Parameters : OptionalTerms {
  Model model = Model::weakly_compressible;
  std::optional<ImplicitSolver> implicit;  ///< its defaults where the implicit model has none
  double density = 1000.0;                 ///< rho_0 [kg/m3]
  std::optional<NamedMedium> medium;
  std::optional<Temperature> temperature;
  std::optional<Similarity> similarity;
  double sound_speed = 0;        ///< c_0 [m/s]
  int stiffness_exponent = 7;    ///< gamma of (3)
  double spacing = 0;            ///< d_0 [m]
  double smoothing_ratio = 1.3;  ///< h/d_0
  KernelForm kernel = KernelForm::cubic_spline;
  Integrator integrator = Integrator::symplectic;
  double time_step_share = 1.0;  ///< share of the stable step that is taken
  double neighbour_skin =
      0.12;                   ///< largest margin of the neighbour lists, as a share of the kernel's support
  double start_disorder = 0;  ///< largest distance from the lattice at the start, share of the spacing
  std::vector<Region> regions;
  std::vector<Hole> holes;
  std::optional<HydrostaticStart> hydrostatic_start;
  std::optional<InitialFlow> initial_flow;
  std::vector<Inlet> inlets = {};
  std::vector<Outlet> outlets = {};
  WallModel wall_model;
  Limits limits;
  std::vector<Observer> observers;

  double h() const { return smoothing_ratio * spacing; }
  bool has_open_ends() const { return !inlets.empty() || !outlets.empty(); }
  /// Whether a term asks who has a free surface in reach.
  bool seeks_free_surface() const { return particle_shifting || keeps_off_walls(); }
  /// Whether one of them acts away from walls alone.
  bool keeps_off_walls() const { return tensile_control || consistent_gradients; }
  double strip_width() const;  ///< of the order in which particles are stored [m]
};
void describe(ParameterTable& table, Parameters& parameters);

/// Puts the medium that is named, and what its temperature does to it, into the laws of `parameters`. Returns
/// what the log says.
std::vector<std::string> complete_medium(Parameters& parameters);

}  // namespace toryu::fluid
