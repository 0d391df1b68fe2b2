// Texts that are alike: which name was probably meant by a word that is none of them, and what messages about
// different things have in common.
#pragma once

#include <string>
#include <vector>

namespace roboss {

/// The name that is most like the word; empty: none is much like it.
std::string similar_to(const std::string& word, const std::vector<std::string>& names);

/// "did you mean 'NAME'?", or `otherwise` if no name is much like the word.
std::string did_you_mean(const std::string& word, const std::vector<std::string>& names,
                         const std::string& otherwise);

/// At most `most` names, the most alike first: those that share most pairs of neighbouring letters with the
/// word. For long names such as topics, where a word may lack whole parts.
std::vector<std::string> most_alike(const std::string& word, const std::vector<std::string>& names,
                                    std::size_t most);

/// The text without what stands in quotes, and without digits: equal for "robot 'a' has 3 wheels" and "robot
/// 'b' has 4".
std::string pattern_of(const std::string& text);

}  // namespace roboss
