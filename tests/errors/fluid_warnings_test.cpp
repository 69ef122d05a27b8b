// What fluid_solver warns of: each map's edge in the case that it was made with, and nothing in what is
// shipped.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <string>

namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::IsEmpty;

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
