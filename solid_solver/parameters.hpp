/// The section [solid] of a case file. Optional models are absent by default and switched on by their
/// sub-section.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "common/scene/scene.hpp"
#include "solid_solver/initial_velocity.hpp"
#include "solid_solver/material.hpp"
#include "solid_solver/observers.hpp"
#include "solid_solver/rigid/mounting.hpp"
#include "solid_solver/terms/artificial_stress.hpp"
#include "solid_solver/terms/artificial_viscosity.hpp"
#include "solid_solver/terms/body_contact.hpp"
#include "solid_solver/terms/damping.hpp"
#include "solid_solver/terms/hourglass_penalty.hpp"
#include "solid_solver/terms/wall_contact.hpp"
#include "solid_solver/terms/yeoh.hpp"

namespace toryu::solid {

enum class Formulation { total_lagrangian, updated_lagrangian, rigid };
enum class ElasticLaw { saint_venant_kirchhoff, neo_hookean };
enum class Integrator { midpoint, symplectic };
enum class Gradients { plain, renormalised };

/// A box that is cut out of the solid.
struct NamedBox {
  std::string name;
  Box box;
  BodyShape shape = {};
};
void describe(ParameterTable& table, NamedBox& box);

/// A box whose particles are held, or moved as prescribed.
struct Clamp {
  std::string name;
  Box box;
  std::string moves_with = {};        ///< the name of its motion among those that bodies share
  std::optional<Motion> motion = {};  ///< that one, or that of the wall which holds it
  BodyShape shape = {};
};
void describe(ParameterTable& table, Clamp& clamp);

/// A factor that swings [1].
struct Pulse : Sine {};
void describe(ParameterTable& table, Pulse& pulse);

/// A box filled with the solid.
struct Region {
  std::string name;
  Box box;
  std::optional<InitialVelocity> initial_velocity = std::nullopt;  ///< absent: that of the whole solid
  bool observed = false;  ///< whether a run reports where its centre of mass is and how fast
  BodyShape shape = {};
  std::vector<WornFace> worn = {};  ///< faces that lie behind those of the box, across one axis
  std::string material = {};        ///< its name; none: that of [solid]
  std::string body = {};            ///< the name of the rigid one to which it belongs, if there are names
};
void describe(ParameterTable& table, Region& region);

/// A rigid body, one of several or beside elastic regions.
struct NamedBody {
  std::string name;
  std::optional<Mounting> mounting = std::nullopt;
};
void describe(ParameterTable& table, NamedBody& body);

/// What a solid is made of.
struct Material {
  std::string name = {};  ///< none: that of [solid]
  ElasticLaw law = ElasticLaw::saint_venant_kirchhoff;
  std::optional<Yeoh> yeoh = std::nullopt;  ///< in the place of `law`
  /// For small strains; E and nu are no numbers where the case does not say them.
  ElasticMaterial elastic{1000.0, std::numeric_limits<double>::quiet_NaN(),
                          std::numeric_limits<double>::quiet_NaN()};
};
void describe(ParameterTable& table, Material& material);

/// A force, shared equally by the particles of a box, or a constant pressure on their share of the surface,
/// as large and directed as the surface is in the unloaded body. Over time a force is multiplied by a factor,
/// the sum of what is there; constant if nothing is.
struct BoxLoad {
  std::string name;
  Box box;
  Vec force = Vec::Zero();  ///< [N per metre depth]
  double pressure = 0;      ///< [Pa]
  BodyShape shape = {};
  Rows factor = {};  ///< rows of time [s], factor; linear in between, constant beyond
  std::vector<Pulse> sine = {};
  bool changes() const { return !factor.empty() || !sine.empty(); }
  double factor_at(double t) const;
};
void describe(ParameterTable& table, BoxLoad& load);

/// A value beyond these is no physics any more: the run stops.
struct SolidLimits {
  double speed = 0;     ///< [m/s]; 0: the longitudinal sound speed; of a rigid body any
  double strain = 1.0;  ///< largest relative change of density (updated) or of length (total Lagrangian)
};
void describe(ParameterTable& table, SolidLimits& limits);

struct Parameters {
  Formulation formulation = Formulation::total_lagrangian;
  ElasticLaw law = ElasticLaw::saint_venant_kirchhoff;
  std::optional<Yeoh> yeoh;                    ///< in the place of `law`
  ElasticMaterial material{1000.0, 0.0, 0.0};  ///< for small strains
  double spacing = 0;                          ///< [m]
  double smoothing_ratio = 1.3;                ///< h over the spacing
  double time_step_share = 0.8;                ///< of the largest stable time step
  double courant_number = 0.25;                ///< of the acoustic limit of the updated Lagrangian form
  Gradients gradients = Gradients::plain;
  Integrator integrator = Integrator::midpoint;  ///< of the updated Lagrangian form
  std::vector<Material> materials = {};          ///< beside that of [solid], for regions that name them
  std::vector<Region> regions;
  std::vector<NamedBox> holes;
  std::vector<Clamp> clamps;
  std::vector<BoxLoad> loads;
  std::vector<PointObserver> observers;
  std::optional<InitialVelocity> initial_velocity;
  std::optional<HourglassPenalty> hourglass;
  std::optional<ArtificialViscosity> artificial_viscosity;
  std::optional<ArtificialStress> artificial_stress;
  std::optional<Damping> damping;
  std::optional<Contact> wall_contact;
  std::optional<Contact> body_contact;
  std::optional<Detachment> detachment;
  std::optional<BondLimits> bonds;
  std::optional<Mounting> mounting = {};  ///< of a rigid body that is the only one
  std::vector<NamedBody> bodies = {};     ///< rigid ones, where there are several or elastic regions too
  SolidLimits limits;

  double h() const { return smoothing_ratio * spacing; }  ///< smoothing length [m]
  bool has_rigid_bodies() const { return formulation == Formulation::rigid || !bodies.empty(); }
  /// Whether these are beside elastic regions.
  bool is_mixed() const { return formulation != Formulation::rigid && !bodies.empty(); }
  double largest_speed() const;  ///< beyond which a run stops [m/s]
  /// That of [solid], then those that have names.
  std::vector<Material> all_materials() const;
  /// Index among all of them of what each region is made of.
  std::vector<std::uint32_t> materials_of_regions() const;
  double fastest_sound() const;  ///< largest longitudinal sound speed of what the regions are made of [m/s]
  /// What bodies and walls that touch need: the bulk modulus of the softest, the density of the lightest.
  ElasticMaterial material_in_contact() const;
};
void describe(ParameterTable& table, Parameters& parameters);

}  // namespace toryu::solid
