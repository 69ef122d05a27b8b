// What fluid_solver finds wrong with the open ends of a channel, word for word.
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <array>
#include <cstdio>
#include <string>

namespace {

struct OpenEndFault {
  std::string name, settings, text;
};

/// The last line of what is told under --check with these settings, from the error on.
std::pair<int, std::string> fault_of(const std::string& settings) {
  std::string command = "'" FLUID_SOLVER "' '" OPEN_CHANNEL "' --check";
  for (std::size_t begin = 0; begin < settings.size();) {
    const std::size_t end = std::min(settings.find(' ', begin), settings.size());
    command += " --set '" + settings.substr(begin, end - begin) + "'";
    begin = end + 1;
  }
  FILE* pipe = popen((command + " 2>&1 >/dev/null").c_str(), "r");
  std::array<char, 1000> line{};
  std::string last;
  while (fgets(line.data(), line.size(), pipe)) last = line.data();
  const int status = pclose(pipe);
  const std::size_t error = last.find("error: ");
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1,
          error == std::string::npos ? last : last.substr(error + 7)};
}

class OpenEndFaults : public testing::TestWithParam<OpenEndFault> {};

TEST_P(OpenEndFaults, HaveTheirText) {
  const auto [code, text] = fault_of(GetParam().settings);
  EXPECT_EQ(text, GetParam().text + "\n");
  EXPECT_EQ(code, 2);
}

INSTANTIATE_TEST_SUITE_P(
    Kinds, OpenEndFaults,
    testing::Values(
        OpenEndFault{"UnknownKey", "fluid.inlet.inlet.mean_sped=1",
                     "unknown key 'mean_sped' in [[fluid.inlet]]; did you mean 'mean_speed'?"},
        OpenEndFault{
            "UnknownProfile", "fluid.inlet.inlet.profile=\"parabola\"",
            "'profile' in [[fluid.inlet]] must be one of 'uniform', 'parabolic', found 'parabola'; did "
            "you mean 'parabolic'?"},
        OpenEndFault{"NoSpacing", "fluid.spacing=inf",
                     "'spacing' in [fluid] must be a finite number [m], found inf"},
        OpenEndFault{
            "TinySpacing", "fluid.spacing=1e-9",
            "open end 'outlet': the spacing of 1e-09 m gives it 1.0e+09 rows; at most 1e+06 are possible"},
        OpenEndFault{"TwoSpeeds", "fluid.inlet.inlet.largest_speed=1",
                     "an inlet needs one of 'mean_speed', 'largest_speed' (above 0) and 'speeds'"},
        OpenEndFault{"RampAndTable", "fluid.inlet.inlet.over_time=[[0,0],[1,1]]",
                     "either 'ramp_time' or 'over_time' says how the speed begins"},
        OpenEndFault{"PressureTwice",
                     "fluid.outlet.outlet.pressure=1 fluid.outlet.outlet.pressure_over_time=[[0,0],[1,1]]",
                     "either 'pressure' or 'pressure_over_time' says the pressure"},
        OpenEndFault{"Slanted", "fluid.inlet.inlet.to=[0.1,1.0]",
                     "an open end lies along x or y: 'from' and 'to' must have the same x or the same y"},
        OpenEndFault{
            "InTheMidst", "fluid.inlet.inlet.from=[0.5,0.0] fluid.inlet.inlet.to=[0.5,1.0]",
            "open end 'inlet': the line has fluid on neither side or on both: a [[fluid.region]] must "
            "end at it, and nothing of the fluid lie beyond"},
        OpenEndFault{
            "TooShort", "fluid.inlet.inlet.from=[0.0,0.1]",
            "open end 'inlet': the line must go from wall to wall, and the walls on beyond it: there "
            "is none near (-0.025, 0.075) m; the layer beyond the line is 0.35 m deep, to x = -0.35 m"},
        OpenEndFault{
            "IntoAWall", "fluid.inlet.inlet.from=[0.0,-0.1]",
            "open end 'inlet': the line runs into a wall near (0.025, -0.075) m; the layer beyond the "
            "line is 0.35 m deep, to x = -0.35 m"},
        OpenEndFault{
            "WallsEnd", "wall.upper.box.min=[-0.2,1.0]",
            "open end 'inlet': the line must go from wall to wall, and the walls on beyond it: there "
            "is none near (-0.225, 1.025) m; the layer beyond the line is 0.35 m deep, to x = -0.35 m"},
        OpenEndFault{
            "ShortChannel",
            "fluid.region.channel.box.max=[0.2,1.0] fluid.outlet.outlet.from=[0.2,0.0] "
            "fluid.outlet.outlet.to=[0.2,1.0]",
            "open end 'outlet': the channel must be longer than the layer beyond the line is deep: it "
            "ends near (-0.025, 0.5) m; the layer beyond the line is 0.35 m deep, to x = 0.55 m"},
        OpenEndFault{"Implicit", "fluid.model=\"implicit\"",
                     "channels with open ends do not go with model = \"implicit\""},
        OpenEndFault{"Periodic", "case.periodic=\"x\"",
                     "channels with open ends do not go with space that repeats itself ([case] periodic)"},
        OpenEndFault{
            "SameName", "fluid.inlet.inlet.name=\"outlet\"",
            "two columns of the results would be named 'mass_through_outlet': an observer, a region or "
            "a wall needs another name"},
        OpenEndFault{
            "SolidBeyond",
            "solid={density=1,spacing=0.05,model=\"elastic\",youngs_modulus=1,region=[{name=\"s\",box={min="
            "[-0.2,0.2],max=[-0.1,0.5]}}]}",
            "open end 'inlet': the solid lies beyond the line, where the fluid goes on, near (-0.125, "
            "0.225) m; the layer beyond the line is 0.35 m deep, to x = -0.35 m"}),
    [](const auto& kind) { return kind.param.name; });

}  // namespace
