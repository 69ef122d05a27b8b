/// A file that a case names.
#pragma once

#include <filesystem>
#include <string>

namespace toryu {

struct InputFile {
  std::string name;                 ///< as the case has it, relative to the folder of the case; empty: none
  std::filesystem::path path = {};  ///< where it is
  std::string text = {};            ///< what it holds
};

/// Why a case cannot name a file so: it must lie in the folder of the case and be there. Empty if it can.
std::string fault_of_name(const std::filesystem::path& folder, const std::string& name);

}  // namespace toryu
