/// A fluid case of the project, run inside the test, so that every particle can be looked at.
#pragma once

#include "common/case/case_file.hpp"
#include "common/scene/bodies.hpp"
#include "fluid_solver/wall_rows.hpp"
#include "fluid_solver/weakly_compressible/weakly_compressible.hpp"
#include "tests/one_thread.hpp"

namespace toryu::fluid {

struct FluidCase {
  /// `overrides` as after --set: "fluid.spacing=0.1".
  explicit FluidCase(const std::string& name, const std::vector<std::string>& overrides = {})
      : FluidCase(CaseFile(std::string(CASES "/") + name, overrides)) {}
  WeaklyCompressible solver() const { return WeaklyCompressible(parameters, scene); }

  Scene scene;
  Parameters parameters;

 private:
  explicit FluidCase(CaseFile file) : scene(read_scene(file)) {
    file.ignore_sections({"solid", "coupling"});
    file.read("fluid", parameters, "");
    file.throw_if_faulty();
    leave_out(left_out_of_fluid(file, scene), parameters);
    complete_medium(parameters);
    if (parameters.similarity) make_similar(parameters, scene);
  }
};

inline void run_until(FluidModel& solver, double end) {
  while (solver.time() < end - 1e-12) solver.advance(std::min(solver.time_step_limit(), end - solver.time()));
}

}  // namespace toryu::fluid
