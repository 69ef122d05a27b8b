/// What both formulations of the solid share: the particles' state, clamps, loads, energies, observers,
/// frames. A formulation adds how the state advances, and its stress.
#pragma once

#include <cmath>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "common/link/participant.hpp"
#include "common/run/solver.hpp"
#include "common/run/timers.hpp"
#include "common/sph/points.hpp"
#include "solid_solver/body.hpp"
#include "solid_solver/bonds.hpp"
#include "solid_solver/detachment.hpp"
#include "solid_solver/energy_watch.hpp"
#include "solid_solver/parameters.hpp"

namespace toryu::solid {

/// Stress of plane strain [Pa].
struct Stress {
  double xx = 0, yy = 0, zz = 0, xy = 0;
  double pressure() const { return -(xx + yy + zz) / 3.0; }
  double von_mises() const;
};

/// What has acted on the solid since the start [N.s per metre depth]: the change of its momentum is the sum,
/// but for what `damping` takes.
struct Impulses {
  Vec load = Vec::Zero();    ///< gravity, constant loads and the fluid, held particles included
  Vec walls = Vec::Zero();   ///< of the contact with walls
  Vec clamps = Vec::Zero();  ///< what holds the held particles
};

/// Hears of all particles that have come off so far, whenever there are new ones.
using HearDetached = std::function<void(const std::vector<DetachedParticle>&)>;

class SolidModel : public Solver {
 public:
  SolidModel(const Parameters& parameters, const Body& body, const Scene& scene);

  void save() override;
  void restore() override { restore_(); }
  void accept() override;
  void write_state(std::ostream& stream) const override;
  void read_state(std::istream& stream) override;
  void check(double time) const override;
  Frame frame() const override;
  std::vector<Observation> observe() const override;
  std::vector<ActiveTerm> active_terms() const override;
  std::vector<std::pair<std::string, double>> figures() const override;
  std::size_t particle_count() const override { return body_.size(); }

  const Body& body() const { return body_; }
  /// The particles that a fluid which sees `reach` [m] deep can touch, unloaded.
  Interface interface(double reach) const;
  InterfaceMotion motion(const std::vector<std::uint32_t>& particles) const;
  /// Sets the force on the interface [N per metre depth], which holds until the next call. Returns the sum
  /// that the solid takes per second, clamps included [N per metre depth].
  Vec set_interface_load(const std::vector<std::uint32_t>& particles, const InterfaceLoad& load);
  Health health() const;
  const Impulses& impulses() const { return impulses_; }
  /// From now on `hear` is told of particles that come off. Needs [solid.detachment].
  void tell_detached(const HearDetached& hear);

  Vec displacement(std::size_t particle) const { return at(u_, slot_[particle]); }  ///< [m]
  Vec velocity(std::size_t particle) const { return at(v_, slot_[particle]); }      ///< [m/s]
  Vec acceleration(std::size_t particle) const;                                     ///< [m/s2]
  double mass(std::size_t particle) const { return parameters_.material.density * body_.volume(particle); }
  double total_mass() const { return parameters_.material.density * body_.total_volume(); }  ///< [kg/m]
  virtual Stress stress(std::size_t particle) const = 0;                                     ///< Cauchy
  /// Energies that the deformation holds [J per metre depth].
  virtual std::vector<Observation> internal_energies() const = 0;
  const Timers& timers() const { return timers_; }

 protected:
  /// Throws if the strain of a particle is beyond its limit.
  virtual void check_strain(double time) const = 0;
  [[noreturn]] void fail(std::size_t slot, double time, const std::string& quantity, const std::string& value,
                         const std::string& limit) const;
  /// Stores the particles in another order: slot k receives what stood in slot order[k]. A formulation that
  /// uses it reorders its own fields too.
  void reorder_particles(const std::vector<std::uint32_t>& order);
  double strip_width() const { return std::sqrt(static_cast<double>(lane_count)) * body_.spacing; }  ///< [m]
  /// Adds the walls' push on the particles at x [m] and the present time to `a_`, within a parallel region.
  void add_wall_contact(const VecField& x);
  /// Counts what acts at present for a time `dt` [s].
  void count_impulses(double dt);
  /// Ends a step: looks for particles that have come off and at the bonds, where that is asked for and due.
  void look_at_particles();
  /// From now on looks at the bonds now and then.
  void watch_bonds();
  std::size_t clusters() const { return padded(particle_count()) / lane_count; }

  Parameters parameters_;
  Body body_;
  Vec gravity_;
  Box domain_;
  double time_ = 0;                    ///< [s]
  std::vector<std::uint32_t> number_;  ///< of the particle stored in a slot
  std::vector<std::uint32_t> slot_;    ///< of a particle
  VecField X_;                         ///< reference position [m]
  VecField u_, v_;                     ///< displacement [m], velocity [m/s]
  VecField a_;                         ///< acceleration by stress, viscosity and contact [m/s2]
  VecField external_;                  ///< acceleration by gravity and loads [m/s2]
  Timers timers_;
  std::optional<ContactWalls> walls_;     ///< if walls act on the solid
  std::optional<TouchingBodies> bodies_;  ///< if bodies that are not joined push each other
  Field mobile_;                          ///< 0 where a clamp holds, else 1

 private:
  void find_slots();                                 ///< after `number_` changed
  Vec initial_velocity(std::size_t particle) const;  ///< [m/s]
  double kinetic_energy() const;
  double potential_energy() const;
  double interface_work() const;
  Vec sum_of_loads() const;
  double contact_energy() const;
  Vec momentum() const;
  std::vector<Vec> positions() const;  ///< by number [m]
  void look_for_detached();
  void observe_regions(std::vector<Observation>& row) const;
  void observe_detachment(std::vector<Observation>& row) const;
  void observe_bonds(std::vector<Observation>& row) const;

  VecField constant_;  ///< gravity and constant loads [m/s2]
  std::vector<std::uint32_t> loaded_;
  std::vector<Vec> load_, u_at_load_;  ///< of the interface [N/m], [m]
  double past_work_ = 0;               ///< of earlier interface loads [J/m]
  double first_energy_ = 0;            ///< kinetic, of the start [J/m]
  std::vector<std::pair<PointObserver, MaterialPoint>> observers_;
  std::vector<std::uint32_t> held_;  ///< numbers of the held particles
  Vec load_sum_;                     ///< of gravity and all loads [N/m]
  VecField push_;                    ///< acceleration by walls, if walls act on the solid [m/s2]
  Impulses impulses_;
  std::optional<DetachmentObserver> detachment_;
  HearDetached hear_detached_;
  std::optional<BondWatch> bonds_;
  EnergyWatch energy_;
  long steps_ = 0;
  std::size_t heard_detached_ = 0;  ///< how many were told of
  std::function<void()> restore_;   ///< what `save` kept
};

}  // namespace toryu::solid
