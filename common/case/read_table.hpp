/// The visitor that reads a section of a case file into its owner's parameters and collects what is wrong.
#pragma once

#include <filesystem>

#include "common/case/document.hpp"
#include "common/case/parameter_table.hpp"

namespace toryu {

/// Where what is read stands, and where faults of it go.
struct Reading {
  std::filesystem::path folder;  ///< of the case
  std::vector<InputError>& faults;
};

class ReadTable final : public ParameterTable {
 public:
  /// `table` is null where the case has no such section; `path` is its dotted name, `where` the same for a
  /// message (" in [[fluid.region]]", nothing for the whole file), `place` where a missing key is reported.
  ReadTable(const toml::table* table, std::string path, std::string where, toml::source_region place,
            const Reading& reading);

  bool reads() const override { return true; }
  void number(const std::string& key, double& value, const NumberRule& rule) override;
  void integer(const std::string& key, int& value, const NumberRule& rule) override;
  void flag(const std::string& key, bool& value, const std::string& help) override;
  void text(const std::string& key, std::string& value, const TextRule& rule) override;
  void texts(const std::string& key, std::vector<std::string>& value, const TextRule& rule) override;
  void vector(const std::string& key, Vec& value, const NumberRule& rule) override;
  void rows(const std::string& key, std::vector<std::vector<double>>& value,
            const std::vector<std::string>& columns, const TextRule& rule) override;
  void tables(const std::string& key, std::vector<std::vector<std::vector<double>>>& value,
              const std::vector<std::string>& columns, const TextRule& rule) override;
  void file(const std::string& key, InputFile& value, const TextRule& rule) override;
  void require(bool holds, const std::string& key, const std::string& message) override;

  /// Reports the keys that no parameter has asked for.
  void report_unknown_keys();
  /// The keys asked for so far.
  const std::vector<std::string>& known() const { return known_; }

 protected:
  void word(const std::string& key, int& index, const std::vector<std::string>& words,
            const TextRule& rule) override;
  bool section(const std::string& key, const SectionRule& rule,
               const std::function<void(ParameterTable&)>& visit) override;
  void required_section(const std::string& key, const std::string& help,
                        const std::function<void(ParameterTable&)>& visit) override;
  void items(const std::string& key, std::size_t count, const std::string& help,
             const std::function<void(std::size_t)>& resize,
             const std::function<void(std::size_t, ParameterTable&)>& visit) override;

 private:
  const toml::node* find(const std::string& key, bool required, const std::string& kind,
                         const std::string& help);
  toml::source_region place_of_key(const std::string& key) const;
  void fault(const toml::source_region& place, const std::string& message);
  void wrong_type(const std::string& key, const std::string& kind, const toml::node& node,
                  const toml::source_region& place);
  std::optional<double> checked_number(const std::string& key, const toml::node& node, const NumberRule& rule,
                                       const toml::source_region& place);
  std::optional<std::string> checked_text(const std::string& key, const toml::node& node,
                                          const std::vector<std::string>& allowed,
                                          const toml::source_region& place);
  std::optional<std::vector<double>> checked_numbers(const std::string& key, const toml::node& node,
                                                     std::size_t count, const NumberRule& rule,
                                                     const std::string& kind,
                                                     const toml::source_region& place);
  std::optional<std::vector<std::vector<double>>> checked_rows(const std::string& key, const toml::node& node,
                                                               std::size_t columns, const std::string& kind,
                                                               const toml::source_region& place);
  void read_rows_of_file(const std::string& key, const std::string& name,
                         const std::vector<std::string>& columns, std::vector<std::vector<double>>& value);
  void read_section(const toml::table* table, const std::string& key,
                    const std::function<void(ParameterTable&)>& visit);
  void require_names_differ(const toml::array& items, const std::string& header);
  std::string path_of(const std::string& key) const;

  const toml::table* table_;
  std::string path_, where_;
  toml::source_region place_;
  Reading reading_;
  std::vector<InputError>& faults_;
  std::vector<std::string> known_;
  /// Faults there were before this section, plus those of its own joint checks.
  std::size_t faults_apart_;
};

}  // namespace toryu
