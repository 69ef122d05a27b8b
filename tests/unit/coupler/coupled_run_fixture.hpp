/// A whole run of analytic sides in a folder of its own.
#pragma once

#include <gmock/gmock.h>

#include <map>

#include "common/run/log.hpp"
#include "coupler/coupled_run.hpp"
#include "tests/unit/coupler/analytic_sides.hpp"
#include "tests/unit/coupler/scratch_folder.hpp"

namespace toryu::coupling {

inline Parameters implicit(AccelerationKind relaxation, double factor = 0.5) {
  Parameters coupling;
  coupling.scheme = SchemeKind::serial_implicit;
  coupling.implicit = {.relaxation = relaxation, .relaxation_factor = factor, .tolerance = 1e-6};
  return coupling;
}

inline Parameters explicit_scheme(SchemeKind scheme, int order = 0) {
  Parameters coupling;
  coupling.scheme = scheme;
  coupling.extrapolation_order = order;
  return coupling;
}

class CoupledRunTest : public testing::Test {
 protected:
  CoupledRunTest() { open_log("coupler", "", "info"); }

  /// Runs to `end_time` [s]; returns the summary's figures.
  std::map<std::string, double> run(double end_time, const Parameters& coupling,
                                    const Checkpoints& checkpoints = {}) {
    settings_.end_time = end_time;
    settings_.coupling = coupling;
    settings_.coupling.largest_false_work = largest_false_work_;
    Summary summary;
    summary.wall_time = 1;
    CoupledRun coupled(settings_, sides_);
    testing::internal::CaptureStderr();
    try {
      coupled.run(sides_.start(), checkpoints);
    } catch (...) {
      said_ = testing::internal::GetCapturedStderr();
      throw;
    }
    said_ = testing::internal::GetCapturedStderr();
    coupled.report(summary);
    return {summary.figures.begin(), summary.figures.end()};
  }
  /// How far the mass is from where both sides together would be, over the amplitude.
  double error_at(double time) const {
    return std::abs(sides_.solid.x - sides_.coupled_position(time)) / sides_.coupled_amplitude();
  }
  /// A column of coupler.csv.
  std::vector<double> column(const std::string& name) const {
    std::istringstream lines(folder_.text_of("coupler.csv"));
    std::string line, cell;
    std::getline(lines, line);
    std::istringstream head(line);
    int at = 0;
    while (std::getline(head, cell, ',') && cell != name) ++at;
    std::vector<double> values;
    while (std::getline(lines, line)) {
      std::istringstream cells(line);
      for (int k = 0; k <= at; ++k) std::getline(cells, cell, ',');
      values.push_back(std::stod(cell));
    }
    return values;
  }

  ScratchFolder folder_;
  AnalyticSides sides_;
  std::string said_;                   // in the last run
  double largest_false_work_ = 1e300;  // schemes are seen at work beyond what they bear
  Settings settings_{.out = folder_.path};
};

}  // namespace toryu::coupling
