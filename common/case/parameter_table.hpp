/// The parameter table: one description of each section of a case file feeds parsing, checks, `--describe`
/// and `used_case.toml`. A module describes its parameters once, as
///
///     void describe(ParameterTable& table, ArtificialViscosity& p) {
///       table.number("alpha", p.alpha, {.unit = "1", .minimum = 0, .help = "linear coefficient"});
///     }
///
/// The value that the struct holds before the call is the default; `required` says that there is none.
/// Nothing here knows a physical term: the owner of a section describes it.
#pragma once

#include <functional>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "common/case/input_file.hpp"
#include "common/vector.hpp"

namespace toryu {

/// What is said of one number or vector.
struct NumberRule {
  std::string unit = "1";
  double minimum = -std::numeric_limits<double>::infinity();
  double maximum = std::numeric_limits<double>::infinity();
  bool above_minimum = false;  ///< the minimum itself is not allowed
  bool required = false;
  std::string help = {};
};

struct TextRule {
  bool required = false;
  std::string help = {};
  std::vector<std::string> allowed = {};  ///< the only words that `text` and `texts` take; empty: any
  bool names_columns =
      false;  ///< results put it into the names of columns: not empty, no , ; [ ] " or line break
};

/// What it means that a case does not mention an optional section: the model is left out, or taken with its
/// defaults and left out by `false` alone.
enum class Absence { leaves_out, takes_defaults };

/// What is said of an optional section.
struct SectionRule {
  bool present = false;  ///< in the value that is described
  Absence absence = Absence::leaves_out;
  std::string help = {};
};

/// Visits the parameters of a section. There are three visitors: read_table.hpp, describe_table.hpp and
/// write_table.hpp.
class ParameterTable {
 public:
  virtual ~ParameterTable() = default;

  virtual void number(const std::string& key, double& value, const NumberRule& rule) = 0;
  virtual void integer(const std::string& key, int& value, const NumberRule& rule) = 0;
  virtual void flag(const std::string& key, bool& value, const std::string& help) = 0;
  virtual void text(const std::string& key, std::string& value, const TextRule& rule) = 0;
  virtual void texts(const std::string& key, std::vector<std::string>& value, const TextRule& rule) = 0;
  /// An array of `dim` numbers; none by default if those of `value` are no numbers (NaN).
  virtual void vector(const std::string& key, Vec& value, const NumberRule& rule) = 0;
  /// Rows of numbers, each as long as `columns` (names with units): a table of time and velocity, say. A case
  /// may name a CSV file beside it that has such columns.
  virtual void rows(const std::string& key, std::vector<std::vector<double>>& value,
                    const std::vector<std::string>& columns, const TextRule& rule) = 0;

  /// Several such tables: the rings of a polygon's holes, say.
  virtual void tables(const std::string& key, std::vector<std::vector<std::vector<double>>>& value,
                      const std::vector<std::string>& columns, const TextRule& rule) = 0;
  /// A file in the folder of the case, read at once. The key must be called `file`, by which the case knows
  /// what it names (CaseFile::named_files).
  virtual void file(const std::string& key, InputFile& value, const TextRule& rule) = 0;

  /// One of a few words. The order of `words` is that of the enum's values.
  template <class Enum>
  void choice(const std::string& key, Enum& value, const std::vector<std::string>& words,
              const TextRule& rule) {
    int index = static_cast<int>(value);
    word(key, index, words, rule);
    value = static_cast<Enum>(index);
  }

  /// A sub-table that switches a model on by being there: `[fluid.density_diffusion]`. `false` in its place
  /// is the same as its absence.
  template <class Parameters>
  void optional(const std::string& key, std::optional<Parameters>& value, const std::string& help,
                Absence absence = Absence::leaves_out) {
    Parameters inner = value.value_or(Parameters{});
    const auto visit = [&](ParameterTable& t) { describe(t, inner); };
    if (section(key, {value.has_value(), absence, help}, visit))
      value = std::move(inner);
    else
      value.reset();
  }

  /// A sub-table that is always there, with its defaults where the case says nothing.
  template <class Parameters>
  void group(const std::string& key, Parameters& value, const std::string& help) {
    required_section(key, help, [&](ParameterTable& t) { describe(t, value); });
  }

  /// An array of tables: `[[wall]]`. Each item is described by `describe`.
  template <class Parameters>
  void list(const std::string& key, std::vector<Parameters>& values, const std::string& help) {
    items(
        key, values.size(), help, [&](std::size_t count) { values.resize(count); },
        [&](std::size_t index, ParameterTable& t) {
          if (index < values.size()) {
            describe(t, values[index]);
          } else {
            Parameters pattern;
            describe(t, pattern);
          }
        });
  }

  /// A check that joins several parameters ("max must exceed min"); reported at `key`, which may be a path
  /// ("box.max"), only when reading, and not if a parameter of the section is faulty by itself.
  virtual void require(bool holds, const std::string& key, const std::string& message) = 0;

  /// Whether to visit a key that few items have: what is written leaves it out unless it is `given`.
  virtual bool wants(bool /*given*/) const { return true; }
  /// Whether values are read, so that what they come to is worth finding.
  virtual bool reads() const { return false; }

 protected:
  virtual void word(const std::string& key, int& index, const std::vector<std::string>& words,
                    const TextRule& rule) = 0;
  /// Visits the sub-table `key` if it is there (read), always (describe) or if `present` (write). Says
  /// whether the model is taken.
  virtual bool section(const std::string& key, const SectionRule& rule,
                       const std::function<void(ParameterTable&)>& visit) = 0;
  virtual void required_section(const std::string& key, const std::string& help,
                                const std::function<void(ParameterTable&)>& visit) = 0;
  virtual void items(const std::string& key, std::size_t count, const std::string& help,
                     const std::function<void(std::size_t)>& resize,
                     const std::function<void(std::size_t, ParameterTable&)>& visit) = 0;
};

}  // namespace toryu
