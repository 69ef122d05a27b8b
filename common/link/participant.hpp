/// The public interface of a participant: all that a fluid or a solid model needs to take its place in a
/// coupled run. `tests/participants/` has two short programs on it that serve as templates.
///
///     FluidLink link({.role = "fluid_solver", ...});     // or SolidLink
///     try {
///       link.join(...);                                  // handshake with the coupler, within a time limit
///       ... link.restart(): take the state from that checkpoint ...
///       while (auto turn = link.next_turn()) {           // blocks; empty at the end of the run
///         if (turn->task == Task::checkpoint) {          // only if it said that it can
///           link.confirm_checkpoint([&] { ... write the state into turn->checkpoint ... });
///           continue;
///         }
///         ... turn->iteration > 0: back to the start of this window; else keep it for that ...
///         ... turn->motion ... advance by turn->dt, link.count_step() after each step ...
///         link.send(load, time_step_limit, health);
///       }
///     } catch (...) {
///       link.leave();                                    // the others learn why, and end alike
///       throw;
///     }
///
/// Every wait has a limit and ends on an interruption; a peer that died, hung or sent nonsense is a PeerLost
/// that names it. A physics failure of another participant arrives as PhysicsFailure, an interruption of
/// another as Interrupted, a refusal by the coupler as BadInput. When this process is interrupted, the wish
/// is passed on to the coupler, which ends the run for all; a second signal ends a wait at once.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "common/error/failure.hpp"
#include "common/run/network.hpp"
#include "common/vector.hpp"

namespace toryu {

/// The k-th of vectors that lie one after the other, dim values each.
inline Vec vector_of(const std::vector<double>& values, std::size_t k) {
  return Vec(Eigen::Map<const Vec>(values.data() + dim * k));
}

/// The solid's particles that the fluid may touch, in the reference configuration; registered once.
struct Interface {
  std::vector<std::uint32_t> id;    ///< the solid's particle numbers
  std::vector<double> position;     ///< dim values a particle [m]
  std::vector<double> volume;       ///< [m2 per metre depth]
  std::vector<double> area_vector;  ///< outward, dim values [m per metre depth]; zero inside
  std::vector<double> mass;         ///< [kg per metre depth]
  double spacing = 0;               ///< [m]
  std::size_t size() const { return id.size(); }
};

/// Kinematics of the interface at one time, dim values a particle.
struct InterfaceMotion {
  std::vector<double> position, velocity;  ///< [m], [m/s]
  /// From the solid, what it took beyond the force of the load, by the load's impedance; to the fluid, what
  /// it is to give when the window starts [N s per metre depth]. Empty where the scheme does without: only a
  /// motion with it asks the fluid for an impedance, and has the copy start where `velocity` comes from.
  std::vector<double> impulse = {};
  double work_of_impulse = 0;  ///< from the solid: what that impulse did to it [J per metre]
};

/// What the fluid does to the interface, averaged over a window.
struct InterfaceLoad {
  std::vector<double> pressure;        ///< one value a particle [Pa]
  std::vector<double> force;           ///< pressure and viscous force, dim values [N per metre depth]
  std::vector<double> friction_force;  ///< dim values [N per metre depth]; empty if the scene has no friction
  /// Impulse that the fluid itself received from the interface over the window, summed on its side [N s per
  /// metre].
  Vec impulse_on_fluid = Vec::Zero();
  double work_of_impulse = 0;  ///< what the impulse of the motion did to the fluid [J per metre]
  /// How the fluid answers the interface's normal velocity: rho c_0 times the area that a particle bears,
  /// along its outward normal n, dim values [kg/(s.m)]. A particle at v feels `force` + n z n.(velocity - v),
  /// z the length. Empty where the scheme does without.
  std::vector<double> impedance = {};
  std::vector<double> velocity = {};  ///< of the fluid's copy of the interface; goes with the impedance [m/s]
};

/// A coupling window granted by the coupler. Iteration 0 takes the one before as it stands; with a higher
/// one the participant goes back to the start of this window and computes it again.
struct Window {
  std::uint64_t number = 0;
  std::uint32_t iteration = 0;
  double time = 0;  ///< start [s]
  double dt = 0;    ///< length [s]
};

/// What the coupler asks for in a turn: to compute a window, or to write a checkpoint. The window of a
/// checkpoint is the last one, which stands as it is.
enum class Task { window, checkpoint };
struct Turn : Window {
  Task task = Task::window;
  std::filesystem::path checkpoint = {};  ///< folder for this participant's part, if that is the task
};

/// What a participant says of itself in each status message, for coupler.csv and the report.
struct Health {
  double kinetic_energy = 0, potential_energy = 0;  ///< [J per metre]
  Vec momentum = Vec::Zero();                       ///< [N s per metre]
  double compute_time = 0;  ///< wall time from the grant to send [s]; measured by the link itself
};

struct LinkSettings {
  std::string role;           ///< name of the program, as others shall see it: "fluid_solver"
  std::string version;        ///< of the program
  std::filesystem::path out;  ///< the results folder: its run.secret names the run
  Network network = {};       ///< how the other processes are reached
  std::uint64_t case_hash = 0;
  double time_limit = 30;       ///< longest wait for the coupler to come [s]; from then on the case's counts
  bool can_repeat = false;      ///< whether this participant can go back to the start of a window
  bool can_checkpoint = false;  ///< whether it can write its part of a checkpoint and go on from it
  std::string used_case = {};   ///< this participant's sections with defaults, for used_case.toml
};

/// What the coupler must know of a fluid.
struct FluidTraits {
  double reach = 0;            ///< how deep its kernel sees into the solid [m]
  double time_step_limit = 0;  ///< bounds the first window [s]
  double density = 0;          ///< at rest [kg/m3]
  double sound_speed = 0;      ///< [m/s]
  double spacing = 0;          ///< [m]
};

class FluidLink {
 public:
  explicit FluidLink(const LinkSettings& settings);
  ~FluidLink();
  /// Registers with the coupler and returns the solid's interface.
  Interface join(const FluidTraits& traits);
  /// Whether windows of this run may be repeated; known once joined.
  bool windows_repeat() const;
  /// Folder of the checkpoint from which the run goes on, empty if it begins anew; known once joined.
  std::filesystem::path restart() const;
  struct Turn : toryu::Turn {
    /// To which position the interface is to be brought by the end of the window. The velocity is that of
    /// the way there; it counts in the first window, for where the way begins.
    InterfaceMotion motion;
  };
  /// Blocks until the coupler asks for something; empty when the run is over in good order.
  std::optional<Turn> next_turn();
  /// Answers the window: the load over it, and the longest step [s] the fluid may take next.
  void send(const InterfaceLoad& load, double time_step_limit, const Health& health);
  /// Answers the task to write a checkpoint: calls `write`, and tells the coupler that it is done, or what it
  /// threw. A part that cannot be written costs the checkpoint, not the run.
  void confirm_checkpoint(const std::function<void()>& write);
  /// To be called after each step within a window: a participant that neither steps nor answers for the
  /// case's time limit counts as hung. Also notices here that the coupler is gone; costs next to nothing.
  void count_step();
  /// Tells the coupler why this side stops (physics failure, interruption, bug); never throws.
  void leave(ExitCode code, const std::string& reason) noexcept;
  /// The same from within a catch block: the exception at hand says why.
  void leave() noexcept;
  double waiting_time() const;  ///< [s] waited for the others so far, the start included

 private:
  struct Connection;
  std::unique_ptr<Connection> connection_;
};

class SolidLink {
 public:
  explicit SolidLink(const LinkSettings& settings);
  ~SolidLink();
  /// Returns the fluid's reach [m], by which the solid chooses the particles of its interface.
  double join();
  /// This and what follows as those of FluidLink.
  bool windows_repeat() const;
  std::filesystem::path restart() const;
  /// Once, after join: the particles that the fluid may touch and where they start.
  void register_interface(const Interface& interface, const InterfaceMotion& at_start);
  struct Turn : toryu::Turn {
    InterfaceLoad load;  ///< constant over the window
  };
  std::optional<Turn> next_turn();
  /// `impulse_taken`: sum of load times sub-step over the window as this side applied it [N s per metre].
  void send(const InterfaceMotion& motion_at_end, const Vec& impulse_taken, const Health& health);
  void confirm_checkpoint(const std::function<void()>& write);
  void count_step();
  void leave(ExitCode code, const std::string& reason) noexcept;
  void leave() noexcept;
  double waiting_time() const;

 private:
  struct Connection;
  std::unique_ptr<Connection> connection_;
};

}  // namespace toryu
