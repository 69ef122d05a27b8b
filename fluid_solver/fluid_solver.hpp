/// The weakly compressible delta-SPH fluid: state, boundaries and the time step.
#pragma once

#include <memory>
#include <optional>

#include "common/run/solver.hpp"
#include "common/run/timers.hpp"
#include "fluid_solver/dynamics.hpp"
#include "fluid_solver/free_surface.hpp"
#include "fluid_solver/interface.hpp"
#include "fluid_solver/neighbours.hpp"
#include "fluid_solver/period.hpp"
#include "fluid_solver/shifting.hpp"
#include "fluid_solver/suction_watch.hpp"
#include "fluid_solver/surface_record.hpp"

namespace toryu::fluid {

/// What limits the time step.
struct Extremes {
  double speed = 0, acceleration = 0;  ///< [m/s], [m/s2]
  double viscosity = 0;                ///< of the medium [Pa s]
  double friction_rate = 0;            ///< of the fastest drag by friction, 0 without [1/s]
};

class FluidSolver : public Solver {
 public:
  /// Fills the regions and the walls of the scene. Throws BadInput if bodies overlap or nothing is filled.
  FluidSolver(const Parameters& parameters, const Scene& scene);

  double time_step_limit() const override;
  std::string_view time_step_rule() const override;
  /// A step by the integrator of the case.
  void advance(double dt) override;
  void save() override;
  void restore() override { restore_(); }
  void write_state(std::ostream& stream) const override;
  void read_state(std::istream& stream) override;
  void check(double time) const override;
  Frame frame() const override;
  std::vector<Observation> observe() const override;
  /// A row of surface.h5, where `record_surface` was called. Warns of suction that the fluid does not bear.
  void record(double time) override;
  std::vector<ActiveTerm> active_terms() const override { return dynamics_.active_terms(); }
  std::size_t particle_count() const override { return fluid_.count; }

  /// Where the case asks for removal: begins `out`/surface.h5. To be called when all work pieces are there.
  void record_surface(const std::filesystem::path& out);

  // the coupled run's side
  /// How far the kernel sees [m].
  double reach() const { return dynamics_.kernel().support(); }
  FluidTraits traits() const {
    return {reach(), time_step_limit(), parameters_.density, parameters_.sound_speed, parameters_.spacing};
  }
  void attach(const Interface& interface);
  void begin_window(const InterfaceMotion& motion, double dt);
  InterfaceLoad take_load() { return interface_.take_load(); }

  double time() const { return time_; }
  double kinetic_energy() const;
  double potential_energy() const;  ///< against gravity [J per metre]
  double elastic_energy() const;    ///< of compression [J per metre]
  Vec momentum() const;
  const Particles& particles() const { return fluid_; }
  const std::vector<Boundary>& boundaries() const { return boundaries_; }
  Timers& timers() { return timers_; }
  long list_builds() const { return neighbours_.builds(); }

 private:
  /// The state at the start of a midpoint step.
  struct Start {
    VecField x, v;
    Field rho;
  };
  void fill_regions();
  void start_flow(std::size_t particle);
  void fill_walls();
  void check_overlaps() const;
  void move_boundaries(double time);
  void move_back_into_domain();
  void update_neighbours(double dt);
  void step_midpoint(double dt);
  void step_symplectic(double dt);
  void advance_from(const Start& start, double dt);
  void accumulate_reaction(double dt);
  void shift(double dt);
  void note_surface(double dt);
  void watch_suction(double time);
  void count_impulses(double dt);
  /// What no force gave the fluid: shifting, tensile control, consistent gradients [N.s per metre].
  Vec numerical_impulse() const;
  void note_extremes();
  [[noreturn]] void fail(std::size_t particle, double time, const std::string& quantity, double value,
                         const std::string& limit) const;

  Parameters parameters_;
  Scene scene_;
  Dynamics dynamics_;
  Period period_;
  Neighbours neighbours_;
  Particles fluid_;
  std::vector<Boundary> boundaries_;
  std::vector<const Wall*> moving_walls_;     ///< boundary b's, null where it stands still
  std::vector<std::vector<Vec>> wall_start_;  ///< where moving walls' particles began
  std::vector<ForceOnFluid> given_;
  /// Impulse since the start [N.s per metre] that boundary b gave the fluid, and the friction's share of it.
  struct Impulse {
    Vec total = Vec::Zero(), friction = Vec::Zero();
  };
  std::vector<Impulse> impulses_;
  Vec gravity_impulse_ = Vec::Zero(), start_momentum_ = Vec::Zero();
  Start start_;  ///< kept from step to step for its memory
  FreeSurface free_surface_;
  std::optional<Shifting> shifting_;
  bool density_rate_known_ = false;  ///< of the symplectic step, from the last one
  std::optional<SurfaceRecord> surface_record_;
  std::optional<SuctionWatch> suction_watch_;
  std::optional<std::size_t> interface_boundary_;
  MovingInterface interface_;
  double time_ = 0;
  Extremes largest_;
  Timers timers_;
  std::function<void()> restore_;  ///< what `save` kept
};

}  // namespace toryu::fluid
