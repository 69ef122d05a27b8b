#include "common/case/case_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "tests/errors/case_text.hpp"

namespace toryu {
namespace {

using testing::ElementsAre;

Medium read_medium(CaseFile& file) {
  Medium medium;
  file.read("medium", medium, "what fills the room");
  file.throw_if_faulty();
  return medium;
}

const std::string full_medium = R"(
[medium]
density = 1000            # an integer where a number is asked
ratio = 1.5
steps = 4
open = true
label = "a \"quoted\" \\ label\twith a tab, \u00e9 and \u0001"
law = "quadratic"
loads = ["viscous", "pressure"]
wind = [1, -0.1]
history = [[0, 1], [0.1, 2]]
[medium.drag]
coefficient = 0.3
[[medium.region]]
name = "left"
box = { min = [0, 0], max = [0.1, 1] }
[[medium.region]]
name = "right"
[medium.region.box]
min = [0.1, 0]
max = [1e-1, 1e-3]
)";

std::string sound_medium() {
  std::string text = full_medium;
  return text.replace(text.find("1e-1,"), 5, "0.25,");
}

void expect_equal(const Medium& a, const Medium& b) {
  EXPECT_EQ(a.density, b.density);
  EXPECT_EQ(a.ratio, b.ratio);
  EXPECT_EQ(a.steps, b.steps);
  EXPECT_EQ(a.open, b.open);
  EXPECT_EQ(a.label, b.label);
  EXPECT_EQ(a.law, b.law);
  EXPECT_EQ(a.loads, b.loads);
  EXPECT_EQ(a.wind, b.wind);
  EXPECT_EQ(a.history, b.history);
  ASSERT_EQ(a.drag.has_value(), b.drag.has_value());
  EXPECT_EQ(a.drag.value_or(Drag{}).coefficient, b.drag.value_or(Drag{}).coefficient);
  ASSERT_EQ(a.regions.size(), b.regions.size());
  for (std::size_t i = 0; i < a.regions.size(); ++i) {
    EXPECT_EQ(a.regions[i].name, b.regions[i].name);
    EXPECT_EQ(a.regions[i].box.min, b.regions[i].box.min);
    EXPECT_EQ(a.regions[i].box.max, b.regions[i].box.max);
  }
}

TEST(CaseFile, ReadsEachKindOfParameter) {
  const CaseText text(sound_medium());
  CaseFile file(text.folder(), {});
  const Medium medium = read_medium(file);
  EXPECT_EQ(medium.density, 1000);
  EXPECT_EQ(medium.ratio, 1.5);
  EXPECT_EQ(medium.steps, 4);
  EXPECT_TRUE(medium.open);
  EXPECT_EQ(medium.label, "a \"quoted\" \\ label\twith a tab, \xc3\xa9 and \x01");
  EXPECT_EQ(medium.law, Law::quadratic);
  EXPECT_THAT(medium.loads, ElementsAre("viscous", "pressure"));
  EXPECT_EQ(medium.wind, Vec(1, -0.1));
  EXPECT_THAT(medium.history, ElementsAre(ElementsAre(0, 1), ElementsAre(0.1, 2)));
  ASSERT_TRUE(medium.drag);
  EXPECT_EQ(medium.drag->coefficient, 0.3);
  ASSERT_EQ(medium.regions.size(), 2u);
  EXPECT_EQ(medium.regions[1].name, "right");
  EXPECT_EQ(medium.regions[1].box.max, Vec(0.25, 1e-3));
}

TEST(CaseFile, KeepsDefaultsWhereTheCaseSaysNothing) {
  const CaseText text("[medium]\ndensity = 1\n");
  CaseFile file(text.folder(), {});
  Medium defaults;
  defaults.density = 1;
  expect_equal(read_medium(file), defaults);
}

TEST(CaseFile, UsedCaseReadsBackToTheSameParameters) {
  const CaseText text(sound_medium());
  CaseFile file(text.folder(), {"medium.steps=7"});
  file.ignore_sections({"other"});
  const Medium medium = read_medium(file);
  const std::string used = file.used();
  const CaseText again_text(used);
  CaseFile again(again_text.folder(), {});
  expect_equal(read_medium(again), medium);
  EXPECT_EQ(again.used(), used);
}

TEST(CaseFile, UsedCaseKeepsEachBitOfANumber) {
  std::mt19937_64 random(1);
  for (int i = 0; i < 200; ++i) {
    Medium medium;
    medium.density = std::ldexp(static_cast<double>(random()), static_cast<int>(random() % 2000) - 1050);
    medium.wind = Vec(-medium.density, i % 2 ? 0.0 : -0.0);
    const CaseText text(fmt::format("[medium]\ndensity = {:.17e}\nwind = [{:.17e}, {:.1f}]\n", medium.density,
                                    medium.wind[0], medium.wind[1]));
    CaseFile file(text.folder(), {});
    read_medium(file);
    const CaseText again_text(file.used());
    CaseFile again(again_text.folder(), {});
    const Medium back = read_medium(again);
    EXPECT_EQ(back.density, medium.density);
    EXPECT_EQ(back.wind[0], medium.wind[0]);
    EXPECT_EQ(std::signbit(back.wind[1]), std::signbit(medium.wind[1]));
  }
}

TEST(CaseFile, UsedCaseHasKeysBeforeSectionsAndDefaultsToo) {
  const CaseText text("[medium]\ndensity = 12e6\ndrag = {}\n");
  CaseFile file(text.folder(), {});
  read_medium(file);
  const std::string expected = R"(
[medium]
density = 12000000.0
ratio = 1.3
steps = 2
open = false
label = "medium"
law = "linear"
loads = ["pressure"]
wind = [0.0, 0.0]
history = []

[medium.drag]
coefficient = 1.0
)";
  EXPECT_EQ(file.used(), expected);
}

struct Unbounded {
  double limit = std::numeric_limits<double>::infinity();
};
void describe(ParameterTable& table, Unbounded& p) {
  table.number("limit", p.limit, {});
}

TEST(CaseFile, UsedCaseLeavesOutADefaultThatIsNotFinite) {
  const CaseText text("[unbounded]\n");
  CaseFile file(text.folder(), {});
  Unbounded unbounded;
  file.read("unbounded", unbounded, "");
  EXPECT_EQ(file.used(), "\n[unbounded]\n");
  EXPECT_TRUE(std::isinf(unbounded.limit));
}

/// A section that is taken unless it is false.
struct Room {
  std::optional<Drag> drag;
};
void describe(ParameterTable& table, Room& room) {
  table.optional("drag", room.drag, "resistance", Absence::takes_defaults);
}

TEST(CaseFile, TakesASectionThatIsLeftOutByFalseAlone) {
  for (const auto& [text, drag, used] :
       {std::tuple{"[room]\n", true, "\n[room]\n\n[room.drag]\ncoefficient = 1.0\n"},
        std::tuple{"[room]\ndrag = {}\n", true, "\n[room]\n\n[room.drag]\ncoefficient = 1.0\n"},
        std::tuple{"[room]\ndrag = false\n", false, "\n[room]\ndrag = false\n"}}) {
    const CaseText written(text);
    CaseFile file(written.folder(), {});
    Room room;
    file.read("room", room, "");
    file.throw_if_faulty();
    EXPECT_EQ(room.drag.has_value(), drag) << text;
    EXPECT_EQ(file.used(), used);
  }
}

TEST(CaseFile, DescribesSectionsWithDefaultsWhateverTheCaseSays) {
  const CaseText text(sound_medium());
  CaseFile file(text.folder(), {});
  read_medium(file);
  EXPECT_EQ(file.description(), R"(
[medium]  what fills the room
  density  required      a number [kg/m3] above 0                 at rest
  ratio    1.3           a number from 1 to 2
  steps    2             an integer of at least 1
  open     false         true or false                            whether it is open
  label    'medium'      text
  law      'linear'      one of 'linear', 'quadratic'             of the drag
  loads    ['pressure']  a list of 'pressure', 'viscous'          that are felt
  wind     [0, 0]        2 numbers [m/s]
  history  []            rows of 2 numbers (time [s], level [m])

[medium.drag]  (optional)  resistance
  coefficient  1  a number from 0 to 2  of the drag

[[medium.region]]  (any number)  filled regions
  name  required  text

[medium.region.box]  filled
  min    required  2 numbers [m]  smallest corner
  max    required  2 numbers [m]  largest corner
  round  false     true or false  the disc or ellipse that touches the sides, in place of the whole box
)");
}

TEST(CaseFile, IsFoundByItsFolderAndNamedByIt) {
  const CaseText text("[medium]\ndensity = 1\n");
  CaseFile by_folder(text.folder(), {}), by_file(text.folder() / "case.toml", {});
  EXPECT_EQ(by_folder.name(), text.folder().filename());
  EXPECT_EQ(by_file.name(), by_folder.name());
  EXPECT_EQ(by_folder.folder(), text.folder());
}

TEST(CaseFile, NameOfTheFolderDoesNotDependOnHowItIsWritten) {
  const auto here = std::filesystem::current_path().filename().string();
  EXPECT_EQ(case_name("case.toml"), here);
  EXPECT_EQ(case_name("./case.toml"), here);
  EXPECT_EQ(case_name("cases/gate//case.toml"), "gate");
  EXPECT_EQ(case_name("cases/gate/fine.toml"), "gate_fine");
}

TEST(CaseFile, HasASectionUnlessItIsTakenAway) {
  const CaseText text("[medium]\ndensity = 1\n[[wall]]\n");
  const CaseFile file(text.folder(), {}), without(text.folder(), {"medium=false"});
  EXPECT_TRUE(file.has("medium"));
  EXPECT_TRUE(file.has("wall"));
  EXPECT_FALSE(file.has("solid"));
  EXPECT_FALSE(file.has("medium.drag"));
  EXPECT_TRUE(CaseFile(text.folder(), {"medium.drag={}"}).has("medium.drag"));
  EXPECT_FALSE(without.has("medium"));
}

TEST(CaseFile, SaysOnlyInWhatItDiffersFromItsBase) {
  const CaseText text(
      "base = 'base.toml'\nother = false\n[medium]\nratio = 2\n[[medium.region]]\nname = 'right'\n"
      "box.max = [0.5, 1]\n[[medium.region]]\nname = 'far'\nbox = {min=[1,1], max=[2,2]}\n");
  text.add("base.toml", sound_medium() + "[other]\nanything = 1\n");
  CaseFile file(text.folder(), {"medium.steps=7"});
  file.ignore_sections({"other"});
  const Medium medium = read_medium(file);
  EXPECT_EQ(medium.density, 1000);
  EXPECT_EQ(medium.ratio, 2);
  EXPECT_EQ(medium.steps, 7);
  ASSERT_EQ(medium.regions.size(), 3u);
  EXPECT_EQ(medium.regions[1].box.max, Vec(0.5, 1));
  EXPECT_EQ(medium.regions[1].box.min, Vec(0.1, 0));
  EXPECT_EQ(medium.regions[2].name, "far");
  EXPECT_FALSE(file.has("other"));
  const auto hash = file.hash();
  text.add("base.toml", sound_medium() + "\n[other]\nanything = 1\n");
  EXPECT_NE(CaseFile(text.folder(), {"medium.steps=7"}).hash(), hash);
}

TEST(CaseFile, TellsOfTwoItemsOfOneNameBesideTheirBase) {
  const std::string item = "[[medium.region]]\nname = 'far'\nbox = {min=[1,1], max=[2,2]}\n";
  const CaseText text("base = 'base.toml'\n" + item + item);
  text.add("base.toml", sound_medium());
  const std::string twice = "case.toml:6:1: error: two [[medium.region]] are named 'far'; names must differ";
  EXPECT_EQ(text.faults(), twice);
  text.add("base.toml", sound_medium() + item);
  EXPECT_EQ(text.faults(), twice) << "the first is the base's item, changed";
}

TEST(CaseFile, HashTellsTextsAndOverridesApart) {
  std::string text = "[medium]\ndensity = 1\n";
  const auto hash = [](const std::string& t, const std::vector<std::string>& overrides) {
    const CaseText written(t);
    return CaseFile(written.folder(), overrides).hash();
  };
  const auto first = hash(text, {});
  EXPECT_EQ(hash(text, {}), first);
  EXPECT_NE(hash(text + "\n", {}), first);
  EXPECT_NE(hash(text, {"a.b=1"}), first);
  EXPECT_NE(hash(text, {"a.b=1", "c.d=2"}), hash(text, {"c.d=2", "a.b=1"}));
  EXPECT_NE(hash(text, {"a.b=1a.c=2"}), hash(text, {"a.b=1", "a.c=2"}));
}

TEST(CaseFile, OwnersReportFaultsAtTheirKeys) {
  const CaseText text(sound_medium());
  CaseFile file(text.folder(), {"medium.region.left.box.max=[0.5,1]"});
  read_medium(file);
  file.fault("medium.steps", "four");
  file.fault("medium.region.1.box.min", "one");
  file.fault("medium.region.right.name", "two");
  file.fault("medium.region.1", "three");
  file.fault("medium.region.0.box.max", "five");
  file.fault("nowhere", "zero");
  try {
    file.throw_if_faulty();
    FAIL();
  } catch (const BadInput& error) {
    std::vector<std::string> places;
    for (const auto& fault : error.errors())
      places.push_back(fmt::format("{}:{} {}", fault.line, fault.column, fault.message));
    EXPECT_THAT(places,
                ElementsAre("1:1 zero", "5:1 four", "17:1 three", "18:1 two", "20:1 one", "0:0 five"));
    EXPECT_EQ(error.errors().back().place, "--set medium.region.left.box.max=[0.5,1]");
  }
}

TEST(CaseFile, OfAnEmptyPathIsACaseWithoutSections) {
  CaseFile file("", {});
  Medium medium;
  file.read("medium", medium, "");
  EXPECT_FALSE(file.has("medium"));
  EXPECT_THROW(file.throw_if_faulty(), BadInput);
  EXPECT_NE(file.description().find("density"), std::string::npos);
}

}  // namespace
}  // namespace toryu
