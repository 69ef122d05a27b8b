/// What of a text from elsewhere reaches a terminal.
#include "common/error/printable.hpp"

#include <gtest/gtest.h>

namespace toryu {
namespace {

TEST(Printable, LeavesTextAsItIs) {
  for (const char* good : {"", "plain, \ttab\nand line", "größe 砥粒 \U0001F600", "\u00a0"})
    EXPECT_EQ(printable(good), good);
}

TEST(Printable, EscapesWhatATerminalObeys) {
  EXPECT_EQ(printable("\x1b[31mred\x07\x7f"), R"(\x1b[31mred\x07\x7f)");
  EXPECT_EQ(printable("\xc2\x9b"
                      "31m"),
            R"(\xc2\x9b31m)")
      << "a control of 8 bits";
  EXPECT_EQ(printable(std::string_view("a\0b", 3)), R"(a\x00b)");
}

TEST(Printable, EscapesWhatIsNoText) {
  EXPECT_EQ(printable("gr\xf6\xdf"
                      "e"),
            R"(gr\xf6\xdfe)")
      << "Latin-1";
  EXPECT_EQ(printable("\xc0\xaf \xed\xa0\x80"), R"(\xc0\xaf \xed\xa0\x80)") << "overlong, half a pair";
  EXPECT_EQ(printable("\xf5\x80\x80\x80"), R"(\xf5\x80\x80\x80)") << "beyond the last character";
  EXPECT_EQ(printable("cut \xe7\xa0"), R"(cut \xe7\xa0)");
}

}  // namespace
}  // namespace toryu
