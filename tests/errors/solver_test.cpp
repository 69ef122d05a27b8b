// The faults that the three programs themselves find in a real case: each checks the sections that are its
// own and leaves the others alone.
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <array>
#include <cstdio>
#include <string>

namespace {

struct Ending {
  int code;
  std::string error;
};

Ending check(const std::string& program, const std::string& arguments) {
  const std::string command =
      "'" + program + "' '" ELASTIC_GATE "' --check " + arguments + " 2>&1 >/dev/null";
  FILE* pipe = popen(command.c_str(), "r");
  std::string error;
  std::array<char, 1000> buffer;
  while (fgets(buffer.data(), buffer.size(), pipe)) error += buffer.data();
  const int status = pclose(pipe);
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, error};
}

const std::string fluid = FLUID_SOLVER, solid = SOLID_SOLVER, coupler = COUPLER;

TEST(Programs, FindNothingWrongWithTheGate) {
  for (const auto& program : {fluid, solid, coupler}) {
    const Ending ending = check(program, "");
    EXPECT_EQ(ending.code, 0) << program;
    EXPECT_EQ(ending.error, "") << program;
  }
}

TEST(Programs, CheckTheirOwnSection) {
  const std::string wrong = "--set fluid.densty=1 --set solid.densty=1 --set coupling.time_limt=1";
  EXPECT_EQ(check(fluid, wrong).error,
            "--set fluid.densty=1: error: unknown key 'densty' in [fluid]; did you mean 'density'?\n");
  EXPECT_EQ(check(solid, wrong).error,
            "--set solid.densty=1: error: unknown key 'densty' in [solid]; did you mean 'density'?\n");
  EXPECT_EQ(check(coupler, wrong).error,
            "--set coupling.time_limt=1: error: unknown key 'time_limt' in [coupling]; did you mean "
            "'time_limit'?\n");
  EXPECT_EQ(check(fluid, wrong).code, 2);
}

TEST(Programs, SayTheSameOfTheCommonSections) {
  for (const auto& program : {fluid, solid, coupler})
    EXPECT_EQ(check(program, "--set case.end_tim=1 --set gravity=0").error,
              "--set case.end_tim=1: error: unknown key 'end_tim' in [case]; did you mean 'end_time'?\n"
              "--set gravity=0: error: unknown key 'gravity'; sections are 'case', 'coupling', 'fluid', "
              "'motion', 'reference', 'solid', 'wall'\n");
}

TEST(Programs, TellOfTwoColumnsAtWhatBeginsWithTheName) {
  EXPECT_TRUE(check(solid,
                    "--set solid.region.0.observed=true --set solid.observer.0.name=gate --set "
                    "wall.0.name=displacement")
                  .error.starts_with("--set solid.observer.0.name=gate: error: two columns"));
}

TEST(Programs, RefuseTwoColumnsOfOneName) {
  const Ending ending = check(solid, "--set solid.region.0.observed=true --set solid.observer.0.name=gate");
  EXPECT_EQ(ending.code, 2);
  EXPECT_EQ(ending.error,
            "--set solid.observer.0.name=gate: error: two columns of the results would be named "
            "'gate_displacement_x': an observer, a "
            "region or a wall needs another name\n");
}

TEST(Programs, RefuseAReferenceOverASeriesThatTheyDoNotWrite) {
  const std::string of_fluid = "--set 'reference.0.series=\"fluid.csv:kinetic_enery[J/m]\"'",
                    of_interface = "--set 'reference.0.series=\"fluid.csv:work_from_interface[J/m]\"'";
  EXPECT_EQ(
      check(solid, "--set 'reference.0.series=\"solid.csv:tip_x[m]\"'").error,
      "--set reference.0.series=\"solid.csv:tip_x[m]\": error: solid.csv will have no column 'tip_x[m]'\n");
  EXPECT_EQ(check(fluid, of_fluid).error,
            "--set reference.0.series=\"fluid.csv:kinetic_enery[J/m]\": error: fluid.csv will have no column "
            "'kinetic_enery[J/m]'; did you mean 'kinetic_energy[J/m]'?\n");
  for (const auto& program : {fluid, solid, coupler}) EXPECT_EQ(check(program, of_interface).error, "");
  for (const auto& program : {solid, coupler}) EXPECT_EQ(check(program, of_fluid).error, "");
  EXPECT_EQ(
      check(fluid, "--set 'reference.0.series=\"fluid.csv:work_from_interfac[J/m]\"'").error,
      "--set reference.0.series=\"fluid.csv:work_from_interfac[J/m]\": error: fluid.csv will have no column "
      "'work_from_interfac[J/m]'; did you mean 'work_from_interface[J/m]'?\n");
  EXPECT_EQ(check(coupler, "--set 'reference.0.series=\"coupler.csv:residual[1]\"'").error,
            "--set reference.0.series=\"coupler.csv:residual[1]\": error: coupler.csv will have no column "
            "'residual[1]'\n");
  EXPECT_EQ(check(coupler,
                  "--set 'reference.0.series=\"coupler.csv:residual[1]\"' "
                  "--set 'coupling.scheme=\"serial_implicit\"'")
                .error,
            "");
  for (const auto& program : {fluid, solid, coupler})
    EXPECT_EQ(check(program, "--set 'reference.0.series=\"\"'").error,
              "--set reference.0.series=\"\": error: 'series' in [[reference]] must not be empty\n");
}

TEST(Programs, RefuseSlipBesideASolid) {
  const Ending ending =
      check(fluid,
            "--set fluid.artificial_viscosity=false --set "
            "fluid.laminar_viscosity.dynamic_viscosity=1 --set fluid.wall_model.slip=no_slip "
            "--set fluid.wall_slip.coefficient=1");
  EXPECT_EQ(ending.code, 2);
  EXPECT_EQ(ending.error,
            "--set fluid.wall_slip.coefficient=1: error: the medium slides along rigid walls alone, and an "
            "elastic solid would be no-slip beside them: leave one of the two out\n");
}

TEST(Programs, RefuseASpacingThatWouldTakeAllMemory) {
  const Ending of_fluid = check(fluid, "--set fluid.spacing=1e-9");
  EXPECT_EQ(of_fluid.code, 2);
  EXPECT_EQ(
      of_fluid.error,
      "--set fluid.spacing=1e-9: error: a spacing of 1e-09 m would fill a body with 1.4e+16 particles; at "
      "most 1e+08 are possible\n");
  const Ending of_solid = check(solid, "--set solid.spacing=1e-9");
  EXPECT_EQ(of_solid.code, 2);
  EXPECT_EQ(
      of_solid.error,
      "--set solid.spacing=1e-9: error: a spacing of 1e-09 m would fill a body with 4.3e+14 particles; at "
      "most 1e+08 are possible\n");
}

TEST(Programs, RefuseAStartBeyondTheLimits) {
  const Ending ending = check(fluid, "--set 'fluid.region.water.box.max=[0.1,0.3]'");
  EXPECT_EQ(ending.code, 2);
  EXPECT_NE(ending.error.find(": error: cannot start: fluid particle "), std::string::npos) << ending.error;
  EXPECT_TRUE(ending.error.ends_with("limit the domain of the case\n")) << ending.error;
}

TEST(Programs, RefuseMoreFramesThanCanBeCounted) {
  for (const auto& program : {fluid, solid, coupler})
    EXPECT_EQ(
        check(program, "--set case.frame_interval=1e-15").error,
        "--set case.frame_interval=1e-15: error: 'frame_interval' would give 4.0e+14 frames; at most 1e12 "
        "can be counted\n");
}

}  // namespace
