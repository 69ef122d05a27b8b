/// The parts of the coupler: audit, parameters, warnings, record, lock, used case.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>
#include <limits>

#include "common/output/hdf5_file.hpp"
#include "common/run/run_lock.hpp"
#include "coupler/exchange_audit.hpp"
#include "coupler/interface_record.hpp"
#include "coupler/stability_warnings.hpp"
#include "coupler/used_case.hpp"
#include "tests/unit/coupler/scratch_folder.hpp"

namespace toryu::coupling {
namespace {

namespace fs = std::filesystem;
using Folder = ScratchFolder;

/// Two particles under opposite forces: the sum is small beside what was summed.
InterfaceLoad opposite_forces() {
  return {{0, 0}, {3, 4, -3, -4}, {}, Vec::Zero()};
}

TEST(ExchangeAudit, IsRelativeToTheForcesAndNotToTheirSum) {
  ExchangeAudit audit;
  const auto load = opposite_forces();
  EXPECT_EQ(audit.compare(load, {}, load, {}, Vec::Zero(), 0.1), 0);
  // The lengths are 5 and 5, so the scale is 10 x 0.1 s.
  EXPECT_DOUBLE_EQ(audit.compare(load, {}, load, {}, Vec(0.002, 0), 0.1), 0.002);
  EXPECT_EQ(audit.compare(load, {}, load, {}, Vec::Zero(), 0.1), 0);
  EXPECT_DOUBLE_EQ(audit.largest(), 0.002);
}

TEST(ExchangeAudit, SeesBothSides) {
  ExchangeAudit audit;
  InterfaceLoad of_fluid{{0}, {2, 0}, {0, 1}, Vec(-0.2, -0.1)};
  InterfaceLoad applied = of_fluid;
  applied.force = {0, 0};  // the case passes on friction alone
  EXPECT_NEAR(audit.compare(of_fluid, {}, applied, {}, Vec(0, 0.1), 0.1), 0, 1e-15);
  of_fluid.impulse_on_fluid.x() = -0.23;
  EXPECT_NEAR(audit.compare(of_fluid, {}, applied, {}, Vec(0, 0.1), 0.1), 0.1, 1e-12);
}

TEST(ExchangeAudit, CountsTheImpulseOfAnImpedanceOnBothSides) {
  ExchangeAudit audit;
  InterfaceLoad of_fluid{{0}, {2, 0}, {}, Vec(-0.7, 0)};
  EXPECT_NEAR(audit.compare(of_fluid, {0.5, 0}, of_fluid, {0.1, 0}, Vec(0.3, 0), 0.1), 0, 1e-15);
  EXPECT_NEAR(audit.compare(of_fluid, {0.5, 0}, of_fluid, {0.1, 0}, Vec(0.2, 0), 0.1), 0.1 / 0.3, 1e-12);
  EXPECT_NEAR(audit.compare(of_fluid, {0.4, 0}, of_fluid, {0.1, 0}, Vec(0.3, 0), 0.1), 0.1 / 0.6, 1e-12);
}

TEST(ExchangeAudit, ImpulseFromNowhereIsInfinite) {
  ExchangeAudit audit;
  const InterfaceLoad none{{0}, {0, 0}, {}, Vec::Zero()};
  EXPECT_EQ(audit.compare(none, {}, none, {}, Vec(1e-9, 0), 0.1), std::numeric_limits<double>::infinity());
}

/// Reads `[coupling]` with the given lines.
Parameters read_coupling(const std::string& lines) {
  const Folder folder;
  std::ofstream(folder.path / "case.toml") << "[coupling]\n" << lines;
  CaseFile file(folder.path, {});
  Parameters parameters;
  file.read("coupling", parameters, "");
  file.throw_if_faulty();
  return parameters;
}

TEST(Parameters, AllLoadsArePassedOnByDefault) {
  const auto parameters = read_coupling("");
  EXPECT_TRUE(parameters.passes_on("pressure_and_viscous"));
  EXPECT_TRUE(parameters.passes_on("friction"));
  EXPECT_EQ(parameters.fluid_steps_per_window, 1);
}

TEST(Parameters, FrictionAloneCanBePassedOn) {
  const auto parameters = read_coupling("loads = ['friction']\nfluid_steps_per_window = 4");
  EXPECT_FALSE(parameters.passes_on("pressure_and_viscous"));
  EXPECT_TRUE(parameters.passes_on("friction"));
  EXPECT_EQ(parameters.fluid_steps_per_window, 4);
}

TEST(Parameters, AnUnknownLoadIsAFault) {
  EXPECT_THAT([] { read_coupling("loads = ['presure']"); },
              testing::ThrowsMessage<BadInput>(testing::HasSubstr(
                  "case.toml:2:1: error: 'loads' must name 'pressure_and_viscous', 'friction' or both")));
}

Parameters serial_explicit() {
  Parameters coupling;
  coupling.scheme = SchemeKind::serial_explicit;
  return coupling;
}

constexpr const char* damped = "damping.rate = 1";

/// What is said of a layer of 20 mm and `density` [kg/m3] in water of 10 mm, each with more lines, and of
/// `coupling`.
std::vector<std::string> said_of(double density, const Parameters& coupling, const std::string& of_fluid = "",
                                 const std::string& of_solid = damped) {
  const Folder folder;
  std::ofstream(folder.path / "case.toml") << fmt::format(
      "[fluid]\ndensity = 1000\nsound_speed = 20\nspacing = 0.01\n{}\n[solid]\ndensity = {}\n{}\n"
      "[[solid.region]]\nbox = {{ min = [0, 0], max = [1, 0.5] }}\n"
      "[[solid.region]]\nbox = {{ min = [0, 0.5], max = [1, 0.52] }}\n",
      of_fluid, density, of_solid);
  return stability_warnings(CaseFile(folder.path, {}), coupling);
}

TEST(StabilityWarnings, ForeseeALayerThatIsTooLight) {
  Parameters coupling = serial_explicit();
  EXPECT_TRUE(said_of(200, coupling).empty());  // 0.4 of a row of fluid
  EXPECT_THAT(
      said_of(180, coupling),
      testing::ElementsAre(testing::HasSubstr("weighs 0.36 of a row of fluid, the scheme bears 0.385")));
  coupling.scheme = SchemeKind::parallel_explicit;
  EXPECT_THAT(said_of(200, coupling), testing::SizeIs(1));
  coupling.scheme = SchemeKind::serial_implicit;
  EXPECT_TRUE(said_of(180, coupling).empty());
  EXPECT_TRUE(said_of(180, {}).empty());
}

TEST(StabilityWarnings, TellOfALagThatNothingDamps) {
  EXPECT_TRUE(said_of(2000, serial_explicit()).empty());
  EXPECT_THAT(said_of(2000, serial_explicit(), "", ""),
              testing::ElementsAre(testing::HasSubstr("nothing damps the solid: the lag of a window")));
  EXPECT_TRUE(said_of(2000, {}, "", "").empty());
}

TEST(StabilityWarnings, CountAWindowAsLongAsTheFluidsSteps) {
  // C = 0.25 h/d_0 times share or steps, h = 1.3 d_0: (C/2)^2 = 0.660 at 5, above the least of 0.385
  const auto bears = testing::ElementsAre(testing::HasSubstr("the scheme bears 0.66"));
  EXPECT_TRUE(said_of(300, serial_explicit()).empty());  // 0.6 of a row
  EXPECT_THAT(said_of(300, serial_explicit(), "time_step_share = 5"), bears);
  Parameters two_steps = serial_explicit();
  two_steps.fluid_steps_per_window = 2;
  EXPECT_THAT(said_of(300, two_steps, "time_step_share = 2.5"), bears);
  // of viscosity the window is shorter: 0.125 h^2/nu is a tenth of 0.25 h/c_0 at nu = 5 h c_0 = 1.3 m2/s
  EXPECT_TRUE(
      said_of(300, serial_explicit(), "time_step_share = 5\nlaminar_viscosity.dynamic_viscosity = 1300")
          .empty());
  EXPECT_TRUE(
      said_of(300, serial_explicit(), "time_step_share = 5\ncarreau.zero_shear_viscosity = 1300").empty());
  const std::string power_law =
      "time_step_share = 5\npower_law.smallest_viscosity = 1\n"
      "power_law.largest_viscosity = 1300\npower_law.exponent = ";
  EXPECT_TRUE(said_of(300, serial_explicit(), power_law + "0.5").empty());
  EXPECT_THAT(said_of(300, serial_explicit(), power_law + "1.5"), bears);  // thin while it is at rest
}

TEST(StabilityWarnings, LeaveAWindowToTheRunWhoseViscosityTheFluidAloneKnows) {
  const std::string long_step = "time_step_share = 5\n";
  for (const char* medium :
       {"medium.name = 'newtonian_1000'", "laminar_viscosity.dynamic_viscosity = 1\ntemperature.value = 300",
        "viscoelasticity.law = 'oldroyd_b'"})
    EXPECT_TRUE(said_of(300, serial_explicit(), long_step + medium).empty()) << medium;
}

TEST(StabilityWarnings, SeeNoDeeperThanTheKernel) {
  const Folder folder;
  std::ofstream(folder.path / "case.toml")
      << "[fluid]\ndensity = 1000\nsound_speed = 20\nspacing = 0.01\nsmoothing_ratio = 1.25\n"
         "[solid]\ndensity = 140\ndamping.rate = 1\n[[solid.region]]\nbox = { min = [0, 0], max = [1, 1] }\n";
  EXPECT_THAT(stability_warnings(CaseFile(folder.path, {}), serial_explicit()),
              testing::ElementsAre(
                  testing::HasSubstr("weighs 0.28 of a row")));  // 140 x 2 rows: from half a spacing off
}

TEST(StabilityWarnings, WeighTheLightestOfSeveralMaterials) {
  const std::string with_foam = std::string(damped) + "\n[[solid.material]]\nname = 'foam'\ndensity = 100\n";
  EXPECT_TRUE(said_of(1000, serial_explicit()).empty());
  EXPECT_THAT(said_of(1000, serial_explicit(), "", with_foam), testing::SizeIs(1));
}

TEST(StabilityWarnings, WeighARigidBodyAsAWhole) {
  const std::string rigid = "formulation = \"rigid\"";
  EXPECT_TRUE(said_of(200, serial_explicit(), "", rigid).empty()) << "it has no modes that a lag could feed";
  EXPECT_THAT(said_of(180, serial_explicit(), "", rigid), testing::SizeIs(1));
  EXPECT_TRUE(said_of(180, serial_explicit(), "", rigid + "\nmounting.fixed = ['x', 'y', 'angle']").empty());
  EXPECT_TRUE(said_of(0.1, Parameters(), "", rigid).empty()) << "Robin bears any rigid mass";
  const Folder folder;
  std::ofstream(folder.path / "case.toml")
      << "[fluid]\ndensity = 1000\nsound_speed = 20\nspacing = 0.01\nsmoothing_ratio = 1.25\n"
         "[solid]\nformulation = \"rigid\"\ndensity = 140\n"
         "[[solid.region]]\nbox = { min = [0, 0], max = [1, 1] }\n";
  EXPECT_TRUE(stability_warnings(CaseFile(folder.path, {}), serial_explicit()).empty())
      << "14 rows, of which the kernel sees two";
}

TEST(StabilityWarnings, KnowABodyThatNothingMoves) {
  const auto kind_of = [](const std::string& solid) {
    const Folder folder;
    std::ofstream(folder.path / "case.toml") << solid;
    return solid_kind(CaseFile(folder.path, {}));
  };
  const std::string all = "mounting.fixed = ['x', 'angle', 'y']\n", some = "mounting.fixed = ['x', 'y']\n";
  const std::string rigid = "[solid]\nformulation = 'rigid'\n", left = "[[solid.body]]\nname = 'left'\n",
                    right = "[[solid.body]]\nname = 'right'\n";
  EXPECT_EQ(kind_of("[solid]\nformulation = 'total_lagrangian'\n"), SolidKind::elastic);
  EXPECT_EQ(kind_of(rigid), SolidKind::rigid);
  EXPECT_EQ(kind_of(rigid + some), SolidKind::rigid);
  EXPECT_EQ(kind_of(rigid + all), SolidKind::held);
  EXPECT_EQ(kind_of(rigid + left + all + right + some), SolidKind::rigid);
  EXPECT_EQ(kind_of(rigid + left + all + right + all), SolidKind::held);
}

TEST(StabilityWarnings, SayNothingOfWhatTheyDoNotKnow) {
  Parameters coupling = serial_explicit();
  coupling.fluid_steps_per_window = 4;
  const Folder folder;
  std::ofstream(folder.path / "case.toml") << "[fluid]\nviscosity = 1\n[solid]\nmass = 1\ndamping.rate = 1\n";
  EXPECT_THAT(stability_warnings(CaseFile(folder.path, {}), coupling),
              testing::ElementsAre(testing::HasSubstr("cases/pushed_column/window_map.toml")));
}

TEST(UsedCase, TakesEachSectionOnce) {
  EXPECT_EQ(merge_used_cases({"[case]\nend_time = 1\n\n[[wall]]\nname = \"floor\"\n\n[coupling]\nn = 1\n",
                              "[case]\nend_time = 1\n\n[fluid]\nc = 2\n\n[[fluid.region]]\nx = [[1], [2]]\n",
                              "[[wall]]\nname = \"floor\"\n\n[solid]\nE = 3\n"}),
            "[case]\nend_time = 1\n\n[[wall]]\nname = \"floor\"\n\n[coupling]\nn = 1\n\n"
            "[fluid]\nc = 2\n\n[[fluid.region]]\nx = [[1], [2]]\n\n[solid]\nE = 3\n");
}

TEST(RunLock, RefusesASecondRunUntilTheFirstEnds) {
  const Folder scratch;
  const fs::path& folder = scratch.path;
  {
    const RunLock lock(folder);
    EXPECT_THAT([&] { RunLock second(folder); },
                testing::ThrowsMessage<BadInput>(testing::HasSubstr("another run writes its results here")));
  }
  EXPECT_NO_THROW(RunLock{folder});
}

TEST(InterfaceRecord, GrowsByRowsAndGetsItsNameAtTheEnd) {
  const Folder scratch;
  const fs::path& folder = scratch.path;
  const fs::path path = folder / "interface.h5";
  const Interface interface { {7, 8}, {0, 0, 1, 0}, {1, 1}, {0, 1, 0, 1}, {1, 1}, 1.0 };
  {
    InterfaceRecord record(folder, interface);
    record.write(0.0, {{0, 0, 1, 0}, {0, 0, 0, 0}}, {});
    record.write(0.5, {{0, 1, 1, 2}, {3, 4, 5, 6}}, {{10, 20}, {1, 2, 3, 4}, {}, Vec::Zero()});
    EXPECT_FALSE(fs::exists(path));
  }
  const HdfHandle file(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose, "file");
  const HdfHandle force(H5Dopen2(file, "force", H5P_DEFAULT), H5Dclose, "force");
  const HdfHandle space(H5Dget_space(force), H5Sclose, "space");
  hsize_t shape[3] = {};
  ASSERT_EQ(H5Sget_simple_extent_dims(space, shape, nullptr), 3);
  EXPECT_THAT(shape, testing::ElementsAre(2, 2, 2));
  double values[8] = {};
  H5Dread(force, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values);
  EXPECT_THAT(values, testing::ElementsAre(0, 0, 0, 0, 1, 2, 3, 4));
}

}  // namespace
}  // namespace toryu::coupling
