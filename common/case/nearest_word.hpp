/// "Did you mean": the word of a list that is nearest to a mistyped one.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace toryu {

/// Edits that turn `a` into `b`: insert, delete, replace, or swap two neighbours (Damerau 1964, Levenshtein
/// 1966; no letter is edited twice).
int edit_distance(std::string_view a, std::string_view b);

/// The first of the `words` at the smallest distance from `typed`, or nothing if more than a third of the
/// letters would have to change.
std::string nearest_word(std::string_view typed, const std::vector<std::string>& words);

/// "; did you mean 'density'?", or nothing if no word is near.
std::string did_you_mean(std::string_view typed, const std::vector<std::string>& words);

/// What a name that was asked for could have been: the nearest of those that are there, or all of them, ";
/// there are 'a', 'b'", or "; there is none".
std::string what_there_is(std::string_view asked, const std::vector<std::string>& names);

/// "'a', 'b', 'c'"
std::string quoted_list(const std::vector<std::string>& words);

}  // namespace toryu
