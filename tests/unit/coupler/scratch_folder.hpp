/// A folder of its own for a test, removed at its end.
#pragma once

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <sstream>

namespace toryu {

struct ScratchFolder {
  ScratchFolder() { std::filesystem::create_directories(path); }
  ~ScratchFolder() { std::filesystem::remove_all(path); }
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;

  std::string text_of(const std::string& file) const {
    std::ostringstream text;
    text << std::ifstream(path / file).rdbuf();
    return text.str();
  }

  std::filesystem::path path =
      std::filesystem::temp_directory_path() /
      fmt::format("toryu_{}_{}", testing::UnitTest::GetInstance()->current_test_info()->name(), getpid());
};

}  // namespace toryu
