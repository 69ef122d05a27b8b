/// The outlines of a drawing (SVG, DXF) by way of tools/toryu/outline.py, which knows the libraries that read
/// such files.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace toryu {

struct ToolAnswer {
  std::string rows;        ///< CSV: ring, x[m], y[m]
  std::string key, fault;  ///< what is wrong, and the key of the case that it is about; empty if nothing is
};

/// What the tool answers for the drawing `path`, which holds `text`, with further arguments. An answer that
/// is there already is taken from the user's cache ($XDG_CACHE_HOME/toryu, or ~/.cache/toryu), by a hash of
/// the text, the arguments and the tool; where nothing can be written there, the tool reads the drawing each
/// time.
ToolAnswer ask_drawing_tool(const std::filesystem::path& path, const std::string& text,
                            const std::vector<std::string>& arguments);

}  // namespace toryu
