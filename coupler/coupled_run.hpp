/// A coupled run, window after window: each is computed as the scheme of the case says (schemes.hpp), then
/// audited and recorded.
#pragma once

#include <limits>
#include <optional>

#include "common/link/coupler_link.hpp"
#include "common/output/results.hpp"
#include "common/run/progress.hpp"
#include "common/run/timers.hpp"
#include "coupler/added_mass.hpp"
#include "coupler/exchange_audit.hpp"
#include "coupler/interface_record.hpp"
#include "coupler/parameters.hpp"
#include "coupler/schemes.hpp"
#include "coupler/work_audit.hpp"

namespace toryu::coupling {

/// Length [s] of the window that starts `left` [s] before the end of the run: at most `steps` fluid steps of
/// `limit` [s], and the last two windows alike rather than a whole one and a splinter.
double window_length(double left, int steps, double limit);

/// Says when something that happens each `interval` [s] is due; each time if the interval is 0.
class Due {
 public:
  explicit Due(double interval) : interval_(interval) {}
  bool at(double time);

 private:
  double interval_;
  long next_ = 1;
};

class CoupledRun {
 public:
  struct Settings {
    double end_time, frame_interval, series_interval;  ///< [s]
    Parameters coupling;
    std::filesystem::path out;
  };
  CoupledRun(Settings settings, CouplerLink& link);

  /// Runs all windows to the end.
  void run(const CouplerLink::Start& start);
  /// What is known of the run so far; the wall time must be in the summary already.
  void report(Summary& summary) const;

 private:
  void advance();
  void check_added_mass(const InterfaceLoad& load);
  void audit(const Exchange& done);
  void audit_work(const Exchange& done);
  void note_times(const Exchange& done, double elapsed);
  void note_convergence(const Exchange& done);
  void write_series(const Exchange& done);

  Settings settings_;
  CouplerLink& link_;
  std::unique_ptr<Scheme> scheme_;
  double time_ = 0, time_step_limit_ = 0;  // [s]
  Window window_;
  ExchangeAudit audit_;
  std::optional<WorkAudit> work_;
  bool warned_ = false;
  FluidTraits fluid_;
  std::size_t interface_count_ = 0;
  std::optional<SurfaceLayer> layer_;
  double lightest_layer_ = std::numeric_limits<double>::infinity();  // of all windows, over a row of fluid
  bool warned_of_mass_ = false, warned_of_work_ = false;
  Timers timers_;
  std::vector<double> round_trips_;                  // one a window [s]
  double fluid_compute_ = 0, solid_compute_ = 0;     // [s], sums over the run
  double smallest_window_ = 0, largest_window_ = 0;  // [s]
  long iterations_ = 0, unconverged_ = 0;            // sum over the windows; windows
  int unconverged_in_a_row_ = 0;

  std::optional<InterfaceRecord> record_;
  std::optional<SeriesWriter> series_;
  Due frame_due_, series_due_;

  /// Over the windows since the last row of the series.
  struct Row {
    int windows = 0;
    double round_trip = 0, fluid_compute = 0, solid_compute = 0;  // [s], sums
    double impulse_error = 0, residual = 0;                       // largest
    int iterations = 0;                                           // largest
  } row_;
};

}  // namespace toryu::coupling
