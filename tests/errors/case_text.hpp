/// A case written to a folder of its own, and the faults that reading it collects.
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "tests/errors/example_section.hpp"

namespace toryu {

/// Names an instance of a parametrised test.
template <class Parameter>
std::string name_of(const testing::TestParamInfo<Parameter>& one) {
  return one.param.name;
}

/// A case without faults.
inline const std::string sound_scene =
    "[case]\ntitle = 'A'\nend_time = 1\ndomain = {min=[0,0], max=[2,2]}\n"
    "[[wall]]\nname = 'floor'\nbox = {min=[0,0], max=[2,1]}\n";

class CaseText {
 public:
  explicit CaseText(const std::string& text)
      : folder_(std::filesystem::temp_directory_path() /
                fmt::format("toryu_case_{}_{}", getpid(), ++count_)) {
    std::filesystem::create_directories(folder_);
    std::ofstream(folder_ / "case.toml") << text;
  }
  /// Another file beside the case.
  void add(const std::string& name, const std::string& text) const { std::ofstream(folder_ / name) << text; }
  ~CaseText() { std::filesystem::remove_all(folder_); }
  CaseText(const CaseText&) = delete;
  CaseText& operator=(const CaseText&) = delete;

  const std::filesystem::path& folder() const { return folder_; }

  /// What is thrown on reading [medium], with "case.toml" for the path of the file; empty if nothing.
  std::string faults(const std::vector<std::string>& overrides = {}) const {
    try {
      CaseFile file(folder_, overrides);
      Medium medium;
      file.read("medium", medium, "what fills the room");
      file.ignore_sections({"other"});
      file.throw_if_faulty();
    } catch (const BadInput& error) {
      return shortened(error.what());
    }
    return "";
  }
  /// The same for [case], [[wall]] and [[reference]].
  std::string scene_faults(const std::vector<std::string>& overrides = {}) const {
    try {
      CaseFile file(folder_, overrides);
      read_scene(file);
      file.ignore_sections({"fluid", "solid"});
      file.throw_if_faulty();
    } catch (const BadInput& error) {
      return shortened(error.what());
    }
    return "";
  }

 private:
  std::string shortened(std::string text) const {
    const std::string path = folder_.string() + "/";
    for (std::size_t at; (at = text.find(path)) != std::string::npos;) text.erase(at, path.size());
    return text;
  }
  static inline int count_ = 0;  ///< of this process, so that each case has a folder of its own
  std::filesystem::path folder_;
};

}  // namespace toryu
