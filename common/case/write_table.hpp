/// The visitor that writes a section with all its values, defaults included, as TOML that reads back to the
/// same parameters. A number that is not finite can only be a default, which reading restores: it is left
/// out.
#pragma once

#include "common/case/parameter_table.hpp"

namespace toryu {

class WriteTable final : public ParameterTable {
 public:
  explicit WriteTable(std::string path = "") : path_(std::move(path)) {}

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
  bool wants(bool given) const override { return given; }
  void require(bool, const std::string&, const std::string&) override {}

  /// The keys of this section, then its sub-sections, as TOML wants them.
  std::string text() const { return keys_ + sections_; }

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
  void add(const std::string& key, const std::string& value) { keys_ += key + " = " + value + "\n"; }
  void add_section(const std::string& header, const std::string& path,
                   const std::function<void(ParameterTable&)>& visit);
  std::string path_of(const std::string& key) const;

  std::string path_, keys_, sections_;
};

}  // namespace toryu
