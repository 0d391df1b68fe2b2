// Which name was probably meant by a word that is none of them.
#pragma once

#include <string>
#include <vector>

namespace roboss {

/// The name that is most like the word; empty: none is much like it.
std::string similar_to(const std::string& word, const std::vector<std::string>& names);

/// "did you mean 'NAME'?", or `otherwise` if no name is much like the word.
std::string did_you_mean(const std::string& word, const std::vector<std::string>& names,
                         const std::string& otherwise);

}  // namespace roboss
