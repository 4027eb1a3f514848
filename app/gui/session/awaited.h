#pragma once

#include <chrono>
#include <future>
#include <optional>

#include "io/progress.h"

namespace mrose::gui {

/// What another thread answers; nullopt: it is not to be waited for any longer.
template <class Answer>
std::optional<Answer> awaited(std::future<Answer> answer, const GoesOn& goesOn) {
    while (answer.wait_for(std::chrono::milliseconds(5)) != std::future_status::ready)
        if (!goesOn()) return {};
    return answer.get();
}

}  // namespace mrose::gui
