// What fluid_solver warns of: each map's edge in the case that it was made with, and nothing in what is
// shipped.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <string>

namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

const fs::path cases = CASES;

/// The lines of warning, in a run to its good end or under --check.
std::string warnings(const fs::path& path, const std::string& arguments) {
  const std::string command = "'" FLUID_SOLVER "' '" + path.string() + "' --threads 1 --log-level warn " +
                              arguments + " 2>&1 >/dev/null";
  FILE* pipe = popen(command.c_str(), "r");
  std::array<char, 1000> line{};
  std::string found;
  while (fgets(line.data(), line.size(), pipe))
    if (std::string(line.data()).find("warning") != std::string::npos) found += line.data();
  EXPECT_EQ(pclose(pipe), 0) << command;
  return found;
}

std::string warnings_of_a_run(const std::string& name, const std::string& arguments) {
  const fs::path out = fs::temp_directory_path() / ("toryu_fluid_warnings_" + std::to_string(getpid()));
  const std::string found =
      warnings(cases / name, "--out '" + out.string() + "' --set case.frame_interval=0 " + arguments);
  fs::remove_all(out);
  return found;
}

TEST(FluidWarnings, AreNotGivenOfTheCasesThatAreShipped) {
  int checked = 0;
  for (const auto& folder : fs::directory_iterator(cases)) {
    const fs::path file = folder.path() / "case.toml";
    std::ifstream stream(file);
    const std::string text(std::istreambuf_iterator<char>(stream), {});
    if (text.find("\n[fluid]") == std::string::npos || folder.path().filename() == "thin_jet") continue;
    EXPECT_THAT(warnings(file, "--check"), IsEmpty()) << file;
    ++checked;
  }
  EXPECT_GT(checked, 15);
}

/// Water 0.2 m deep on which gravity sets in at once, with what every fluid must say and no more.
const char* const bare_tank = R"(
[case]
title = "Bare tank"
gravity = [0.0, -9.81]
end_time = 5.0
frame_interval = 0
series_interval = 0.5
domain = { min = [-0.2, -0.2], max = [0.7, 0.5] }
[[wall]]
name = "floor"
box = { min = [-0.1, -0.1], max = [0.6, 0.0] }
[[wall]]
name = "left"
box = { min = [-0.1, 0.0], max = [0.0, 0.3] }
[[wall]]
name = "right"
box = { min = [0.5, 0.0], max = [0.6, 0.3] }
[fluid]
density = 1000.0
sound_speed = 20.0
spacing = 0.02
[[fluid.region]]
name = "water"
box = { min = [0.0, 0.0], max = [0.5, 0.2] }
)";

/// Largest speed in the last row of fluid.csv [m/s].
double last_largest_speed(const fs::path& out) {
  std::ifstream series(out / "fluid.csv");
  std::string line, last;
  std::getline(series, line);
  const auto columns_before = line.substr(0, line.find("largest_speed"));
  while (std::getline(series, line)) last = line;
  for (auto left = std::count(columns_before.begin(), columns_before.end(), ','); left > 0; --left)
    last = last.substr(last.find(',') + 1);
  return std::stod(last);
}

TEST(FluidWarnings, ABareFluidComesToRestWithoutAWord) {
  const fs::path folder = fs::temp_directory_path() / ("toryu_bare_tank_" + std::to_string(getpid()));
  fs::create_directories(folder);
  std::ofstream(folder / "case.toml") << bare_tank;
  EXPECT_THAT(warnings(folder, "--out '" + (folder / "out").string() + "'"), IsEmpty());
  EXPECT_LT(last_largest_speed(folder / "out"), 0.05) << "it fell 1 % of its depth at the start, at 0.1 m/s";
  fs::remove_all(folder);
}

TEST(FluidWarnings, NameAGapThatTheFluidFallsInto) {
  const auto of_water_from = [](const std::string& height) {
    return warnings(cases / "hydrostatic_tank",
                    "--check --set 'fluid.region.water.box.min=[0.0," + height + "]'");
  };
  EXPECT_THAT(of_water_from("0.02"),
              HasSubstr("the fluid's region 'water' ends at y = 0.02 m, 0.4 spacings off the wall "
                        "'floor': it does not rest on it, but moves into the gap"));
  EXPECT_THAT(of_water_from("0.0"), Not(HasSubstr("does not rest on it")));
}

TEST(FluidWarnings, NameAJetThatIsNone) {
  EXPECT_THAT(warnings(cases / "thin_jet", "--check"),
              HasSubstr("the fluid is 1 particle wide in places: a jet so narrow bounces"));
}

TEST(FluidWarnings, NameAWorkPieceThatIsTooCoarseBeforeTheRun) {
  EXPECT_THAT(warnings(cases / "abrasive_flow", "--check --set solid.spacing=0.002"),
              HasSubstr("the work piece's particles stand 0.002 m apart, the fluid's 0.001 m"));
}

TEST(FluidWarnings, NameASuctionThatIsNotBorne) {
  const std::string low = "--end-time 0.3 --set fluid.background_pressure.pressure=25 ";
  EXPECT_THAT(warnings_of_a_run("retreating_piston", low),
              HasSubstr("cases/retreating_piston/suction_map.toml"));
  EXPECT_THAT(warnings_of_a_run("retreating_piston", low + "--set fluid.particle_shifting={}"), IsEmpty());
  EXPECT_THAT(warnings_of_a_run("retreating_piston", "--set fluid.spacing=0.05"), IsEmpty());
}

}  // namespace
