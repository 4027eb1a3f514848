#include "condition/written_range.h"

#include <algorithm>
#include <charconv>
#include <optional>
#include <span>
#include <vector>

#include "script/lua_tokens.h"

namespace mrose {
namespace {

using Tokens = std::span<const LuaToken>;

ValueRange hull(const ValueRange& a, const ValueRange& b) {
    return {std::min(a.least, b.least), std::max(a.most, b.most)};
}

class RangeReader {
public:
    explicit RangeReader(std::string_view text) : text_(text) {}

    ValueRange of(Tokens tokens) const {
        std::optional<ValueRange> range;
        for (const Tokens alternative : split(tokens, "or")) {
            const ValueRange one = ofConjunction(alternative);
            range = range ? hull(*range, one) : one;
        }
        return *range;
    }

private:
    static constexpr ValueRange truth{0, 1}, falsehood{0, 0};

    std::string_view wordOf(const LuaToken& token) const { return text_.substr(token.begin, token.end - token.begin); }
    int nestingBy(const LuaToken& token) const {
        const std::string_view word = wordOf(token);
        if (word == "(" || word == "[" || word == "{") return 1;
        return word == ")" || word == "]" || word == "}" ? -1 : 0;
    }

    /// What is between such words outside of brackets: one part at least.
    std::vector<Tokens> split(Tokens tokens, std::string_view word) const {
        std::vector<Tokens> parts;
        std::size_t begin = 0;
        int nested = 0;
        for (std::size_t i = 0; i < tokens.size(); ++i) {
            nested += nestingBy(tokens[i]);
            if (nested > 0 || wordOf(tokens[i]) != word) continue;
            parts.push_back(tokens.subspan(begin, i - begin));
            begin = i + 1;
        }
        parts.push_back(tokens.subspan(begin));
        return parts;
    }

    /// The first that is false, or else the last.
    ValueRange ofConjunction(Tokens tokens) const {
        const std::vector<Tokens> parts = split(tokens, "and");
        const ValueRange last = ofOperand(parts.back());
        return parts.size() > 1 ? hull(falsehood, last) : last;
    }

    ValueRange ofOperand(Tokens tokens) const {
        if (tokens.empty()) return {};
        const std::string_view first = wordOf(tokens.front());
        if (first == "not" || first == "true" || first == "false" || compares(tokens)) return truth;
        if ((first == "time" && tokens.size() == 1) || isGoals(tokens)) return {.least = 0};
        if (isInBrackets(tokens)) return of(tokens.subspan(1, tokens.size() - 2));
        const bool negative = first == "-";
        if (tokens.size() != (negative ? 2 : 1) || tokens.back().kind != LuaToken::Kind::number) return {};
        const std::string_view word = wordOf(tokens.back());
        double number = 0;
        const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
        if (error != std::errc() || end != word.data() + word.size()) return {};
        if (negative) number = -number;
        return {number, number};
    }

    /// "goals.left", "goals[1]"
    bool isGoals(Tokens tokens) const {
        if (wordOf(tokens.front()) != "goals") return false;
        return (tokens.size() == 3 && wordOf(tokens[1]) == ".") || (tokens.size() == 4 && wordOf(tokens[1]) == "[");
    }

    /// Of all operators but `and` and `or`, comparisons are done last.
    bool compares(Tokens tokens) const {
        int nested = 0;
        for (std::size_t i = 0; i < tokens.size(); ++i) {
            nested += nestingBy(tokens[i]);
            const std::string_view word = wordOf(tokens[i]);
            const bool shifts = isTwice(tokens, i) || (i > 0 && isTwice(tokens, i - 1));
            const bool differs = word == "~" && i + 1 < tokens.size() && wordOf(tokens[i + 1]) == "=";
            if (nested == 0 && (word == "==" || differs || ((word == "<" || word == ">") && !shifts))) return true;
        }
        return false;
    }
    /// "<<"
    bool isTwice(Tokens tokens, std::size_t i) const {
        return i + 1 < tokens.size() && wordOf(tokens[i]) == wordOf(tokens[i + 1]) &&
               tokens[i].end == tokens[i + 1].begin;
    }
    /// As a whole: not "(a) + (b)".
    bool isInBrackets(Tokens tokens) const {
        if (wordOf(tokens.front()) != "(") return false;
        int nested = 0;
        for (const LuaToken& token : tokens.first(tokens.size() - 1))
            if ((nested += nestingBy(token)) == 0) return false;
        return true;
    }

    std::string_view text_;
};

}  // namespace

ValueRange writtenRange(std::string_view text) {
    const std::vector<LuaToken> tokens = luaTokens(text);
    return RangeReader(text).of(tokens);
}

}  // namespace mrose
