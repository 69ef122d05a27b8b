/// What a coupled run tells of its windows: audits, warnings, the rows of `coupler.csv` and `interface.h5`,
/// and the figures of its summary.
#pragma once

#include <filesystem>
#include <iosfwd>
#include <limits>
#include <optional>
#include <vector>

#include "common/exchange/exchange_file.hpp"
#include "common/loop/schedule.hpp"
#include "common/output/results.hpp"
#include "coupler/added_mass.hpp"
#include "coupler/exchange_audit.hpp"
#include "coupler/interface_record.hpp"
#include "coupler/parameters.hpp"
#include "coupler/schemes.hpp"
#include "coupler/work_audit.hpp"

namespace toryu::coupling {

/// What the case says of the run as a whole.
struct Settings {
  double end_time = 0;                             ///< [s]
  double frame_interval = 0, series_interval = 0;  ///< [s]
  Parameters coupling = {};
  SolidKind solid = SolidKind::elastic;
  std::filesystem::path out = {};  ///< the results folder
  Network network = {};
};

class CoupledRecord {
 public:
  /// `settings` must outlive the record.
  CoupledRecord(const Settings& settings, const CouplingStart& start);

  /// Writes what there is at the start of a run, where the interface moves as `motion`.
  void begin(const InterfaceMotion& motion);
  /// Takes a window that brought `done` and took `elapsed` [s] of wall time. Throws PhysicsFailure if too
  /// many in a row have not converged.
  void note(const Window& window, const Exchange& done, double elapsed);
  /// Writes what is due at `time` [s], the end of the window noted last.
  void write(double time, const Window& window, const Exchange& done);
  /// Writes the window noted last, as far as it was not due: the last state of a run is always there.
  void write_last(double time, const Window& window, const Exchange& done);
  /// Gives the files their final names: no row follows. Throws MachineFailure if that fails.
  void complete();
  /// Puts all that later rows and figures depend on into a checkpoint, and goes on from it at `time` [s], in
  /// the place of the start.
  void write_state(std::ostream& stream);
  void read_state(std::istream& stream, double time);
  /// Adds its figures; the wall time must be in the summary already.
  void report(Summary& summary) const;

  /// Over the windows since the last row of the series.
  struct Row {
    int windows = 0;
    double round_trip = 0, fluid_compute = 0, solid_compute = 0;  ///< sums [s]
    double impulse_error = 0, residual = 0;                       ///< largest
    int iterations = 0;                                           ///< largest
  };
  /// Of the series, under `coupling`: what the exchange `done` of the last `window` and those since the row
  /// before come to.
  static std::vector<Observation> row_of(const Parameters& coupling, const Window& window,
                                         const Exchange& done, const Row& since, const WorkAudit& work);

  struct State {
    ExchangeAudit::State audit;  ///< this and the next of the parts, when a checkpoint is written
    WorkAudit::State work;
    Schedule::State frames_due, series_due;
    SeriesWriter::State series;
    std::optional<InterfaceRecord::State> interface;
    std::optional<ExchangeWriter::State> exchange;
    Row row;
    bool warned_of_impulse = false, warned_of_mass = false, warned_of_work = false;
    double lightest_layer = std::numeric_limits<double>::infinity();  ///< of all windows, over a row of fluid
    std::vector<double> round_trips;                                  ///< one a window [s]
    double fluid_compute = 0, solid_compute = 0;                      ///< sums [s]
    double smallest_window = 0, largest_window = 0;                   ///< [s]
    long iterations = 0, unconverged = 0;                             ///< sum over the windows; windows
    int unconverged_in_a_row = 0;
  };

 private:
  void note_convergence(const Window& window, const Exchange& done);
  void note_times(const Exchange& done, double elapsed);
  void audit(const Window& window, const Exchange& done);
  void audit_work(const Window& window, const Exchange& done);
  void check_added_mass(const Window& window, const InterfaceLoad& load);
  void write_series(double time, const Window& window, const Exchange& done);

  const Settings& settings_;
  FluidTraits fluid_;
  std::size_t interface_count_;
  SurfaceLayer layer_;
  ExchangeAudit audit_;
  WorkAudit work_;
  State state_;
  bool last_row_ = true, last_frame_ = true;  // whether the window noted last is in the files
  Schedule frames_due_, series_due_;
  SeriesWriter series_;
  std::optional<InterfaceRecord> interface_;
  std::optional<ExchangeWriter> exchange_;
};

template <class Archive>
void serialize(Archive& archive, CoupledRecord::Row& row) {
  auto& [windows, round_trip, fluid_compute, solid_compute, impulse_error, residual, iterations] = row;
  archive(windows, round_trip, fluid_compute, solid_compute, impulse_error, residual, iterations);
}

template <class Archive>
void serialize(Archive& archive, CoupledRecord::State& state) {
  auto& [audit, work, frames_due, series_due, series, interface, exchange, row, warned_of_impulse,
         warned_of_mass, warned_of_work, lightest_layer, round_trips, fluid_compute, solid_compute,
         smallest_window, largest_window, iterations, unconverged, unconverged_in_a_row] = state;
  archive(audit, work, frames_due, series_due, series, interface, exchange, row, warned_of_impulse,
          warned_of_mass, warned_of_work, lightest_layer, round_trips, fluid_compute, solid_compute,
          smallest_window, largest_window, iterations, unconverged, unconverged_in_a_row);
}

}  // namespace toryu::coupling
