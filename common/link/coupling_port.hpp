/// Both participants as a coupling scheme sees them: each is granted a window and answers it. CouplerLink has
/// them in processes of their own; a test of a scheme may have a mass on a spring.
#pragma once

#include "common/link/participant.hpp"

namespace toryu {

/// What the coupling is of, as both participants told it before the first window.
struct CouplingStart {
  FluidTraits traits;
  Interface interface;
  InterfaceMotion motion;  ///< of the interface at the start
};

struct FluidAnswer {
  InterfaceLoad load;
  double time_step_limit = 0;  ///< of the next step [s]
  Health health;
};

struct SolidAnswer {
  InterfaceMotion motion;           ///< at the end of the window
  Vec impulse_taken = Vec::Zero();  ///< [N s/m]
  Health health;
};

class CouplingPort {
 public:
  virtual ~CouplingPort() = default;

  /// Grants the fluid a window, in which it brings the interface to where `motion` says.
  virtual void grant_fluid(const Window& window, const InterfaceMotion& motion) = 0;
  /// Waits for the load over the window granted. This and the following throw PhysicsFailure or PeerLost,
  /// which name the participant, if the answer is not fit for use or does not come.
  virtual FluidAnswer await_fluid(const Window& window) = 0;
  FluidAnswer ask_fluid(const Window& window, const InterfaceMotion& motion) {
    grant_fluid(window, motion);
    return await_fluid(window);
  }

  /// Grants the solid a window under `load`.
  virtual void grant_solid(const Window& window, const InterfaceLoad& load) = 0;
  /// Waits for its motion at the end of the window granted.
  virtual SolidAnswer await_solid(const Window& window) = 0;
  SolidAnswer ask_solid(const Window& window, const InterfaceLoad& load) {
    grant_solid(window, load);
    return await_solid(window);
  }

  /// Lets both write their part of a checkpoint, at the end of `window`, the last one; `folder` is that of
  /// the checkpoint, in the results folder. Returns what each of them that could not says of it.
  virtual std::vector<std::string> write_checkpoint(const Window& window, const std::string& folder) = 0;
  /// Whether a participant was asked to stop.
  virtual bool interrupted() const = 0;
};

}  // namespace toryu
