#include "session/requests.h"

#include <utility>

namespace mrose::gui {

void Requests::add(std::function<void()> what, Kind kind) {
    {
        const std::lock_guard lock(mutex_);
        Request asked{std::move(what), kind, cancels_, runs_};
        if (kind == Kind::seek && !requests_.empty() && requests_.back().kind == Kind::seek) {
            requests_.back() = std::move(asked);
        } else {
            requests_.push_back(std::move(asked));
            lasting_ += kind == Kind::quick ? 0 : 1;
        }
    }
    wake_.notify_all();
}

bool Requests::addLook(std::function<void()> look) {
    {
        const std::lock_guard lock(mutex_);
        if (quit_) return false;
        looks_.push_back(std::move(look));
    }
    wake_.notify_all();
    return true;
}

std::uint64_t Requests::beginRun() {
    const std::lock_guard lock(mutex_);
    return ++runs_;
}

std::uint64_t Requests::runs() const {
    const std::lock_guard lock(mutex_);
    return runs_;
}

bool Requests::cancel() {
    const std::lock_guard lock(mutex_);
    if (lasting_ == 0) return false;
    ++cancels_;
    return true;
}

void Requests::quit() {
    {
        const std::lock_guard lock(mutex_);
        quit_ = true;
    }
    wake_.notify_all();
}

bool Requests::busy() const {
    const std::lock_guard lock(mutex_);
    return busy_ || !requests_.empty();
}

void Requests::settle() {
    std::unique_lock lock(mutex_);
    settled_.wait(lock, [this] { return requests_.empty() && !busy_; });
}

bool Requests::wait(std::optional<Clock::time_point> atMost) {
    std::unique_lock lock(mutex_);
    if (!quit_ && requests_.empty()) {
        busy_ = false;
        settled_.notify_all();
        const auto called = [this] { return quit_ || !requests_.empty() || !looks_.empty(); };
        if (atMost)
            wake_.wait_until(lock, *atMost, called);
        else
            wake_.wait(lock, called);
    }
    return !quit_;
}

std::deque<std::function<void()>> Requests::takeLooks() {
    const std::lock_guard lock(mutex_);
    return std::exchange(looks_, {});
}

bool Requests::carryOut(const std::function<void(const std::function<void()>&)>& with) {
    std::unique_lock lock(mutex_);
    busy_ = true;
    std::deque<Request> requests = std::exchange(requests_, {});
    for (Request& request : requests) {
        current_ = std::move(request);
        lock.unlock();
        with(current_.what);
        current_.what = nullptr;
        lock.lock();
        if (current_.kind != Kind::quick) --lasting_;
    }
    return !requests.empty();
}

bool Requests::waiting() const {
    const std::lock_guard lock(mutex_);
    return quit_ || !requests_.empty();
}

bool Requests::cancelled() const {
    const std::lock_guard lock(mutex_);
    return isCancelled();
}

bool Requests::outdated() const {
    const std::lock_guard lock(mutex_);
    return isCancelled() || runs_ != current_.runs;
}

}  // namespace mrose::gui
