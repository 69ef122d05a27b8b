/// The visitor that prints what a section may hold: key, default, allowed values, meaning.
#pragma once

#include <array>

#include "common/case/parameter_table.hpp"

namespace toryu {

class DescribeTable final : public ParameterTable {
 public:
  explicit DescribeTable(std::string path = "") : path_(std::move(path)) {}

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
  void require(bool, const std::string&, const std::string&) override {}

  /// The keys of this section in columns, then its sub-sections.
  std::string text() const;

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
  void add(const std::string& key, bool required, const std::string& initial, const std::string& allowed,
           const std::string& help);
  void add_section(const std::string& title, const std::string& key, const std::string& help,
                   const std::function<void(ParameterTable&)>& visit);
  std::string path_of(const std::string& key) const;

  std::string path_, sections_;
  std::vector<std::array<std::string, 4>> keys_;  ///< key, default, allowed, meaning
};

}  // namespace toryu
