#include "condition/lua_paths.h"

#include <algorithm>

#include "script/lua_tokens.h"

namespace mrose {
namespace {

class PathSearch {
public:
    explicit PathSearch(std::string_view text) : text_(text), tokens_(luaTokens(text)) {}

    std::vector<LuaPath> find() const {
        std::vector<LuaPath> paths;
        for (std::size_t i = 0; i < tokens_.size(); ++i) {
            if (is(i, "function")) return {};
            const bool member = i > 0 && (is(i - 1, ".") || is(i - 1, ":"));
            if (tokens_[i].kind != LuaToken::Kind::name || member || is(i + 1, "=")) continue;
            paths.push_back(pathFrom(i));
        }
        return paths;
    }

private:
    bool is(std::size_t i, std::string_view word) const {
        return i < tokens_.size() && text_.substr(tokens_[i].begin, tokens_[i].end - tokens_[i].begin) == word;
    }
    bool isKind(std::size_t i, LuaToken::Kind kind) const { return i < tokens_.size() && tokens_[i].kind == kind; }

    LuaPath pathFrom(std::size_t i) const {
        const std::size_t offset = tokens_[i].begin;
        LuaPath path{offset, {}, {}};
        const auto add = [&](std::size_t part, std::size_t last) {
            path.parts.push_back({tokens_[part].begin - offset, tokens_[last].end - offset});
        };
        for (add(i, i);;) {
            if (is(i + 1, ".") && isKind(i + 2, LuaToken::Kind::name)) {
                i += 2;
                add(i, i);
            } else if (is(i + 1, "[") && is(i + 3, "]") &&
                       (isKind(i + 2, LuaToken::Kind::number) || isKind(i + 2, LuaToken::Kind::string))) {
                i += 3;
                add(i - 1, i);
            } else {
                path.text = text_.substr(offset, tokens_[i].end - offset);
                return path;
            }
        }
    }

    std::string_view text_;
    std::vector<LuaToken> tokens_;
};

}  // namespace

std::vector<LuaPath> luaPaths(std::string_view text) { return PathSearch(text).find(); }

std::vector<std::string_view> luaWords(std::string_view text) {
    std::vector<std::string_view> words;
    for (const LuaToken& token : luaTokens(text)) {
        const std::string_view word = text.substr(token.begin, token.end - token.begin);
        if (token.kind == LuaToken::Kind::name) words.push_back(word);
        if (token.kind != LuaToken::Kind::string) continue;
        constexpr std::string_view quotes = "'\"[=]";
        const std::size_t begin = std::min(word.find_first_not_of(quotes), word.size());
        words.push_back(word.substr(begin, word.find_last_not_of(quotes) + 1 - begin));
    }
    return words;
}

}  // namespace mrose
