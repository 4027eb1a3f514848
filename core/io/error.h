#pragma once

#include <string>
#include <utility>

#include <tl/expected.hpp>

namespace mrose {

/// What is wrong with an input or an output, said in one line. Empty and zero members are left out of the message.
struct Error {
    std::string file;
    int line = 0;    ///< 1 is the first
    int column = 0;  ///< 1 is the first
    std::string key;
    std::string cause;  ///< what was found and what was expected

    /// "file:line:column: key: cause", control characters as question marks
    std::string message() const;
};

template <class T>
using Expected = tl::expected<T, Error>;

inline tl::unexpected<Error> fail(std::string file, std::string cause, int line = 0, std::string key = {}) {
    return tl::unexpected<Error>(Error{std::move(file), line, 0, std::move(key), std::move(cause)});
}

/// An error that names no file is of this one.
inline tl::unexpected<Error> atFile(Error error, const std::string& file) {
    if (error.file.empty()) error.file = file;
    return tl::unexpected<Error>(std::move(error));
}

}  // namespace mrose
