// What the overrides of --set do to a case; the text of their faults is tested in tests/errors.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/errors/case_text.hpp"

namespace toryu {
namespace {

using testing::ElementsAre;

Medium read_with(const std::vector<std::string>& overrides) {
  const CaseText text(R"([medium]
density = 1
label = "old"
wind = [1, 2]
[[medium.region]]
name = "left"
box = { min = [0, 0], max = [1, 1] }
[[medium.region]]
name = "right"
box = { min = [1, 0], max = [2, 1] }
)");
  CaseFile file(text.folder(), overrides);
  Medium medium;
  file.read("medium", medium, "");
  file.throw_if_faulty();
  return medium;
}

TEST(Override, ReplacesValuesOfEachKind) {
  const Medium medium =
      read_with({"medium.density=2.5e3", "medium.steps=9", "medium.open=true", "medium.wind=[3,4]",
                 "medium.law='quadratic'", "medium.loads=[]", "medium.history=[[0,1],[2,3]]"});
  EXPECT_EQ(medium.density, 2500);
  EXPECT_EQ(medium.steps, 9);
  EXPECT_TRUE(medium.open);
  EXPECT_EQ(medium.wind, Vec(3, 4));
  EXPECT_EQ(medium.law, Law::quadratic);
  EXPECT_TRUE(medium.loads.empty());
  EXPECT_THAT(medium.history, ElementsAre(ElementsAre(0, 1), ElementsAre(2, 3)));
}

TEST(Override, NeedsNoQuotesForText) {
  EXPECT_EQ(read_with({"medium.label=a new = label"}).label, "a new = label");
  EXPECT_EQ(read_with({"medium.label='12'"}).label, "12");
  EXPECT_EQ(read_with({"medium.label="}).label, "");
  EXPECT_EQ(read_with({"medium.label=x\ny = 1"}).label, "x\ny = 1");
  EXPECT_EQ(read_with({"medium.label=1\ny = 1"}).label, "1\ny = 1");
  EXPECT_EQ(read_with({"medium.law=quadratic"}).law, Law::quadratic);
}

TEST(Override, SwitchesASectionOnAndOff) {
  EXPECT_FALSE(read_with({}).drag);
  EXPECT_EQ(read_with({"medium.drag.coefficient=0.5"}).drag->coefficient, 0.5);
  EXPECT_EQ(read_with({"medium.drag={}"}).drag->coefficient, 1);
  EXPECT_FALSE(read_with({"medium.drag={}", "medium.drag=false"}).drag);
  EXPECT_EQ(read_with({"medium.drag=false", "medium.drag.coefficient=0.5"}).drag->coefficient, 0.5);
}

TEST(Override, FindsItemsByNumberAndByName) {
  const Medium medium = read_with({"medium.region.0.box.max=[0.5,1]", "medium.region.right.name=end",
                                   "medium.region.end.box.max=[3,1]", "medium.wind.1=7"});
  EXPECT_EQ(medium.regions[0].box.max, Vec(0.5, 1));
  EXPECT_EQ(medium.regions[1].name, "end");
  EXPECT_EQ(medium.regions[1].box.max, Vec(3, 1));
  EXPECT_EQ(medium.wind, Vec(1, 7));
}

TEST(Override, ReplacesWholeListsAndItems) {
  EXPECT_TRUE(read_with({"medium.region=[]"}).regions.empty());
  const Medium medium = read_with({"medium.region.1={ name = 'top', box = { min = [0,1], max = [1,2] } }"});
  EXPECT_EQ(medium.regions[1].name, "top");
  EXPECT_EQ(medium.regions[1].box.min, Vec(0, 1));
}

TEST(Override, LaterOnesCountMore) {
  EXPECT_EQ(read_with({"medium.steps=3", "medium.steps=4"}).steps, 4);
}

}  // namespace
}  // namespace toryu
