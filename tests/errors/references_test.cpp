// The exact text of each fault of references, and of where results would go.
#include <gtest/gtest.h>

#include "tests/errors/case_text.hpp"

namespace toryu {
namespace {

TEST(SceneFaults, ReferenceElsewhere) {
  EXPECT_EQ(
      CaseText(sound_scene +
               "[[reference]]\nlabel = 'a'\nfile = '../b/a.csv'\nseries = 'fluid.csv:x'\ncolumn = 'x'\n")
          .scene_faults(),
      "case.toml:10:1: error: '../b/a.csv' must lie in the folder of the case");
}

TEST(SceneFaults, ReferenceWithoutFile) {
  EXPECT_EQ(CaseText(sound_scene +
                     "[[reference]]\nlabel = 'a'\nfile = 'none.csv'\nseries = 'fluid.csv:x'\ncolumn = 'x'\n")
                .scene_faults(),
            "case.toml:10:1: error: no file 'none.csv' in the folder of the case");
}

struct ReferenceFile {
  std::string name, text, expected;
};

class ReferenceFaults : public testing::TestWithParam<ReferenceFile> {};

TEST_P(ReferenceFaults, HaveTheirText) {
  const CaseText text(sound_scene +
                      "[[reference]]\nlabel = 'a'\nfile = 'tip.csv'\nseries = 'solid.csv:tip_y[m]'\n"
                      "column = 'y[m]'\n");
  text.add("tip.csv", GetParam().text);
  EXPECT_EQ(text.scene_faults(), GetParam().expected);
}

INSTANTIATE_TEST_SUITE_P(
    Kinds, ReferenceFaults,
    testing::Values(
        ReferenceFile{"None", "# by hand\r\nt[s],y[m]\r\n\r\n0,0\r\n 0.1 , +1e-3\r\n", ""},
        ReferenceFile{"NoneInQuotes", "\xEF\xBB\xBF\"t, of the run\",\"y[m]\"\n0,\"0\"\n", ""},
        ReferenceFile{"NoneWithGaps", "t[s],y[m]\n0,\n0.1,nan\n0.2,1", ""},
        ReferenceFile{"Empty", "", "case.toml:10:1: error: 'tip.csv' is empty"},
        ReferenceFile{"CommentsAlone", "# t[s],y[m]\n\n", "case.toml:10:1: error: 'tip.csv' is empty"},
        ReferenceFile{"HeadAlone", "t[s],y[m]\n",
                      "case.toml:10:1: error: 'tip.csv' holds no number in the column 'y[m]'"},
        ReferenceFile{"GapsAlone", "t[s],y[m]\n0,\n1,inf\n",
                      "case.toml:10:1: error: 'tip.csv' holds no number in the column 'y[m]'"},
        ReferenceFile{"Text", "t[s],y[m]\n0,1\n# so\n1,b\n",
                      "tip.csv:4:1: error: 'b' is no number, in the column 'y[m]'"},
        ReferenceFile{"TextForTime", "t[s],y[m]\nnow,1\n",
                      "tip.csv:2:1: error: 'now' is no number, in the column 't[s]'"},
        ReferenceFile{"DecimalCommas", "t[s],y[m]\n0,01,0,5\n",
                      "tip.csv:2:1: error: 4 cells in a row under 2 columns"},
        ReferenceFile{
            "Semicolons", "t[s];y[m]\n0;0\n",
            "case.toml:12:1: error: no column 'y[m]' in 'tip.csv'; commas part its columns, and its "
            "numbers have points"},
        ReferenceFile{"ColumnNearAnother", "t[s],y [m]\n0,0\n",
                      "case.toml:12:1: error: no column 'y[m]' in 'tip.csv'; did you mean 'y [m]'?"},
        ReferenceFile{"ColumnNearNone", "time,load[N]\n0,0\n",
                      "case.toml:12:1: error: no column 'y[m]' in 'tip.csv'; its columns are 'time', "
                      "'load[N]'"},
        ReferenceFile{"ColumnTwice", "t[s],y[m],y[m]\n0,0,1\n",
                      "case.toml:12:1: error: 'tip.csv' has two columns 'y[m]'"},
        ReferenceFile{"Utf16", "\xFF\xFEt",
                      "case.toml:10:1: error: 'tip.csv' is UTF-16 text: save it as UTF-8"}),
    name_of<ReferenceFile>);

std::string reference_faults(const std::string& file, const std::string& series, const std::string& column) {
  const CaseText text(sound_scene + "[[reference]]\nlabel = 'a'\nfile = '" + file + "'\nseries = '" + series +
                      "'\ncolumn = '" + column + "'\n");
  for (const char* name : {"tip.csv", "fluid.csv"}) text.add(name, "t[s],y[m]\n0,0\n");
  std::filesystem::create_directory(text.folder() / "folder.csv");
  return text.scene_faults();
}

TEST(ReferenceFault, OfTheNames) {
  EXPECT_EQ(reference_faults("tip.csv", "solid.csv:tip_y[m]", "y"),
            "case.toml:12:1: error: no column 'y' in 'tip.csv'; did you mean 'y[m]'?");
  EXPECT_EQ(reference_faults("tip.csv", "tip_y[m]", "y[m]"),
            "case.toml:11:1: error: 'series' must be FILE.csv:COLUMN, such as "
            "'solid.csv:tip_displacement_x[m]', found 'tip_y[m]'");
  EXPECT_EQ(reference_faults("tip.csv", "", "y[m]"),
            "case.toml:11:1: error: 'series' in [[reference]] must not be empty");
  EXPECT_EQ(reference_faults("", "solid.csv:tip_y[m]", ""),
            "case.toml:10:1: error: 'file' in [[reference]] must not be empty\n"
            "case.toml:12:1: error: 'column' in [[reference]] must not be empty");
  EXPECT_EQ(
      reference_faults("tip.csv", "sold.csv:tip_y[m]", "y[m]"),
      "case.toml:11:1: error: no series 'sold.csv'; there are 'fluid', 'solid', 'coupler'; did you mean "
      "'solid'?");
  EXPECT_EQ(reference_faults("folder.csv", "solid.csv:tip_y[m]", "y[m]"),
            "case.toml:10:1: error: no file 'folder.csv' in the folder of the case");
  EXPECT_EQ(
      reference_faults("./fluid.csv", "solid.csv:tip_y[m]", "y[m]"),
      "case.toml:10:1: error: './fluid.csv' is the name of a file of the results, beside which a copy of "
      "it is kept; give it another name or put it into a folder");
}

TEST(ReferenceFault, OfAnyNameThatARunWritesOrRemoves) {
  for (const char* name :
       {"fluid.csv", "coupler.csv.part", "solid_summary.toml", "frames/a.hdf", "surface.h5.rows.part",
        "run.lock", "launch.lock", "run.secret", "stop", "./report.html"})
    EXPECT_TRUE(is_written_by_runs(name)) << name;
  for (const char* name : {"tip.csv", "reference/fluid.csv", "run.secrets"})
    EXPECT_FALSE(is_written_by_runs(name)) << name;
}

TEST(FolderFault, IsACaseThatARunWouldWriteOver) {
  const CaseText text("");
  const auto faults = [&](const std::string& file, const std::string& out) -> std::string {
    text.add(file, "base = 'log.txt'\n" + sound_scene);
    CaseFile read(text.folder() / file, {});
    read_scene(read);
    check_folder(read, out);
    try {
      read.throw_if_faulty();
    } catch (const BadInput& error) {
      return error.what();
    }
    return "";
  };
  text.add("log.txt", "");
  const std::string folder = text.folder(), words = ": error: a run with its results in '" + folder + "' ";
  EXPECT_EQ(faults("used_case.toml", folder + "/out"), "");
  EXPECT_TRUE(faults("mine.toml", folder).starts_with(folder + "/log.txt" + words));
  EXPECT_TRUE(faults("used_case.toml", folder).starts_with(folder + "/used_case.toml" + words));
  std::filesystem::create_directory_symlink(folder, folder + "/link");
  EXPECT_NE(faults("used_case.toml", folder + "/link"), "");
}

}  // namespace
}  // namespace toryu
