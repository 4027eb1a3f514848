#include "script/lua_tokens.h"

#include <algorithm>
#include <array>
#include <string>
#include <utility>

namespace mrose {
namespace {

constexpr std::array<std::string_view, 22> reservedWords{
    "and", "break", "do",  "else", "elseif", "end",    "false",  "for",  "function", "goto",  "if",
    "in",  "local", "nil", "not",  "or",     "repeat", "return", "then", "true",     "until", "while"};

constexpr bool isDigit(char c) { return c >= '0' && c <= '9'; }
constexpr bool startsName(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }
constexpr bool inName(char c) { return startsName(c) || isDigit(c); }

class Splitter {
public:
    explicit Splitter(std::string_view text) : text_(text) {
        for (skipSpace(); at_ < text_.size(); skipSpace()) take();
    }
    std::vector<LuaToken> all() && { return std::move(tokens_); }

private:
    char peek(std::size_t ahead = 0) const { return at_ + ahead < text_.size() ? text_[at_ + ahead] : '\0'; }
    template <class Belongs>
    void skipWhile(Belongs belongs) {
        while (at_ < text_.size() && belongs(text_[at_])) ++at_;
    }

    void skipSpace() {
        for (;;) {
            skipWhile([](char c) { return c == ' ' || (c >= '\t' && c <= '\r'); });
            if (peek() != '-' || peek(1) != '-') return;
            at_ += 2;
            if (!skipLongBracket()) skipWhile([](char c) { return c != '\n' && c != '\r'; });
        }
    }

    /// "[==[ ... ]==]", of strings and comments.
    bool skipLongBracket() {
        std::size_t level = 0;
        if (peek() != '[') return false;
        while (peek(1 + level) == '=') ++level;
        if (peek(1 + level) != '[') return false;
        const std::string close = ']' + std::string(level, '=') + ']';
        const auto end = text_.find(close, at_ + level + 2);
        at_ = end == std::string_view::npos ? text_.size() : end + close.size();
        return true;
    }

    void skipQuoted() {
        const char quote = text_[at_++];
        while (at_ < text_.size() && text_[at_] != quote) at_ += text_[at_] == '\\' ? 2 : 1;
        at_ = std::min(at_ + 1, text_.size());
    }

    void skipNumber() {
        while (inName(peek()) || peek() == '.') {
            const bool exponent = peek() == 'e' || peek() == 'E' || peek() == 'p' || peek() == 'P';
            ++at_;
            if (exponent && (peek() == '+' || peek() == '-')) ++at_;
        }
    }

    void take() {
        const std::size_t begin = at_;
        const char c = peek();
        LuaToken::Kind kind = LuaToken::Kind::other;
        if (startsName(c)) {
            skipWhile(inName);
            const std::string_view word = text_.substr(begin, at_ - begin);
            const bool reserved = std::find(reservedWords.begin(), reservedWords.end(), word) != reservedWords.end();
            kind = reserved ? LuaToken::Kind::reserved : LuaToken::Kind::name;
        } else if (isDigit(c) || (c == '.' && isDigit(peek(1)))) {
            skipNumber();
            kind = LuaToken::Kind::number;
        } else if (c == '"' || c == '\'') {
            skipQuoted();
            kind = LuaToken::Kind::string;
        } else if (skipLongBracket()) {
            kind = LuaToken::Kind::string;
        } else if (c == '.' || c == '=') {
            skipWhile([c](char d) { return d == c; });  // "..", "==" are other than "." and "="
        } else {
            ++at_;
        }
        tokens_.push_back({kind, begin, at_});
    }

    std::string_view text_;
    std::size_t at_ = 0;
    std::vector<LuaToken> tokens_;
};

}  // namespace

std::vector<LuaToken> luaTokens(std::string_view text) { return Splitter(text).all(); }

std::optional<std::size_t> findPower(std::string_view text) {
    const std::vector<LuaToken> tokens = luaTokens(text);
    const auto is = [&](std::size_t i, std::string_view word) {
        return i < tokens.size() && text.substr(tokens[i].begin, tokens[i].end - tokens[i].begin) == word;
    };
    for (std::size_t i = 0; i < tokens.size(); ++i)
        if (is(i, "^") && (!is(i + 1, "2") || is(i + 2, "^"))) return tokens[i].begin;
    return {};
}

}  // namespace mrose
