/// The coupler's end of the link: it takes both participants in, gives each its turn, and ends the run for
/// all.
#pragma once

#include <memory>
#include <string>

#include "common/link/participant.hpp"

namespace toryu {

class CouplerLink {
 public:
  explicit CouplerLink(const LinkSettings& settings);
  ~CouplerLink();

  /// A participant as it introduced itself.
  struct Partner {
    std::string program, version, used_case;
  };
  struct Start {
    Partner fluid, solid;
    FluidTraits traits;  ///< of the fluid
    Interface interface;
    InterfaceMotion motion;  ///< at the start
  };
  /// Waits for both, checks that they compute the same case in the same units, and joins them. Throws
  /// BadInput that says what each side said if they differ, PeerLost that names who did not come. Both must
  /// be able to repeat a window if `windows_repeat`.
  Start gather(bool windows_repeat = false);

  struct FluidAnswer {
    InterfaceLoad load;
    double time_step_limit;  ///< of the next step [s]
    Health health;
  };
  /// Grants the fluid a window, in which it brings the interface to where `motion` says.
  void grant_fluid(const Window& window, const InterfaceMotion& motion);
  /// Waits for the load over the window granted.
  FluidAnswer await_fluid(const Window& window);
  FluidAnswer ask_fluid(const Window& window, const InterfaceMotion& motion) {
    grant_fluid(window, motion);
    return await_fluid(window);
  }

  struct SolidAnswer {
    InterfaceMotion motion;  ///< at the end of the window
    Vec impulse_taken;       ///< [N s/m]
    Health health;
  };
  /// Grants the solid a window under `load`.
  void grant_solid(const Window& window, const InterfaceLoad& load);
  /// Waits for its motion at the end of the window granted.
  SolidAnswer await_solid(const Window& window);
  SolidAnswer ask_solid(const Window& window, const InterfaceLoad& load) {
    grant_solid(window, load);
    return await_solid(window);
  }

  /// Ends the run for all with `code`, and waits until both have heard it or are gone, a few seconds at most.
  void stop(ExitCode code, const std::string& reason) noexcept;
  /// The same from within a catch block: the exception at hand says why.
  void stop() noexcept;

 private:
  struct Connection;
  std::unique_ptr<Connection> connection_;
};

}  // namespace toryu
