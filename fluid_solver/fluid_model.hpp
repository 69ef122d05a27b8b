/// What all models of the fluid share: the particles, the walls and the solid's interface, records, observers
/// and checks. A model adds how the state advances.
#pragma once

#include <memory>
#include <optional>

#include "common/run/solver.hpp"
#include "common/run/timers.hpp"
#include "common/scene/fill.hpp"
#include "common/scene/period.hpp"
#include "fluid_solver/boundary.hpp"
#include "fluid_solver/energy_balance.hpp"
#include "fluid_solver/free_surface.hpp"
#include "fluid_solver/neighbours.hpp"
#include "fluid_solver/open_ends/open_ends.hpp"
#include "fluid_solver/parameters.hpp"
#include "fluid_solver/run_watch.hpp"
#include "fluid_solver/suction_watch.hpp"
#include "fluid_solver/surface_record.hpp"
#include "fluid_solver/terms/equation_of_state.hpp"
#include "fluid_solver/wall_frame.hpp"

namespace toryu::fluid {

/// What limits the time step.
struct Extremes {
  double speed = 0, acceleration = 0;  ///< [m/s], [m/s2]
  double viscosity = 0;                ///< of the medium [Pa s]
  double friction_rate = 0;            ///< of the fastest drag by friction, 0 without [1/s]
  double elastic_speed = 0;            ///< of shear waves in a viscoelastic medium, 0 without [m/s]
  double relaxation_rate = 0;          ///< the fastest of such a medium, 0 without [1/s]
  double speed_of_turning = 0;         ///< of walls that turn, 0 without [m/s]
};
template <class Archive>
void serialize(Archive& archive, Extremes& extremes) {
  auto& [speed, acceleration, viscosity, friction_rate, elastic_speed, relaxation_rate, speed_of_turning] =
      extremes;
  archive(speed, acceleration, viscosity, friction_rate, elastic_speed, relaxation_rate, speed_of_turning);
}

/// What of a scene a model fills: a part of a fluid over ranks is given its particles.
enum class Filled { all, walls_alone };

/// What a row looks at beyond the state.
struct Look {
  std::vector<Power> powers = {};
  Penetration penetration = {};
};

class FluidModel : public Solver {
 public:
  /// Fills the regions and the walls of the scene. Throws BadInput if bodies overlap or nothing is filled.
  FluidModel(const Parameters& parameters, const Scene& scene, Filled filled = Filled::all);

  void save() override;
  void restore() override;
  void write_state(std::ostream& stream) const override;
  void read_state(std::istream& stream) override;
  void check(double time) const override;
  Frame frame() const override;
  std::vector<Observation> observe() const override;
  /// A row of surface.h5, where `record_surface` was called. Where the last look is some steps ago, looks at
  /// the powers of the terms and at who is inside walls.
  void record(double time) override;
  /// Warns of suction that the fluid does not bear and, after a look, of all that run_watch.hpp knows.
  void watch(double time) override;
  void complete_records() override;
  std::size_t particle_count() const override { return state_.fluid.count; }

  /// Where the case asks for removal: begins `out`/surface.h5. To be called when all work pieces are there.
  virtual void record_surface(const std::filesystem::path& out);
  /// The same of a part of a fluid, which has no file: another model adds what each step finds.
  void find_surface();
  const std::vector<SurfaceContact>& surface_found() const { return surface_found_; }

  /// From the next step on the fluid, which rank 0 has, is spread over `ranks`: this model holds a part of
  /// it. Forces, impulses, loads and looks are those of the whole on rank 0; what else is summed over
  /// particles is of the part.
  void spread_over(Ranks& ranks);
  /// What the parts of this fluid have to know before the first step, beside its particles.
  struct Begun {
    Extremes largest = {};
    double start_volume = 0, potential_of_moves = 0;
    Neighbours::Begun lists = {};
  };
  template <class Archive>
  friend void serialize(Archive& archive, Begun& begun) {
    auto& [largest, start_volume, potential_of_moves, lists] = begun;
    archive(largest, start_volume, potential_of_moves, lists);
  }
  Begun begun() const;
  /// The same of a model that has walls alone; on rank 0 it is given the `fluid` of another.
  void spread_over(Ranks& ranks, const Begun& begun, Particles fluid);
  /// Of a fluid that is spread, called on all ranks: on rank 0 `whole` gets what is reported, or `all` that
  /// one process has, but for its records, and its lists of neighbours (`list_anew`). Elsewhere `whole` is
  /// null.
  void collect(FluidModel* whole, bool all);
  /// Frees the particles, until they are collected again.
  void forget();
  /// Finds the lists of neighbours again.
  void list_anew();

  // the coupled run's side
  /// How far the kernel sees [m].
  double reach() const { return kernel_.support(); }
  FluidTraits traits() const {
    return {reach(), time_step_limit(), parameters_.density, parameters_.sound_speed, parameters_.spacing};
  }
  /// `rigid`: of a solid that does not deform, and may turn by any angle.
  virtual void attach(const Interface& interface, bool rigid = false);
  /// What it will report once a solid is attached, whose particles nobody has told yet.
  std::vector<Observation> observe_beside_solid();
  virtual void begin_window(const InterfaceMotion& motion, double dt);
  /// The mean load over the window, with the impedance if the motion asked for it.
  virtual InterfaceLoad take_load();

  double time() const { return state_.time; }
  std::optional<Frame> walls() const override { return frame_of_walls(state_.boundaries); }
  bool walls_move() const override { return any_wall_moves(state_.boundaries); }
  double kinetic_energy() const;
  /// Of gravity and of a central force; where space repeats itself, as if it went on [J per metre].
  double potential_energy() const;
  double elastic_energy() const;  ///< of compression [J per metre]
  double mass() const;            ///< [kg per metre]
  /// Mean density by the room that the particles have, whatever their own say [kg/m3].
  virtual double density_of_packing() const;
  Vec momentum() const;
  /// What the press adds to the pressure of an enclosed medium [Pa].
  double pressure_offset() const;
  /// Whether the fluid has no free surface as it stands.
  bool is_enclosed();
  /// What each term of the case takes from these energies.
  virtual std::vector<Power> powers() = 0;
  virtual Look look();
  const Particles& particles() const { return state_.fluid; }
  const std::optional<OpenEnds>& open_ends() const { return state_.open_ends; }
  const std::vector<Boundary>& boundaries() const { return state_.boundaries; }
  /// Where rows of the fluid do not fit between faces.
  const std::vector<Misfit>& misfits() const { return misfits_; }
  virtual const Timers& timers() const { return timers_; }
  long list_builds() const { return state_.neighbours.builds(); }

  /// Rows may be nearer to each other; a look costs about half a step.
  static constexpr long steps_between_looks = 10;

 protected:
  /// All that a step, a window or an observer changes. The lists are among it: what is summed in another
  /// order rounds otherwise. A model that has more to keep adds it here.
  struct State {
    double time = 0;  ///< [s]
    Particles fluid = {};
    std::vector<Boundary> boundaries = {};
    Neighbours neighbours;
    Vec gravity_impulse = Vec::Zero();  ///< since the start [N.s per metre]
    double work_of_gravity_change = 0;  ///< likewise [J per metre]
    /// What moves by a period have taken from the sum over places [J per metre].
    double potential_of_moves = 0;
    EnergyBalance balance = {};
    Penetration penetration = {};                     ///< at the last look
    long steps_since_look = steps_between_looks - 1;  ///< the first one follows the first step
    Extremes largest = {};
    bool density_rate_known = false;  ///< of the symplectic step, from the last one
    bool contact_changed = false;     ///< since then: the velocity at the interface
    bool impedance_wanted = false;    ///< with the load of the present window
    bool beyond_measured = false;     ///< whether it was told that the medium is sheared too fast
    std::optional<SurfaceRecord> surface_record = {};
    std::optional<SuctionWatch> suction_watch = {};
    std::optional<RunWatch> run_watch = {};
    std::optional<OpenEnds> open_ends = {};
  };
  template <class Archive>
  friend void serialize(Archive& archive, State& state) {
    auto& [time, fluid, boundaries, neighbours, gravity_impulse, work_of_gravity_change, potential_of_moves,
           balance, penetration, steps_since_look, largest, density_rate_known, contact_changed,
           impedance_wanted, beyond_measured, surface_record, suction_watch, run_watch, open_ends] = state;
    archive(time, fluid, boundaries, neighbours, gravity_impulse, work_of_gravity_change, potential_of_moves,
            balance, penetration, steps_since_look, largest, density_rate_known, contact_changed,
            impedance_wanted, beyond_measured, *run_watch);
    if (surface_record) archive(*surface_record);
    if (open_ends) archive(*open_ends);
    bool watched = suction_watch.has_value();  // until it has warned
    archive(watched);
    if (!watched) suction_watch.reset();
    if (suction_watch) archive(*suction_watch);
  }

  /// What `read_state` does but for the lists.
  void take_state(std::istream& stream);
  /// Sorts and lists anew if a step of `dt` [s] may exhaust the skin.
  void update_neighbours(double dt);
  void move_boundaries(double time);
  /// Walls that are pressed take the reaction of the last evaluation, in a step of `dt` [s] by explicit sums.
  void push_pressed_walls(double dt);
  virtual void find_off_surface();
  /// Counts what the last evaluation is about to do in `dt` [s], so that the sum is the change of momentum to
  /// rounding.
  void count_forces(double dt);
  void collect_at(Boundary& boundary);  ///< of a fluid that is spread

  Parameters parameters_;
  Scene scene_;
  Kernel kernel_;
  EquationOfState equation_of_state_;
  Period period_;
  State state_;
  FreeSurface free_surface_;
  Timers timers_;
  Ranks* ranks_ = nullptr;                          ///< over which the fluid is spread
  std::vector<SurfaceContact> surface_found_ = {};  ///< by the last step, of such a fluid
  double start_volume_ = 0;  ///< sum_i m_i/rho_i, where it is held [m2; about an axis m3]

 private:
  int reaches_of_ghosts() const;
  void collect_fluid(Particles* whole, bool all);
  void fill_regions();
  void start_flow(std::size_t particle);
  PressedMotion pressed(const Wall& wall, const std::vector<Vec>& points) const;
  void fill_walls();
  void check_overlaps() const;
  void leave_out_walls_in(const Boundary& solid, double spacing);
  void move_back_into_domain();
  void refuse_in_layers(const std::vector<Vec>& points) const;
  void watch_suction(double time);
  void watch_stops(double time);
  void watch_shear(double time);
  MovingInterface& interface();
  void let_through_open_ends();
  /// Of all particles that are not in the layers of open ends.
  template <class Of, class Value = double>
  Value sum_inside(Of&& of_particle, Value sum = 0) const {
    for (std::size_t i = 0; i < state_.fluid.count; ++i)
      if (state_.fluid.is_inside(i)) sum += of_particle(i);
    return sum;
  }
  template <class Visit>
  void for_each_open_end(Visit&& visit) const {
    for (std::size_t end = 0; state_.open_ends && end < state_.open_ends->size(); ++end)
      visit(*state_.open_ends, end);
  }
  /// Energy over mass at `x` [m2/s2].
  double potential(const Vec& x) const;
  /// Of an acceleration of all the fluid, over a step of `dt` [s] that is about to be made [W per metre].
  double power_of(const Vec& change, double dt) const;
  double energy() const { return kinetic_energy() + potential_energy() + elastic_energy(); }
  /// By how much the energy has changed beyond the work of the boundaries [J per metre].
  double energy_gained() const;
  double mean_density() const;  ///< by mass over volume [kg/m3]
  RunFigures run_figures(double time) const;
  /// What no force gave the fluid: shifting, tensile control, consistent gradients [N.s per metre].
  Vec numerical_impulse() const;
  void check_particle(std::size_t particle, double time, double least_density, double most_density,
                      double top_speed) const;
  [[noreturn]] void fail(std::size_t particle, double time, const std::string& quantity, double value,
                         const std::string& limit) const;

  Vec start_momentum_ = Vec::Zero();
  double start_energy_ = 0, start_potential_ = 0;  ///< [J per metre]
  std::vector<Misfit> misfits_;
  std::vector<double> rigid_interface_;  ///< positions at the start; empty: the solid deforms [m]
  std::optional<State> saved_;
};

/// The model that the case asks for.
std::unique_ptr<FluidModel> make_model(const Parameters& parameters, const Scene& scene);

}  // namespace toryu::fluid
