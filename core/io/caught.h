#pragma once

#include <functional>
#include <type_traits>
#include <utility>

#include "io/error.h"

namespace mrose {

/// What the exception that is being handled says, as an error's cause.
Error thrownError();

template <class Result>
struct AsExpected {
    using Type = Expected<Result>;
};
template <class Value>
struct AsExpected<Expected<Value>> {
    using Type = Expected<Value>;
};

/// What a function returns, and what it throws as an error: for threads and jobs, which let no exception out.
template <class Function>
auto caught(Function&& function) {
    using Result = std::invoke_result_t<Function>;
    using Outcome = typename AsExpected<Result>::Type;
    try {
        if constexpr (std::is_void_v<Result>) {
            std::forward<Function>(function)();
            return Outcome();
        } else {
            return Outcome(std::forward<Function>(function)());
        }
    } catch (...) {
        return Outcome(tl::unexpected(thrownError()));
    }
}

}  // namespace mrose
