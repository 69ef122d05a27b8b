/// One side of a coupled run as it was recorded: what it answers to a window of another run.
#pragma once

#include "common/case/case_file.hpp"
#include "common/exchange/exchange_file.hpp"

namespace toryu::replay {

class Recording {
 public:
  /// Of the run in the folder `results`. Throws BadInput if it is not there or ends before the case does.
  Recording(const std::filesystem::path& results, const CaseFile& file);

  const CouplingStart& start() const { return record_.start(); }
  /// Throws BadInput if that is not the interface to which the recorded load belongs.
  void check(const Interface& interface) const;
  /// Throws BadInput if a fluid that reaches so deep [m] would miss particles of the recorded interface.
  void check_reach(double reach) const;

  /// The recorded load: of a window that was recorded as it stands, of another one its mean over it, so that
  /// the impulse is the same. `returned` is the impulse that the motion asks the fluid to give [N s/m].
  FluidAnswer fluid_over(const Window& window, const std::vector<double>& returned);
  /// The recorded motion at the end of a window: where none ended there, between the two ends about it by the
  /// cubic that has their positions and velocities. Whatever the load, it is said to have been taken.
  SolidAnswer solid_over(const Window& window, const InterfaceLoad& load);

 private:
  const InterfaceMotion& motion_before(std::size_t number);
  FluidAnswer mean_over(const Window& window);
  InterfaceMotion motion_within(std::size_t number, double time);
  /// Calls add(window, share) for all recorded windows that share time with this one; the share is theirs.
  template <class Add>
  void over(const Window& window, const Add& add);

  ExchangeReader record_;
};

}  // namespace toryu::replay
