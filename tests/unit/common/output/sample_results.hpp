/// Three particles and their results, by hand, shared by the test in C++ and the one in Python.
#pragma once

#include "common/output/results.hpp"
#include "common/run/provenance.hpp"

namespace toryu::sample {

inline const Provenance provenance{"0.1.0", "abc1234", "GNU 12.2", "-O3", "some \"cpu\"", 2};

inline Frame frame() {
  Frame frame;
  frame.positions = {0.0, 0.1, 1.0, 1.1, 2.0, 2.0 + 1e-12};
  frame.fields = {{"pressure", "Pa", "thermodynamic pressure", 1, {10.0, -20.0, 30.5}},
                  {"velocity", "m/s", "", 2, {1.0, 2.0, 3.0, 4.0, 5.0, 6.0}},
                  {"stress", "Pa", "Cauchy stress", 4, {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12}}};
  return frame;
}

inline Summary summary() {
  Summary s;
  s.participant = "fluid";
  s.provenance = provenance;
  s.exit_code = ExitCode::physics_failed;
  s.end_reason = "particle 7: \"speed\" = 1e3\n\tbeyond C:\\limit \x01";
  s.simulated_time = 2;
  s.wall_time = 1e-7;
  s.waiting_time = 0.25;
  s.processor_time = 3.5;
  s.steps = 100;
  s.smallest_time_step = std::numeric_limits<double>::infinity();
  s.largest_time_step = std::numeric_limits<double>::quiet_NaN();
  s.time_step_rule = "acoustic";
  s.particles = {{"fluid", 3}, {"wall tank_floor", 320}};
  s.figures = {{"largest_impulse_error", 1.5e-16}, {"windows", 40}};
  s.terms = {{"gravity", "g", "-", "g (0, -9.81)"}, {"pressure", "-grad p / ρ", "eq. 4", ""}};
  s.parts = {{"density gradient", 1.25, 200}};
  return s;
}

}  // namespace toryu::sample
