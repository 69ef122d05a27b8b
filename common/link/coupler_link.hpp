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
    double reach;            ///< of the fluid's kernel [m]
    double time_step_limit;  ///< of the fluid's first step [s]
    Interface interface;
    InterfaceMotion motion;  ///< at the start
  };
  /// Waits for both, checks that they compute the same case in the same units, and joins them. Throws
  /// BadInput that says what each side said if they differ, PeerLost that names who did not come.
  Start gather();

  struct FluidAnswer {
    InterfaceLoad load;
    double time_step_limit;  ///< of the next step [s]
    Health health;
  };
  /// Grants the fluid a window and waits for the load over it.
  FluidAnswer ask_fluid(const Window& window, const InterfaceMotion& motion_at_start);

  struct SolidAnswer {
    InterfaceMotion motion;  ///< at the end of the window
    Vec impulse_taken;       ///< [N s/m]
    Health health;
  };
  /// Gives the solid the load over a window and waits for its motion at the end.
  SolidAnswer ask_solid(const Window& window, const InterfaceLoad& load);

  /// Ends the run for all with `code`, and waits until both have heard it or are gone, a few seconds at most.
  void stop(ExitCode code, const std::string& reason) noexcept;
  /// The same from within a catch block: the exception at hand says why.
  void stop() noexcept;

 private:
  struct Connection;
  std::unique_ptr<Connection> connection_;
};

}  // namespace toryu
