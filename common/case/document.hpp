/// The parsed text of a case file. Each node and each key knows where it was written: at a line and column of
/// the file, or in an override, whose text then stands where a file's name would.
#pragma once

#include <toml++/toml.h>

#include <optional>
#include <string>
#include <vector>

#include "common/error/failure.hpp"

namespace toryu {

/// Parses `text`, which was found at `place` (a file's name, an override). Throws BadInput if it is not TOML,
/// or deeper than depth.hpp allows.
toml::table parse_document(const std::string& text, const std::string& place);

/// Puts what `changes` says into `base`: sections key by key; an item of a list of sections into the item of
/// the same `name`, else behind the others; anything else in place of what stood there.
void merge_document(toml::table& base, toml::table&& changes);

/// The place of an override as a user typed it.
std::string override_place(const std::string& text);

/// A fault at a place of the file (line and column) or of an override (none).
InputError fault_at(const toml::source_region& place, const std::string& message);

/// Where `path` ("region.1.box") was written, or what it holds in braces was changed; if it goes deeper than
/// `table`, the deepest place on the way; `otherwise` if nothing of it is there.
toml::source_region place_of(const toml::table& table, const std::string& path,
                             const toml::source_region& otherwise);

/// The parts of a dotted path. What stands in double quotes, which stay, is one part.
std::vector<std::string> split_path(const std::string& path);

/// The index of the item of an array of tables that `part` means: a number from 0, or the item's `name`, in
/// double quotes even one that reads as a number.
std::string quoted(const std::string& name);
std::optional<std::size_t> item_index(const toml::array& array, const std::string& part);

/// JSON, with Infinity and NaN for numbers that are not finite, as Python reads it.
std::string json_text(const toml::node& node);

/// What a node is, for a user: `the text "abc"`, `the number 0.5`, `a section`.
std::string found(const toml::node& node);

}  // namespace toryu
