/// The compiled part of `toryu.participant`: a program in the place of fluid_solver or solid_solver whose
/// model is written in Python. Link, record, checkpoints and endings are those of the other programs.
#include <pybind11/stl.h>

#include <sstream>

#include "common/case/case_file.hpp"
#include "common/error/counted.hpp"
#include "common/link/participant.hpp"
#include "common/loop/time_loop.hpp"
#include "common/run/log.hpp"
#include "common/run/options.hpp"
#include "common/run/program.hpp"
#include "common/run/provenance.hpp"
#include "common/scene/scene.hpp"
#include "python/python_side.hpp"

namespace toryu::python {

namespace {

struct Program {
  std::string name;  ///< as others shall see it
  std::string side;  ///< "fluid" or "solid"
  bool keeps_state = false;
  std::string sources;  ///< a sum over its text
  py::object make;
};

/// The lines of a case, as CaseFile::merged gives it, that belong to `section`.
std::string section_of(const std::string& text, const std::string& section) {
  std::string found;
  bool inside = false;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    const auto name = line.find_first_not_of(" [");
    if (const auto start = line.find_first_not_of(' '); start != std::string::npos && line[start] == '[')
      inside = line.substr(name, line.find_first_of(".]", name) - name) == section;
    if (inside) found += line + '\n';
  }
  return found;
}

/// A link whose waits let other threads of Python run.
template <class Link>
struct Unlocked {
  Link& link;
  bool windows_repeat() const { return link.windows_repeat(); }
  std::filesystem::path restart() const { return link.restart(); }
  auto next_turn() {
    const py::gil_scoped_release unlocked;
    return link.next_turn();
  }
  void confirm_checkpoint(const std::function<void()>& write) { link.confirm_checkpoint(write); }
};

void join(FluidLink& link, PythonFluid& fluid) {
  const FluidTraits traits = fluid.traits();
  const Interface interface = [&] {
    const py::gil_scoped_release unlocked;
    return link.join(traits);
  }();
  log::info("the solid's interface has {} of spacing {:g} m", counted(interface.size(), "particle"),
            interface.spacing);
  fluid.attach(interface);
}

void join(SolidLink& link, PythonSolid& solid) {
  const double reach = [&] {
    const py::gil_scoped_release unlocked;
    return link.join();
  }();
  const Interface& interface = solid.interface(reach);
  link.register_interface(interface, solid.motion());
}

void answer(FluidLink& link, const PythonFluid& fluid) {
  link.send(fluid.load(), fluid.time_step_limit(), fluid.health());
}

void answer(SolidLink& link, const PythonSolid& solid) {
  link.send(solid.motion(), solid.impulse_taken(), solid.health());
}

RunRecord::Counts particle_counts(const PythonSolid& solid) {
  return {{"solid", static_cast<long>(solid.particle_count())}};
}
RunRecord::Counts particle_counts(const PythonFluid& /*has none*/) {
  return {};
}

template <class Side, class Link>
ExitCode compute(const Program& program, const Options& options) {
  if (options.describe) return ExitCode::done;
  CaseFile file(options.case_path, options.overrides);
  Scene scene = read_scene(file);
  file.ignore_sections({"fluid", "solid", "coupling"});
  file.throw_if_faulty();
  Side side(program.name, program.make, file.resolved());
  if (options.check) return ExitCode::done;
  Link link({.role = program.name,
             .version = provenance(1).version,
             .out = options.out,
             .network = options.network,
             .case_hash = file.hash(),
             .can_repeat = program.keeps_state,
             .can_checkpoint = program.keeps_state,
             .used_case = section_of(file.merged(), program.side)});
  side.count_steps_by([&link] { link.count_step(); });
  try {
    join(link, side);
  } catch (...) {
    link.leave();
    throw;
  }
  const double joined = link.waiting_time();              // the record's time begins now
  if (program.side == "fluid") scene.frame_interval = 0;  // without particles of its own
  RunRecord record(program.side, options, scene, side, particle_counts(side), side.timers());
  record.made_by({program.name, program.sources});
  Unlocked<Link> unlocked{link};
  const auto take = [&](const auto& turn) {
    side.begin_window(turn);
    side.advance(turn.dt);
    record.count_steps(1, turn.dt);
    record.check(turn.time + turn.dt);
    answer(link, side);
  };
  run_recorded(
      record, [&] { take_windows(unlocked, side, record, take); }, [&] { link.leave(); },
      [&] { return link.waiting_time() - joined; });
  return ExitCode::done;
}

/// Runs the program with the command line `arguments`, its name first; returns its exit code.
int run(const Program& program, std::vector<std::string> arguments) {
  std::vector<char*> argv;
  argv.reserve(arguments.size());
  for (auto& argument : arguments) argv.push_back(argument.data());
  const auto body = [&](const Options& options) {
    return program.side == "fluid" ? compute<PythonFluid, FluidLink>(program, options)
                                   : compute<PythonSolid, SolidLink>(program, options);
  };
  return run_program(program.name, static_cast<int>(argv.size()), argv.data(), body,
                     program.keeps_state ? CanCheckpoint::yes : CanCheckpoint::no);
}

}  // namespace

PYBIND11_MODULE(toryu_participant, module) {
  module.doc() = "The compiled part of toryu.participant.";
  module.def("run", [](const std::string& name, const std::string& side, bool keeps_state,
                       const std::string& sources, const py::object& make,
                       const std::vector<std::string>& arguments) {
    return run({name, side, keeps_state, sources, make}, arguments);
  });
}

}  // namespace toryu::python
