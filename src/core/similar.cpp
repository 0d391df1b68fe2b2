// See similar.h.
#include "core/similar.h"

#include <algorithm>
#include <cctype>
#include <numeric>
#include <utility>

namespace roboss {
namespace {

/// Letters to change, add, leave out, or swap with their neighbour, from one word to the other (Damerau
/// 1964).
std::size_t distance(const std::string& a, const std::string& b) {
    std::vector<std::size_t> older, before(b.size() + 1), now(b.size() + 1);
    std::iota(before.begin(), before.end(), std::size_t{0});
    for (std::size_t i = 1; i <= a.size(); ++i) {
        now[0] = i;
        for (std::size_t j = 1; j <= b.size(); ++j) {
            now[j] =
                std::min({before[j] + 1, now[j - 1] + 1, before[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1)});
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
                now[j] = std::min(now[j], older[j - 2] + 1);
        }
        older = std::exchange(before, now);
    }
    return before.back();
}

using Letters = std::vector<std::pair<char, char>>;

/// Neighbouring letters, sorted.
Letters pairs_of(const std::string& text) {
    Letters pairs;
    for (std::size_t i = 1; i < text.size(); ++i) pairs.emplace_back(text[i - 1], text[i]);
    std::ranges::sort(pairs);
    return pairs;
}

/// The share of their pairs that two texts have in common (Dice's coefficient): 1 for equal ones.
double likeness(const Letters& a, const Letters& b) {
    Letters common;
    std::ranges::set_intersection(a, b, std::back_inserter(common));
    return 2.0 * static_cast<double>(common.size()) /
           static_cast<double>(std::max<std::size_t>(a.size() + b.size(), 1));
}

}  // namespace

std::string similar_to(const std::string& word, const std::vector<std::string>& names) {
    std::string best;
    std::size_t least = std::max<std::size_t>(1, word.size() / 3) + 1;
    for (const std::string& name : names) {
        const std::size_t d = word.size() > 2 && name.starts_with(word) ? 1 : distance(word, name);
        if (d < least) least = d, best = name;
    }
    return best;
}

std::string did_you_mean(const std::string& word, const std::vector<std::string>& names,
                         const std::string& otherwise) {
    const std::string name = similar_to(word, names);
    return name.empty() ? otherwise : "did you mean '" + name + "'?";
}

std::vector<std::string> most_alike(const std::string& word, const std::vector<std::string>& names,
                                    std::size_t most) {
    const Letters wanted = pairs_of(word);
    std::vector<std::pair<double, std::string>> found;  // less is more like it
    found.reserve(names.size());
    for (const std::string& name : names) found.emplace_back(-likeness(wanted, pairs_of(name)), name);
    std::ranges::sort(found);
    std::vector<std::string> best;
    for (std::size_t i = 0; i < std::min(most, found.size()); ++i) best.push_back(found[i].second);
    return best;
}

std::string pattern_of(const std::string& text) {
    std::string pattern;
    bool in_quotes = false;
    for (const char c : text) {
        if (c == '\'') in_quotes = !in_quotes;
        if (!in_quotes && std::isdigit(static_cast<unsigned char>(c)) == 0) pattern += c;
    }
    return pattern;
}

}  // namespace roboss
