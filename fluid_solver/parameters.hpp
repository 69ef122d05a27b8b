/// The `[fluid]` section of a case file.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "common/case/parameter_table.hpp"
#include "common/scene/scene.hpp"

namespace toryu::fluid {

/// A box filled with fluid at the start.
struct Region {
  std::string name;
  Box box;
  Vec velocity = Vec::Zero();  ///< at the start [m/s]
};
void describe(ParameterTable& table, Region& region);

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

/// Pulls all of the fluid towards a point, as strong as it is far: acceleration rate^2 times distance.
struct CentralForce {
  double rate = 0;  ///< Omega [1/s]
  Vec centre = Vec::Zero();
};
void describe(ParameterTable& table, CentralForce& force);

/// Start at rest under gravity: density from the equation of state for the weight of the fluid above.
struct HydrostaticStart {
  double surface_level = 0;  ///< height of the free surface against gravity [m]
};
void describe(ParameterTable& table, HydrostaticStart& start);

/// The pressure at which a closed medium is held, at rest density [Pa].
struct BackgroundPressure {
  double pressure = 0;
};
void describe(ParameterTable& table, BackgroundPressure& background);

/// What the linear part of the density is taken from before it is diffused.
enum class DiffusionGradient { renormalised, none };
struct DensityDiffusion {
  double delta = 0.1;
  DiffusionGradient gradient = DiffusionGradient::renormalised;
};
void describe(ParameterTable& table, DensityDiffusion& diffusion);

/// Spreads the particles evenly, see shifting.hpp.
struct ParticleShifting {
  double strength = 2.0;  ///< A
};
void describe(ParameterTable& table, ParticleShifting& shifting);

/// Keeps particles from pairing under suction, see terms/tensile_control.hpp.
struct TensileControl {};
void describe(ParameterTable& table, TensileControl& control);

/// Rates that are exact in linear fields, see consistent_gradients.hpp.
struct ConsistentGradients {};
void describe(ParameterTable& table, ConsistentGradients& gradients);

struct ArtificialViscosity {
  double alpha = 0.02;
  double beta = 0.0;
};
void describe(ParameterTable& table, ArtificialViscosity& viscosity);

struct LaminarViscosity {
  double dynamic_viscosity = 1e-3;  ///< [Pa s]
};
void describe(ParameterTable& table, LaminarViscosity& viscosity);

/// eta = consistency gdot^(exponent-1), kept between two bounds.
struct PowerLaw {
  double consistency = 0;         ///< m [Pa s^n]
  double exponent = 1;            ///< n
  double smallest_viscosity = 0;  ///< [Pa s]
  double largest_viscosity = 0;   ///< [Pa s]
};
void describe(ParameterTable& table, PowerLaw& law);

struct Carreau {
  double zero_shear_viscosity = 0;      ///< eta_0 [Pa s]
  double infinite_shear_viscosity = 0;  ///< eta_inf [Pa s]
  double relaxation_time = 0;           ///< lambda [s]
  double exponent = 1;                  ///< n
};
void describe(ParameterTable& table, Carreau& law);

/// What the length d_s of (33) is: see terms/friction.hpp.
enum class FrictionForm { normalised, as_printed };
struct Friction {
  double coefficient = 0.3;  ///< mu_A
  FrictionForm form = FrictionForm::normalised;
  double regularisation_speed = 0;  ///< [m/s]; 0: c_0/1000
};
void describe(ParameterTable& table, Friction& friction);

/// Keeps particles from cutting the corners of walls, see terms/wall_repulsion.hpp.
struct WallRepulsion {
  double strength = 1.0;  ///< B
  double range = 0.8;     ///< r_0/d_0
};
void describe(ParameterTable& table, WallRepulsion& repulsion);

/// Wear by Archard (1953): depth = K/H times the integral of p v dt.
struct Archard {
  double wear_coefficient = 0;  ///< K
  double hardness = 0;          ///< H of the work piece [Pa]
};
void describe(ParameterTable& table, Archard& law);

/// Decay of the roughness where material comes off: Ra = final + (initial - final) exp(-depth/decay_depth).
/// Where each cycle removes the same depth this is the Ra(n) = Ra_f + (Ra_0 - Ra_f) exp(-k n) that is fitted
/// to experiments, k = depth per cycle/decay_depth.
struct Roughness {
  double initial = 0, final = 0, decay_depth = 0;  ///< [m]
};
void describe(ParameterTable& table, Roughness& roughness);

/// What comes off the work pieces. One law gives the depth; with both, Preston's counts.
struct Removal {
  double preston_coefficient = 0;  ///< k of dh/dt = k p v (Preston 1927) [1/Pa]; 0: not used
  std::optional<Archard> archard;
  std::optional<Roughness> roughness;
};
void describe(ParameterTable& table, Removal& removal);

enum class WallSlip { no_slip, free_slip };
enum class WallDensity { rest, from_pressure };
struct WallModel {
  WallSlip slip = WallSlip::no_slip;
  WallDensity density = WallDensity::rest;
  bool suction = true;  ///< false: walls push and never pull
};
void describe(ParameterTable& table, WallModel& model);

/// Bounds beyond which a run is stopped as unphysical.
struct Limits {
  double largest_speed = 0;             ///< [m/s]; 0: the speed of sound
  double largest_density_change = 0.3;  ///< |rho/rho_0 - 1|
};
void describe(ParameterTable& table, Limits& limits);

enum class Quantity { front_x, pressure, flow_rate, flow_amplitude, flow_error, largest_void };
enum class Axis { x, y };
/// A number that the run reports over time.
struct Observer {
  std::string name;
  Quantity quantity = Quantity::pressure;
  Vec point = Vec::Zero();  ///< [m], of a pressure probe
  std::optional<Box> box;   ///< of a flow rate, of a largest void
  Axis axis = Axis::y;      ///< of a flow rate
};
void describe(ParameterTable& table, Observer& observer);

enum class KernelForm { cubic_spline, wendland_c2 };
enum class Integrator { midpoint, symplectic };

struct Parameters {
  double density = 1000.0;       ///< rho_0 [kg/m3]
  double sound_speed = 0;        ///< c_0 [m/s]
  int stiffness_exponent = 7;    ///< gamma of (3)
  double spacing = 0;            ///< d_0 [m]
  double smoothing_ratio = 1.3;  ///< h/d_0
  KernelForm kernel = KernelForm::cubic_spline;
  Integrator integrator = Integrator::midpoint;
  double time_step_share = 1.0;  ///< share of the stable step that is taken
  double neighbour_skin = 0.12;  ///< margin of the neighbour lists, as a share of the kernel's support
  double start_disorder = 0;     ///< largest distance from the lattice at the start, share of the spacing
  std::vector<Region> regions;
  std::vector<Box> holes;
  std::optional<HydrostaticStart> hydrostatic_start;
  std::optional<InitialFlow> initial_flow;
  std::optional<CentralForce> central_force;
  std::optional<BackgroundPressure> background_pressure;
  std::optional<DensityDiffusion> density_diffusion;
  std::optional<ParticleShifting> particle_shifting;
  std::optional<TensileControl> tensile_control;
  std::optional<ConsistentGradients> consistent_gradients;
  std::optional<ArtificialViscosity> artificial_viscosity;
  std::optional<LaminarViscosity> laminar_viscosity;
  std::optional<PowerLaw> power_law;
  std::optional<Carreau> carreau;
  std::optional<Friction> friction;
  std::optional<WallRepulsion> wall_repulsion;
  std::optional<Removal> removal;
  WallModel wall_model;
  Limits limits;
  std::vector<Observer> observers;

  double h() const { return smoothing_ratio * spacing; }
  /// Whether a term asks who has a free surface in reach.
  bool seeks_free_surface() const { return particle_shifting || keeps_off_walls(); }
  /// Whether one of them acts away from walls alone.
  bool keeps_off_walls() const { return tensile_control || consistent_gradients; }
  double strip_width() const;  ///< of the order in which particles are stored [m]
};
void describe(ParameterTable& table, Parameters& parameters);

}  // namespace toryu::fluid
