#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>
#include <sstream>

#include "common/output/hdf5_file.hpp"
#include "common/run/provenance.hpp"
#include "tests/unit/common/output/sample_results.hpp"

namespace toryu {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

class Output : public testing::Test {
 protected:
  Output() {
    fs::remove_all(out);
    fs::create_directories(out);
  }
  ~Output() override { fs::remove_all(out); }

  std::string text(const std::string& name) const {
    std::ostringstream content;
    content << std::ifstream(out / name).rdbuf();
    return content.str();
  }
  std::vector<std::string> files() const {
    std::vector<std::string> names;
    for (const auto& entry : fs::recursive_directory_iterator(out))
      if (entry.is_regular_file()) names.push_back(entry.path().lexically_relative(out));
    std::sort(names.begin(), names.end());
    return names;
  }

  fs::path out = fs::path(testing::TempDir()) / ("output_" + std::to_string(getpid()));
};

TEST_F(Output, EachFrameIsAFileAndALineOfTheSeries) {
  FrameWriter writer(out, "fluid", sample::provenance);
  writer.write(0.0, sample::frame());
  writer.write(0.005, sample::frame());
  EXPECT_THAT(files(), ElementsAre("fluid.hdf.series", "frames/fluid_000000.hdf", "frames/fluid_000001.hdf"));
  EXPECT_EQ(text("fluid.hdf.series"),
            "{ \"file-series-version\": \"1.0\", \"files\": [\n"
            "  { \"name\": \"frames/fluid_000000.hdf\", \"time\": 0 },\n"
            "  { \"name\": \"frames/fluid_000001.hdf\", \"time\": 0.005 }\n] }\n");
}

TEST_F(Output, AFrameOfAFaultyFieldLeavesNoFile) {
  FrameWriter writer(out, "fluid", sample::provenance);
  Frame frame = sample::frame();
  frame.fields[0].values.pop_back();
  EXPECT_THROW(writer.write(0.0, frame), std::logic_error);
  EXPECT_THAT(files(), IsEmpty());
}

TEST_F(Output, AnHdfFileHasItsNameOnlyWhenFinished) {
  {
    HdfFile file(out / "a.h5");
    file.dataset("/x", std::vector<double>{1, 2}, 1, Stored::float64);
    EXPECT_THAT(files(), ElementsAre("a.h5.part"));
    file.finish();
  }
  EXPECT_THAT(files(), ElementsAre("a.h5"));
}

TEST_F(Output, AFolderThatCannotBeWrittenIsNamed) {
  try {
    HdfFile file(out / "absent" / "a.h5");
    FAIL() << "no exception";
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), HasSubstr((out / "absent" / "a.h5.part").string()));
  }
}

TEST_F(Output, ASeriesIsSeenWhileItGrowsAndNamedAtTheEnd) {
  {
    SeriesWriter series(out, "solid");
    series.write(0.0, {{"tip_x", "m", 0.1}, {"energy", "J/m", 2}});
    EXPECT_THAT(files(), ElementsAre("solid.csv.part"));
    series.write(0.1 + 0.2, {{"tip_x", "m", 1.0 / 3.0}, {"energy", "J/m", -1e-20}});
  }
  EXPECT_THAT(files(), ElementsAre("solid.csv"));
  EXPECT_EQ(text("solid.csv"),
            "time[s],tip_x[m],energy[J/m]\n0,0.1,2\n0.30000000000000004,0.3333333333333333,-1e-20\n");
}

TEST_F(Output, ASeriesWithoutRowsLeavesNothing) {
  { SeriesWriter series(out, "solid"); }
  EXPECT_THAT(files(), IsEmpty());
}

TEST_F(Output, ARowOfAnotherLengthIsABug) {
  SeriesWriter series(out, "solid");
  series.write(0.0, {{"tip_x", "m", 0.1}});
  EXPECT_THROW(series.write(0.1, {}), std::logic_error);
}

TEST_F(Output, TheSummaryEscapesTextAndKeepsFloatsFloats) {
  write_summary(out, sample::summary());
  const std::string summary = text("fluid_summary.toml");
  EXPECT_THAT(summary, HasSubstr("exit_code = 3\n"));
  EXPECT_THAT(summary,
              HasSubstr(R"(end_reason = "particle 7: \"speed\" = 1e3\n\u0009beyond C:\\limit \u0001")"));
  EXPECT_THAT(summary, HasSubstr("simulated_time = 2.0  # s\n"));
  EXPECT_THAT(summary, HasSubstr("\"wall tank_floor\" = 320\n"));
  EXPECT_THAT(summary, HasSubstr("smallest_time_step = inf"));
  EXPECT_THAT(files(), ElementsAre("fluid_summary.toml"));
}

}  // namespace
}  // namespace toryu
