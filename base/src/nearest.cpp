// SPDX-License-Identifier: MIT
// "did you mean …": the known name a person most likely meant.
#include <pelage/base/diagnostic.hpp>

#include <algorithm>

namespace pelage {
namespace {

constexpr std::size_t longestWord = 64;

char lower(char c) {
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
}

std::string lower(std::string_view word) {
    std::string out(word);
    std::transform(out.begin(), out.end(), out.begin(), [](char c) { return lower(c); });
    return out;
}

// Optimal string alignment: insert, delete, replace, and swap of neighbours cost one each.
std::size_t editDistance(std::string_view a, std::string_view b) {
    std::vector<std::size_t> before(b.size() + 1), last(b.size() + 1), now(b.size() + 1);
    for (std::size_t j = 0; j <= b.size(); ++j) last[j] = j;
    for (std::size_t i = 1; i <= a.size(); ++i) {
        now[0] = i;
        for (std::size_t j = 1; j <= b.size(); ++j) {
            const std::size_t replace = last[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
            now[j] = std::min({last[j] + 1, now[j - 1] + 1, replace});
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
                now[j] = std::min(now[j], before[j - 2] + 1);
        }
        std::swap(before, last);
        std::swap(last, now);
    }
    return last[b.size()];
}

// A shortened name ("RGBA16F" for "RGBA16Float") has all its letters in order in the long one.
bool isShortenedForm(std::string_view word, std::string_view known) {
    if (word.size() < 4 || word.size() * 2 < known.size() || word.front() != known.front()) return false;
    std::size_t at = 0;
    for (const char c : known) {
        if (at < word.size() && word[at] == c) ++at;
    }
    return at == word.size();
}

}  // namespace

std::string_view nearestName(std::string_view word, const std::vector<std::string>& known) {
    if (word.empty() || word.size() > longestWord) return {};
    const std::string wanted = lower(word);
    const std::size_t reach = std::max<std::size_t>(1, wanted.size() / 3);
    std::string_view best;
    double bestScore = 1e9;
    for (const std::string& name : known) {
        if (name.empty() || name.size() > longestWord) continue;
        const std::string candidate = lower(name);
        const std::size_t distance = editDistance(wanted, candidate);
        double score = 1e9;
        if (distance <= reach && distance < std::min(wanted.size(), candidate.size())) {
            score = static_cast<double>(distance);
        } else if (isShortenedForm(wanted, candidate)) {
            score = 1.0 + 0.5 * static_cast<double>(candidate.size() - wanted.size());
        }
        if (score < bestScore) {
            bestScore = score;
            best = name;
        }
    }
    return best;
}

std::string nameHint(std::string_view word, const std::vector<std::string>& known) {
    if (const std::string_view near = nearestName(word, known); !near.empty())
        return "did you mean '" + std::string(near) + "'?";
    if (known.empty() || known.size() > 16) return {};
    std::vector<std::string> sorted = known;
    std::sort(sorted.begin(), sorted.end());
    std::string hint = "known: ";
    for (std::size_t i = 0; i < sorted.size(); ++i) hint += (i ? ", " : "") + sorted[i];
    return hint;
}

}  // namespace pelage
