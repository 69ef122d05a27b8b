/// What lammps_fluid reads of a case. It knows less than fluid_solver: whatever else a case asks for is
/// refused by name.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "common/case/case_file.hpp"
#include "physics.hpp"

namespace toryu::lammps_fluid {

struct Box {
  Vec min = Vec::Zero(), max = Vec::Zero();  ///< [m]
};
struct Wall {
  std::string name;
  Box box;
};
struct Region : Wall {
  Vec velocity = Vec::Zero();  ///< [m/s]
};
struct Diffusion {
  double delta = 0.1;
  enum class Gradient { renormalised, none } gradient = Gradient::renormalised;
};
struct ArtificialViscosity {
  double alpha = 0.02, beta = 0;
};
struct LaminarViscosity {
  double dynamic_viscosity = 0;  ///< [Pa s]
};
struct HydrostaticStart {
  double surface_level = 0;  ///< [m]
};
struct WallModel {
  enum class Slip { no_slip, free_slip } slip = Slip::no_slip;
  bool suction = true;
};
struct Limits {
  double speed = 0, density_change = 0.3;  ///< [m/s], 0: the speed of sound; [1]
};
struct Observer {
  std::string name;
  enum class Quantity { front_x, pressure } quantity = Quantity::front_x;
  Vec point = Vec::Zero();  ///< [m]
};

struct Scene {
  std::string title;
  Vec gravity = Vec::Zero();  ///< [m/s2]
  double end_time = 0, frame_interval = 0, series_interval = 0;
  double checkpoint_interval = 0, checkpoint_every = 600;
  Box domain;
};

enum class Kernel { cubic_spline, wendland_c2 };
enum class Integrator { midpoint, symplectic };

struct Parameters {
  double density = 0, sound_speed = 0, spacing = 0, smoothing_ratio = 1.3;
  int stiffness_exponent = 7;
  Kernel kernel = Kernel::cubic_spline;
  Integrator integrator = Integrator::symplectic;
  double time_step_share = 1, neighbour_skin = 0.12;
  std::optional<HydrostaticStart> hydrostatic_start;
  std::optional<Diffusion> diffusion;
  std::optional<ArtificialViscosity> artificial;
  std::optional<LaminarViscosity> laminar;
  WallModel wall_model;
  Limits limits;
  std::vector<Region> regions;
  std::vector<Observer> observers;

  double h() const { return smoothing_ratio * spacing; }
  /// The longest stable step at a largest speed and acceleration, by the rules of fluid_solver [s].
  double time_step_limit(double speed, double acceleration) const;
};

struct Case {
  Scene scene;
  std::vector<Wall> walls;
  Parameters parameters;
};

/// Throws BadInput with all that is wrong, or that lammps_fluid does not know.
Case read_case(CaseFile& file);

/// Particles, one after the other; numbers count from 0.
struct Start {
  Physics physics;
  std::vector<double> position, velocity;  ///< dim values each
  std::vector<double> density, mass;
};
/// Fills regions and walls on one lattice, the interface as the solid has registered it. Throws BadInput.
Start fill(const Case& of, const std::vector<double>& interface_position,
           const std::vector<double>& interface_volume);

}  // namespace toryu::lammps_fluid
