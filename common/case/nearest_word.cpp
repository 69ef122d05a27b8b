#include "common/case/nearest_word.hpp"

#include <algorithm>

namespace toryu {

int edit_distance(std::string_view a, std::string_view b) {
  const std::size_t columns = b.size() + 1;
  std::vector<int> before_last(columns), last(columns), row(columns);
  for (std::size_t j = 0; j < columns; ++j) row[j] = static_cast<int>(j);
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::swap(before_last, last);
    std::swap(last, row);
    row[0] = static_cast<int>(i);
    for (std::size_t j = 1; j < columns; ++j) {
      const int replaced = last[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
      row[j] = std::min({replaced, last[j] + 1, row[j - 1] + 1});
      const bool swapped = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
      if (swapped) row[j] = std::min(row[j], before_last[j - 2] + 1);
    }
  }
  return row.back();
}

std::string nearest_word(std::string_view typed, const std::vector<std::string>& words) {
  std::string nearest;
  int smallest = 0;
  for (const auto& word : words) {
    const int distance = edit_distance(typed, word);
    const int allowed = std::max(1, static_cast<int>(std::max(typed.size(), word.size())) / 3);
    if (distance <= allowed && (nearest.empty() || distance < smallest)) {
      nearest = word;
      smallest = distance;
    }
  }
  return nearest;
}

std::string did_you_mean(std::string_view typed, const std::vector<std::string>& words) {
  const std::string nearest = nearest_word(typed, words);
  return nearest.empty() ? "" : "; did you mean '" + nearest + "'?";
}

std::string what_there_is(std::string_view asked, const std::vector<std::string>& names) {
  if (names.empty()) return "; there is none";
  const std::string hint = did_you_mean(asked, names);
  return hint.empty() ? "; there are " + quoted_list(names) : hint;
}

std::string quoted_list(const std::vector<std::string>& words) {
  std::string text;
  for (const auto& word : words) text += (text.empty() ? "'" : ", '") + word + "'";
  return text;
}

}  // namespace toryu
