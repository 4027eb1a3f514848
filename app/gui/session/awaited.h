#pragma once

#include <chrono>
#include <functional>
#include <future>
#include <optional>

namespace mrose::gui {

/// What another thread answers; nullopt: it is not to be waited for any longer.
template <class Answer>
std::optional<Answer> awaited(std::future<Answer> answer, const std::function<bool()>& goesOn) {
    while (answer.wait_for(std::chrono::milliseconds(5)) != std::future_status::ready)
        if (!goesOn()) return {};
    return answer.get();
}

}  // namespace mrose::gui
