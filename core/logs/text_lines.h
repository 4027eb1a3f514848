#pragma once

#include <cstring>

namespace mrose {

/// The first character at or after `at` that is no blank; a line's end is none.
inline const char* skipBlanks(const char* at, const char* end) {
    while (at < end && (*at == ' ' || *at == '\t' || *at == '\r')) ++at;
    return at;
}

/// The newline that ends the line of `at`, or the text's end.
inline const char* lineEnd(const char* at, const char* end) {
    const void* newline = at == end ? nullptr : std::memchr(at, '\n', static_cast<std::size_t>(end - at));
    return newline == nullptr ? end : static_cast<const char*>(newline);
}

/// The first line at or after `at` that holds more than blanks or a comment.
inline const char* nextLine(const char* at, const char* end) {
    for (;;) {
        at = skipBlanks(at, end);
        if (at == end || (*at != '#' && *at != '\n')) return at;
        at = lineEnd(at, end);
        if (at < end) ++at;
    }
}

}  // namespace mrose
