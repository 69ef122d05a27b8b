/// What both formulations of the solid share: the particles' state, clamps, loads, energies, observers,
/// frames. A formulation adds how the state advances, and its stress.
#pragma once

#include <cmath>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "common/scene/period.hpp"
#include "common/sph/points.hpp"
#include "common/state/field.hpp"
#include "solid_solver/body.hpp"
#include "solid_solver/bonds.hpp"
#include "solid_solver/drive.hpp"
#include "solid_solver/energy_watch.hpp"
#include "solid_solver/parameters.hpp"
#include "solid_solver/passed_walls.hpp"
#include "solid_solver/solid.hpp"

namespace toryu::solid {

static_assert(dim == 2, "the stress is that of plane strain");

/// Stress of plane strain [Pa].
struct Stress {
  double xx = 0, yy = 0, zz = 0, xy = 0;
  double pressure() const { return -(xx + yy + zz) / 3.0; }
  double von_mises() const;
};

/// What has acted on the solid since the start [N.s per metre depth]: the change of its momentum is the sum,
/// but for what `damping` takes.
struct Impulses {
  Vec loads = Vec::Zero();   ///< gravity, constant loads and the fluid, held particles included
  Vec walls = Vec::Zero();   ///< of the contact with walls
  Vec clamps = Vec::Zero();  ///< what holds the held particles
};

template <class Archive>
void serialize(Archive& archive, Impulses& impulses) {
  auto& [loads, walls, clamps] = impulses;
  archive(loads, walls, clamps);
}

/// How the fluid answers the normal velocity of a particle of the interface.
struct Impedance {
  Vec normal = Vec::Zero();
  double value = 0;            ///< [kg/(s.m)]
  Vec velocity = Vec::Zero();  ///< of the fluid's copy of the particle [m/s]
  double impulse = 0;          ///< taken along the normal, beyond the load's force [N s/m]
};

template <class Archive>
void serialize(Archive& archive, Impedance& impedance) {
  auto& [normal, value, velocity, impulse] = impedance;
  archive(normal, value, velocity, impulse);
}

class SolidModel : public Solid {
 public:
  SolidModel(const Parameters& parameters, const Body& body, const Scene& scene);

  void save() override;
  void restore() override;
  void accept() override;
  void write_state(std::ostream& stream) const override;
  void read_state(std::istream& stream) override;
  void check(double time) const override;
  Frame frame() const override;
  std::vector<Observation> observe() const override;
  /// Of what is observed: where places of the body are, by their names.
  virtual std::vector<Observation> places() const;
  /// And what the body as a whole holds, has been given, and has lost, by names that all solids share.
  std::vector<Observation> balance() const;
  std::vector<ActiveTerm> active_terms() const override;
  std::vector<std::pair<std::string, double>> figures() const override;
  std::size_t particle_count() const override { return body_.size(); }

  const Body& body() const { return body_; }
  Interface interface(double reach) const override;
  InterfaceMotion motion(const std::vector<std::uint32_t>& particles) const override;
  Vec set_interface_load(const std::vector<std::uint32_t>& particles, const InterfaceLoad& load) override;
  std::vector<double> excess_impulse() const override;
  double work_of_excess_impulse() const override { return state_.impedance_work; }
  Health health() const override;
  const Impulses& impulses() const { return state_.impulses; }
  void record_detached(const RecordDetached& record) override;

  Vec displacement(std::size_t particle) const { return at(state_.u, slot_[particle]); }  ///< [m]
  Vec velocity(std::size_t particle) const { return at(state_.v, slot_[particle]); }      ///< [m/s]
  Vec acceleration(std::size_t particle) const;                                           ///< [m/s2]
  double mass(std::size_t particle) const { return body_.mass(particle); }                ///< [kg/m]
  double total_mass() const { return body_.total_mass(); }                                ///< [kg/m]
  /// Name of the region to which it belongs.
  const std::string& region_of(std::size_t particle) const {
    return parameters_.regions[body_.region[particle]].name;
  }
  virtual bool has_stress() const { return true; }        ///< whether the form knows any
  virtual Stress stress(std::size_t particle) const = 0;  ///< Cauchy, as it drives the particles
  /// Cauchy, as near to that of the body as the particles tell: what frames show.
  virtual Stress recovered_stress(std::size_t particle) const { return stress(particle); }
  /// Energies that the deformation holds [J per metre depth].
  virtual std::vector<Observation> internal_energies() const = 0;
  const Timers& timers() const override { return timers_; }

 protected:
  /// All that a step, a load or an observer changes, but for what a formulation adds.
  struct State {
    double time = 0;                    ///< [s]
    long steps = 0;                     ///< taken
    std::vector<std::uint32_t> number;  ///< of the particle stored in a slot
    Declared<VecField> u{"displacement", "m", FieldKind::state};
    Declared<VecField> v{"velocity", "m/s", FieldKind::state};
    /// By stress, viscosity and contact.
    Declared<VecField> a{"acceleration", "m/s2", FieldKind::state};
    /// Of `a`, if walls act on the solid.
    Declared<VecField> push{"acceleration by walls", "m/s2", FieldKind::state, Presence::on_demand};
    /// By gravity and loads.
    Declared<VecField> external{"external acceleration", "m/s2", FieldKind::derived};
    /// Of the idle lanes: what the last particle bore when it was sorted there.
    Vec idle_external = Vec::Zero();
    std::vector<std::uint32_t> loaded;  ///< numbers of the interface's particles
    std::vector<Vec> load, u_at_load;   ///< of the interface [N/m], [m]
    std::vector<Impedance> impedance;   ///< of the interface, where the load has any
    double impedance_work = 0;          ///< since the load was set [J/m]
    double past_work = 0;               ///< of earlier interface loads [J/m]
    Vec load_sum = Vec::Zero();         ///< of gravity and all loads [N/m]
    Impulses impulses;
    double time_of_drive = 0;    ///< for which gravity and loads were found [s]
    double work_of_clamps = 0;   ///< by clamps that move, since the start [J/m]
    double work_of_changes = 0;  ///< by the part of gravity and loads that changes, likewise [J/m]
    ContactWalls::State walls;
    TouchingBodies::State bodies;
    DetachmentObserver::State detachment;
    BondWatch::State bonds;
    EnergyWatch energy;
  };
  template <class Archive>
  friend void serialize(Archive& archive, State& state) {
    auto& [time, steps, number, u, v, a, push, external, idle_external, loaded, load, u_at_load, impedance,
           impedance_work, past_work, load_sum, impulses, time_of_drive, work_of_clamps, work_of_changes,
           walls, bodies, detachment, bonds, energy] = state;
    archive(time, steps, number, u, v, a, push, external, idle_external, loaded, load, u_at_load, impedance,
            impedance_work, past_work, load_sum, impulses, time_of_drive, work_of_clamps, work_of_changes,
            walls, bodies, detachment, bonds, energy);
  }

  /// By gravity and loads, but for those of the interface [m/s2].
  const Vec& steady_acceleration(std::size_t particle) const { return constant_[particle]; }
  /// Adds to the external acceleration what the interface's impedance z makes of it in a step `dt` [s]:
  ///
  ///     m a = -z n n.(w - w_c),   w = v + dt/2 (a_rest - z/m n n.(w - w_c))
  ///
  /// with w_c the velocity of the fluid's copy: w is the velocity at which a step of two kicks drifts, so
  /// that damping is stable for any z, and its impulse is z (w_c dt - du). `kept` is what other damping
  /// leaves of the velocity in the first kick.
  void brake_by_impedance(double dt, double kept = 1.0);
  /// Cauchy's at the point of an observer.
  virtual Stress stress_at(std::size_t observer) const;
  virtual double kinetic_energy() const;  ///< [J/m]
  Vec momentum() const;                   ///< [N.s/m]
  /// Throws if the strain of a particle is beyond its limit.
  virtual void check_strain(double time) const = 0;
  /// What of a case keeps such a body in its domain.
  virtual std::string_view what_holds() const { return "a [[solid.clamp]] holds it"; }
  [[noreturn]] void fail(std::size_t slot, double time, const std::string& quantity, const std::string& value,
                         const std::string& limit) const;
  /// Stores the particles in another order: slot k receives what stood in slot order[k]. A formulation that
  /// uses it reorders its own fields too.
  void sort_particles(const std::vector<std::uint32_t>& order);
  double strip_width() const { return std::sqrt(static_cast<double>(lane_count)) * body_.spacing; }  ///< [m]
  /// Adds the walls' push on the particles at x [m] and the present time to `a`, within a parallel region.
  void add_wall_contact(const VecField& x);
  /// Sets the present positions of a cluster, where they lie in the domain [m].
  void place_in_domain(VecField& x, std::size_t cluster) const;
  /// Counts what acts at present for a time `dt` [s].
  void count_impulses(double dt);
  /// Finds what drives a step of `dt` [s] that begins, in its middle, and notes what it begins from.
  void begin_drive(double dt);
  /// Puts the particles of clamps that move to where they are at the present time.
  void move_clamps();
  /// Counts the work of what drove the step.
  void end_drive();
  /// Records particles that have come off and checks the bonds, where that is asked for and due.
  void end_step();
  double energy_of_rounding() const;
  /// From now on checks the bonds now and then.
  void watch_bonds();
  std::size_t clusters() const { return padded(particle_count()) / lane_count; }

  Parameters parameters_;
  Body body_;
  Vec gravity_;
  Box domain_;  ///< without end where space repeats itself
  Period period_;
  State state_, saved_;
  // What follows from the numbers of the particles:
  std::vector<std::uint32_t> slot_;  ///< of a particle
  VecField X_;                       ///< reference position [m]
  Field mobile_;                     ///< 0 where a clamp holds, else 1
  Field inverse_rho_;                ///< of the unloaded particle [m3/kg]
  Timers timers_;
  std::optional<ContactWalls> walls_;     ///< if walls act on the solid
  std::optional<PassedWalls> passed_;     ///< if there are walls that do not
  std::optional<TouchingBodies> bodies_;  ///< if bodies that are not joined push each other
  Drive drive_;
  double first_energy_ = 0;  ///< of the start: kinetic, and of springs [J/m]

 private:
  void find_driven(double time);  ///< gravity and loads at `time` [s]
  struct OnFree {
    Pose pose = {};           ///< of the clamps
    Vec force = Vec::Zero();  ///< [N/m]
    double moment = 0;        ///< about their centre [N.m/m]
  };
  OnFree force_on_free() const;  ///< by the solid on what no clamp holds
  /// On a held particle by gravity and loads and, where clamps do not turn, by the solid.
  Vec force_on(std::size_t particle) const;  ///< but for that of a clamp [N/m]
  void find_slots();                         ///< and what stands in them, after the numbers have changed
  void find_external();                      ///< after the numbers or the loads have changed
  Vec initial_velocity(std::size_t particle) const;  ///< [m/s]
  double potential_energy() const;
  double interface_work() const;
  Vec sum_of_loads() const;
  double contact_energy() const;
  std::vector<Vec> positions() const;  ///< by number [m]
  void find_detached();
  void observe_regions(std::vector<Observation>& row) const;
  void observe_detachment(std::vector<Observation>& row) const;
  void observe_bonds(std::vector<Observation>& row) const;
  void append_stress(std::vector<FrameField>& fields) const;

  std::vector<Vec> constant_;  ///< acceleration by gravity and loads, constant over a step, by number [m/s2]
  // before a step that is driven
  std::vector<Vec> u_before_;  ///< displacement of each particle [m]
  struct ClampedParticle {
    Vec v, force;  ///< [m/s], [N/m]
  };
  OnFree on_free_before_;
  std::vector<ClampedParticle> clamped_before_;  ///< those of clamps that move, in their order
  std::vector<std::pair<PointObserver, MaterialPoint>> observers_;
  std::vector<std::uint32_t> held_;  ///< numbers of the held particles
  std::optional<DetachmentObserver> detachment_;
  RecordDetached record_detached_;
  std::optional<std::size_t> recorded_detached_;  ///< how many were recorded; none yet
  std::optional<BondWatch> bonds_;
};

}  // namespace toryu::solid
