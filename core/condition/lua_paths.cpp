#include "condition/lua_paths.h"

#include <algorithm>
#include <array>
#include <string>

namespace mrose {
namespace {

constexpr std::array<std::string_view, 22> reservedWords{
    "and", "break", "do",  "else", "elseif", "end",    "false",  "for",  "function", "goto",  "if",
    "in",  "local", "nil", "not",  "or",     "repeat", "return", "then", "true",     "until", "while"};

constexpr bool isDigit(char c) { return c >= '0' && c <= '9'; }
constexpr bool startsName(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }
constexpr bool inName(char c) { return startsName(c) || isDigit(c); }

struct Token {
    enum class Kind { name, reserved, number, string, other };
    Kind kind = Kind::other;
    std::size_t begin = 0, end = 0;
};

/// Splits a text that Lua accepts into tokens; runs to the text's end, and never beyond, for any other.
class Tokens {
public:
    explicit Tokens(std::string_view text) : text_(text) {
        for (skipSpace(); at_ < text_.size(); skipSpace()) take();
    }
    const std::vector<Token>& all() const { return tokens_; }

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
        Token::Kind kind = Token::Kind::other;
        if (startsName(c)) {
            skipWhile(inName);
            const std::string_view word = text_.substr(begin, at_ - begin);
            const bool reserved = std::find(reservedWords.begin(), reservedWords.end(), word) != reservedWords.end();
            kind = reserved ? Token::Kind::reserved : Token::Kind::name;
        } else if (isDigit(c) || (c == '.' && isDigit(peek(1)))) {
            skipNumber();
            kind = Token::Kind::number;
        } else if (c == '"' || c == '\'') {
            skipQuoted();
            kind = Token::Kind::string;
        } else if (skipLongBracket()) {
            kind = Token::Kind::string;
        } else if (c == '.' || c == '=') {
            skipWhile([c](char d) { return d == c; });  // "..", "==" are other than "." and "="
        } else {
            ++at_;
        }
        tokens_.push_back({kind, begin, at_});
    }

    std::string_view text_;
    std::size_t at_ = 0;
    std::vector<Token> tokens_;
};

class PathSearch {
public:
    explicit PathSearch(std::string_view text) : text_(text), tokens_(Tokens(text).all()) {}

    std::vector<LuaPath> find() const {
        std::vector<LuaPath> paths;
        for (std::size_t i = 0; i < tokens_.size(); ++i) {
            if (is(i, "function")) return {};
            const bool member = i > 0 && (is(i - 1, ".") || is(i - 1, ":"));
            if (tokens_[i].kind != Token::Kind::name || member || is(i + 1, "=")) continue;
            paths.push_back(pathFrom(i));
        }
        return paths;
    }

private:
    bool is(std::size_t i, std::string_view word) const {
        return i < tokens_.size() && text_.substr(tokens_[i].begin, tokens_[i].end - tokens_[i].begin) == word;
    }
    bool isKind(std::size_t i, Token::Kind kind) const { return i < tokens_.size() && tokens_[i].kind == kind; }

    LuaPath pathFrom(std::size_t i) const {
        const std::size_t offset = tokens_[i].begin;
        LuaPath path{offset, {}, {}};
        const auto add = [&](std::size_t part, std::size_t last) {
            path.parts.push_back({tokens_[part].begin - offset, tokens_[last].end - offset});
        };
        for (add(i, i);;) {
            if (is(i + 1, ".") && isKind(i + 2, Token::Kind::name)) {
                i += 2;
                add(i, i);
            } else if (is(i + 1, "[") && is(i + 3, "]") &&
                       (isKind(i + 2, Token::Kind::number) || isKind(i + 2, Token::Kind::string))) {
                i += 3;
                add(i - 1, i);
            } else {
                path.text = text_.substr(offset, tokens_[i].end - offset);
                return path;
            }
        }
    }

    std::string_view text_;
    std::vector<Token> tokens_;
};

}  // namespace

std::vector<LuaPath> luaPaths(std::string_view text) { return PathSearch(text).find(); }

std::vector<std::string_view> luaWords(std::string_view text) {
    std::vector<std::string_view> words;
    const Tokens tokens(text);
    for (const Token& token : tokens.all()) {
        const std::string_view word = text.substr(token.begin, token.end - token.begin);
        if (token.kind == Token::Kind::name) words.push_back(word);
        if (token.kind != Token::Kind::string) continue;
        constexpr std::string_view quotes = "'\"[=]";
        const std::size_t begin = std::min(word.find_first_not_of(quotes), word.size());
        words.push_back(word.substr(begin, word.find_last_not_of(quotes) + 1 - begin));
    }
    return words;
}

}  // namespace mrose
