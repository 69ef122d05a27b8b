/// A case file with the overrides of `--set`, read section by section by the owners of the sections.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "common/case/parameter_table.hpp"
#include "common/error/failure.hpp"

namespace toryu {

/// What a file describes. A study is told by its table [study], a case by its sections.
enum class Kind { study, coupled, fluid, solid, empty };

/// The file that a user means by `path`: a case.toml, or a folder that holds one. Throws BadInput if there is
/// none.
std::filesystem::path find_case_file(const std::filesystem::path& path);
/// The name of a case: that of its folder, with "_NAME" unless the file is called case.toml.
std::string case_name(const std::filesystem::path& file);

class CaseFile {
 public:
  /// Reads `path` (as in find_case_file) and applies `overrides` ("fluid.sound_speed=30", see overrides.hpp).
  /// A file with `base = "case.toml"` says only in what it differs from that case beside it (merge_document).
  /// Throws BadInput if a file is not there or is not TOML. An empty path is a case without a section,
  /// whose description can be asked for.
  CaseFile(const std::filesystem::path& path, const std::vector<std::string>& overrides);
  ~CaseFile();

  Kind kind() const;
  /// Whether the section ("solid.damping") is there, and not `false`.
  bool has(const std::string& section) const;

  /// Reads a top-level section (a table, or an array of tables for `list`) by its owner's description; faults
  /// are collected, not thrown.
  template <class Parameters>
  void read(const std::string& section, Parameters& value, const std::string& help) {
    visit([&](ParameterTable& t) { t.group(section, value, help); });
  }
  template <class Parameters>
  void read_list(const std::string& section, std::vector<Parameters>& values, const std::string& help) {
    visit([&](ParameterTable& t) { t.list(section, values, help); });
  }

  /// Top-level sections that belong to another participant and are not looked into.
  void ignore_sections(const std::vector<std::string>& sections);
  /// A value (double, bool, std::string) in a section that belongs to another participant ("fluid.spacing",
  /// "solid.region[0].box.min[1]"), if it is there: for checks and estimates, never for what is computed.
  template <class Value>
  std::optional<Value> value(const std::string& path) const;
  /// Reads the item at `path` ("solid.region[0]") as its owner's description has it, for the same purposes.
  /// Faults are left to the owner.
  void look(const std::string& path, const std::function<void(ParameterTable&)>& description) const;
  /// How many items the list of another participant ("solid.region") has.
  std::size_t count(const std::string& list) const;
  /// Adds a fault that the owner of a section found by itself, at the place of `key`: a path with items by
  /// number or name ("fluid.region.0.box").
  void fault(const std::string& key, const std::string& message);
  /// What `make`, which is of the owner of `section`, gives; a BadKey that it throws is told at its place.
  template <class Make>
  auto placed(const std::string& section, const Make& make) {
    try {
      return make();
    } catch (const BadKey& bad) {
      fault(bad.key().starts_with('.') ? section + bad.key() : bad.key(), bad.message());
      throw_if_faulty();
      throw;
    }
  }
  /// Adds a fault of another file that the case names.
  void fault(const InputError& fault);
  /// Throws BadInput with all faults, unknown top-level sections among them, sorted by line.
  void throw_if_faulty() const;

  /// The case as TOML, with its base merged and the overrides applied, whether or not anyone reads its
  /// sections. Throws BadInput with the faults of the overrides.
  std::string merged() const;
  /// The same as JSON, with the kind, the name, the files that were read and the place of every key.
  std::string resolved() const;
  /// The sections read so far with every value, defaults included, as TOML that repeats the run.
  std::string used() const;
  /// The sections read so far as a table of key, unit, default, range and help.
  std::string description() const;

  /// A hash of the text, the overrides and the files that the case names, equal in all participants of a run.
  std::uint64_t hash() const;
  /// The files that were read: the case's own and its base.
  const std::vector<std::filesystem::path>& inputs() const;
  /// The files beside it that the case names in any of its sections, tables and drawings by their endings,
  /// others by a key `file`: relative to its folder, sorted; none that is not there.
  std::vector<std::string> named_files() const;
  /// The folder of the file: paths in a case are relative to it.
  std::filesystem::path folder() const;
  /// The folder's name: the case's.
  std::string name() const;

 private:
  void visit(const std::function<void(ParameterTable&)>& description);
  void throw_if_overrides_faulty() const;
  struct Content;
  std::unique_ptr<Content> content_;
};

}  // namespace toryu
