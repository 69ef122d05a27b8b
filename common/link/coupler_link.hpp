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
    bool can_checkpoint = false;
  };
  struct Partners {
    Partner fluid, solid;
  };
  /// What both must be able to do.
  struct Requirements {
    bool windows_repeat = false;  ///< go back to the start of a window
    bool restart = false;         ///< go on from a checkpoint
  };
  /// Waits for both and checks that they compute the same case in the same units and meet the requirements.
  /// Throws BadInput that says what each side said if not, PeerLost that names who did not come.
  Partners gather(const Requirements& requirements);
  /// What is known of a run once both were gathered.
  struct Beginning {
    bool checkpoints = false;  ///< whether any will be written
    std::string restart = {};  ///< the one from which the run goes on, in the results folder; or empty
  };
  /// Begins the run for both, once gathered.
  CouplingStart begin(const Beginning& beginning);

  void grant_fluid(const Window& window, const InterfaceMotion& motion) override;
  FluidAnswer await_fluid(const Window& window) override;
  void grant_solid(const Window& window, const InterfaceLoad& load) override;
  SolidAnswer await_solid(const Window& window) override;
  std::vector<std::string> write_checkpoint(const Window& window, const std::string& folder) override;
  bool interrupted() const override;

  /// Ends the run for all with `code`, and waits until both have heard it or are gone, a few seconds at most.
  void stop(ExitCode code, const std::string& reason) noexcept;
  /// The same from within a catch block: the exception at hand says why.
  void stop() noexcept;

 private:
  struct Connection;
  std::unique_ptr<Connection> connection_;
};

}  // namespace toryu
