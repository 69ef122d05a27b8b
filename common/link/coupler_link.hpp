/// The coupler's end of the link: it takes both participants in, gives each its turn, and ends the run for
/// all.
#pragma once

#include <memory>
#include <string>

#include "common/link/coupling_port.hpp"

namespace toryu {

class CouplerLink final : public CouplingPort {
 public:
  explicit CouplerLink(const LinkSettings& settings);
  ~CouplerLink() override;

  /// A participant as it introduced itself.
  struct Partner {
    std::string program, version, used_case;
  };
  struct Partners {
    Partner fluid, solid;
  };
  /// Waits for both and checks that they compute the same case in the same units. Throws BadInput that says
  /// what each side said if they differ, PeerLost that names who did not come. Both must be able to repeat a
  /// window if `windows_repeat`.
  Partners gather(bool windows_repeat = false);
  /// Begins the run for both, once gathered.
  CouplingStart begin();

  void grant_fluid(const Window& window, const InterfaceMotion& motion) override;
  FluidAnswer await_fluid(const Window& window) override;
  void grant_solid(const Window& window, const InterfaceLoad& load) override;
  SolidAnswer await_solid(const Window& window) override;

  /// Ends the run for all with `code`, and waits until both have heard it or are gone, a few seconds at most.
  void stop(ExitCode code, const std::string& reason) noexcept;
  /// The same from within a catch block: the exception at hand says why.
  void stop() noexcept;

 private:
  struct Connection;
  std::unique_ptr<Connection> connection_;
};

}  // namespace toryu
