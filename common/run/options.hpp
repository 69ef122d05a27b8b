/// The options that the three programs share.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "common/run/network.hpp"

namespace toryu {

struct Options {
  std::filesystem::path case_path;     ///< the case file; empty for `describe` without a case
  std::filesystem::path out;           ///< default: out/<case name>
  std::vector<std::string> overrides;  ///< --set section.key=value, and --end-time as one of them
  int threads = 0;                     ///< at most; 0: all cores
  std::string log_level = "info";
  Network network = {};                     ///< of a coupled run
  bool check = false;                       ///< read and check the case, then end
  bool outlook = false;                     ///< with `check`: tell what a run would take
  bool columns = false;                     ///< with `check`: list the columns of the series
  std::filesystem::path start_frames = {};  ///< with `check`: where the particles at the start go, as frames
  bool describe = false;                    ///< print the parameters, then end
  bool print_case = false;                  ///< print the case as it is read, then end
  bool resolved = false;                    ///< print what the case comes to for other programs, then end
  bool restart = false;                     ///< go on from the newest checkpoint in `out`
  bool overwrite = false;                   ///< replace results that `out` holds
  std::filesystem::path record = {};        ///< results of the run that a replayed_... answers with
};

/// Parses a command line without the program's name; `--version`, `--help` and
/// `--can-checkpoint` are not among them. Throws
/// BadInput with all that is wrong.
Options parse_options(const std::string& role, const std::vector<std::string>& arguments);
/// The text of `--help`.
std::string help_text(const std::string& role);

}  // namespace toryu
