#include "common/case/input_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "common/case/nearest_word.hpp"
#include "common/case/text_file.hpp"

namespace toryu {

namespace {

/// The names of the files in the folder of `path`, as a case that lies in `folder` gives them.
std::vector<std::string> files_beside(const std::filesystem::path& folder,
                                      const std::filesystem::path& path) {
  std::vector<std::string> names;
  std::error_code none;
  const auto place = (folder / path).parent_path();
  for (auto entry = std::filesystem::directory_iterator(place, none);
       !none && entry != std::filesystem::directory_iterator(); entry.increment(none))
    if (is_file(entry->path())) names.push_back((path.parent_path() / entry->path().filename()).string());
  std::sort(names.begin(), names.end());
  return names;
}

}  // namespace

std::string fault_of_name(const std::filesystem::path& folder, const std::string& name) {
  const std::filesystem::path path(name);
  for (const auto& part : path)
    if (path.is_absolute() || part == "..")
      return fmt::format("'{}' must lie in the folder of the case", name);
  if (is_file(folder / path)) return "";
  return fmt::format("no file '{}' in the folder of the case{}", name,
                     did_you_mean(name, files_beside(folder, path)));
}

}  // namespace toryu
