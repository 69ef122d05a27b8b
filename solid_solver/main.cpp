/// The solid participant: computes the elastic body of a case, alone or in turn with a fluid.
#include <fmt/format.h>
#include <omp.h>
#include <spdlog/spdlog.h>

#include "common/run/ending.hpp"
#include "common/output/atomic_file.hpp"
#include "common/run/program.hpp"
#include "solid_solver/make_model.hpp"
#include "solid_solver/run_alone.hpp"
#include "solid_solver/run_coupled.hpp"

namespace {

using namespace toryu;

void compute_alone(const Options& options, const CaseFile& file, const Scene& scene, SolidModel& model) {
  write_atomically(options.out / "used_case.toml", file.used());
  SolidRun run(options, scene, model);
  try {
    run_alone(scene, run);
  } catch (...) {
    const Ending ending = ending_of_exception();
    run.finish(ending.code, ending.reason, 0);
    throw;
  }
  run.finish(ExitCode::done, "", 0);
}

void compute_coupled(const Options& options, const CaseFile& file, const Scene& scene, SolidModel& model) {
  SolidRun run(options, scene, model);
  SolidLink link({.role = "solid_solver",
                  .version = provenance(1).version,
                  .out = options.out,
                  .case_hash = file.hash(),
                  .used_case = file.used()});
  try {
    run_coupled(link, run);
  } catch (...) {
    link.leave();
    const Ending ending = ending_of_exception();
    run.finish(ending.code, ending.reason, link.waiting_time());
    throw;
  }
  run.finish(ExitCode::done, "", link.waiting_time());
}

ExitCode solve(const Options& options) {
  CaseFile file(options.case_path, options.overrides);
  const Scene scene = read_scene(file);
  SolidParameters parameters;
  file.read("solid", parameters, "an elastic body in plane strain");
  file.leave_to_others({"fluid", "coupling"});
  if (options.describe) {
    fmt::print("{}", file.description());
    return ExitCode::done;
  }
  file.throw_if_faulty();
  const auto tell_fault = [&](const std::string& key, const std::string& message) {
    file.fault(key, message);
  };
  const SolidBody body = build_body(parameters, tell_fault);
  file.throw_if_faulty();
  if (options.check) return ExitCode::done;

  omp_set_num_threads(options.threads > 0 ? options.threads : omp_get_num_procs());
  const auto model = make_model(parameters, body, scene);
  if (file.has("fluid")) {
    compute_coupled(options, file, scene, *model);
  } else {
    compute_alone(options, file, scene, *model);
  }
  return ExitCode::done;
}

}  // namespace

int main(int argc, char** argv) {
  return toryu::run_program("solid_solver", argc, argv, solve);
}
