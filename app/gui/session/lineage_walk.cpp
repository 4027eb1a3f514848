#include "session/lineage_walk.h"

#include <atomic>
#include <chrono>
#include <future>
#include <memory>
#include <mutex>

#include "session/awaited.h"

namespace mrose::gui {
namespace {

using Clock = std::chrono::steady_clock;
constexpr auto longestLook = std::chrono::milliseconds(5);
/// Further on it is quicker to begin anew.
constexpr std::int64_t longestWay = 1000;  // ticks
constexpr std::int64_t learnedAtOnce = 200;

tl::unexpected<Error> otherRun() { return fail("", "another run was opened meanwhile"); }

/// What the session's thread does for a caller that may no longer wait for it.
template <class Answer>
struct Errand {
    std::mutex mutex;  ///< held while what belongs to the one who waits is used
    std::atomic<bool> wanted = true;
    std::promise<Expected<Answer>> promise;
};

/// nullopt: it is not to go on.
template <class Answer>
std::optional<Expected<Answer>> answerOf(Errand<Answer>& errand, const GoesOn& goesOn) {
    auto answer = awaited(errand.promise.get_future(), goesOn);
    if (answer) return answer;
    const std::lock_guard lock(errand.mutex);
    errand.wanted = false;
    return {};
}

/// Simulates what is missing, and shows again what was shown.
Expected<bool> extend(TimeTravel& run, std::uint32_t branch, std::int64_t tick, const Progress& progress) {
    const std::int64_t known = run.branches().last(branch);
    if (tick <= known) return true;
    const std::uint32_t shown = run.branch();
    const std::int64_t at = run.tick();
    const std::optional<std::uint32_t> beside = run.beside();
    bool goesOn = true;
    Expected<void> done = run.show(branch, known);
    while (done && goesOn && run.tick() < tick) {
        done = run.forward();
        goesOn = progress(static_cast<double>(run.tick() - known) / static_cast<double>(tick - known));
    }
    const Expected<void> back = run.show(shown, at);
    run.setBeside(beside);
    if (!done) return tl::unexpected(done.error());
    if (!back) return tl::unexpected(back.error());
    return goesOn;
}

Expected<bool> learnAll(TimeTravel& run, const Progress& progress) {
    for (;;) {
        const auto more = run.branches().learn(learnedAtOnce);
        if (!more) return tl::unexpected(more.error());
        if (!*more) return true;
        if (!progress(0)) return false;
    }
}

}  // namespace

Expected<bool> LineageWalk::reach(std::int64_t tick, const QString& what, const GoesOn& goesOn) {
    const auto errand = std::make_shared<Errand<bool>>();
    session_.doLongWork(what, [errand, tick, &session = session_, run = run_, branch = branch_](
                                  TimeTravel& travel, const Progress& progress) {
        const auto wanted = [&](double share) { return progress(share) && errand->wanted; };
        Expected<bool> reached = otherRun();
        if (session.newestRun() == run) reached = learnAll(travel, wanted);
        if (reached && *reached) reached = extend(travel, branch, tick, wanted);
        errand->promise.set_value(std::move(reached));
    });
    return answerOf(*errand, goesOn).value_or(false);
}

Expected<std::optional<TickRange>> LineageWalk::known(const GoesOn& goesOn) {
    const auto errand = std::make_shared<Errand<TickRange>>();
    session_.look([errand, wanted = run_, branch = branch_](TimeTravel* travel, std::uint64_t run) {
        if (travel == nullptr || run != wanted)
            errand->promise.set_value(otherRun());
        else
            errand->promise.set_value(TickRange{travel->branches().first(branch), travel->branches().last(branch)});
    });
    const auto known = answerOf(*errand, goesOn);
    if (!known) return std::optional<TickRange>{};
    if (!*known) return tl::unexpected(known->error());
    return std::optional<TickRange>(**known);
}

/// How many of the ticks have been visited when it is time to let the session go on.
Expected<std::size_t> LineageWalk::goAlong(TimeTravel& travel, std::span<const std::int64_t> ticks,
                                           const Visit& visit) {
    const auto begin = Clock::now();
    std::size_t visited = 0;
    while (visited < ticks.size() && Clock::now() - begin < longestLook) {
        const std::int64_t next = ticks[visited];
        const bool near = cursor_ && next >= cursor_->tick() && next - cursor_->tick() <= longestWay;
        if (!near) {
            auto there = travel.branches().lineageAt(branch_, next);
            if (!there) return tl::unexpected(there.error());
            cursor_ = std::move(*there);
            if (cursor_->tick() != next) return fail("", "tick " + std::to_string(next) + " is not known any more");
        }
        if (cursor_->tick() == next) {
            visit(travel, *cursor_);
            ++visited;
        } else if (auto done = travel.branches().advance(*cursor_, branch_); !done) {
            return tl::unexpected(done.error());
        }
    }
    return visited;
}

Expected<bool> LineageWalk::visit(std::span<const std::int64_t> ticks, const Visit& visit, const GoesOn& goesOn) {
    while (!ticks.empty()) {
        const auto errand = std::make_shared<Errand<std::size_t>>();
        session_.look([this, errand, ticks, &visit](TimeTravel* travel, std::uint64_t run) {
            const std::lock_guard lock(errand->mutex);
            if (!errand->wanted) return;
            if (travel == nullptr || run != run_)
                errand->promise.set_value(otherRun());
            else
                errand->promise.set_value(goAlong(*travel, ticks, visit));
        });
        const auto visited = answerOf(*errand, goesOn);
        if (!visited) return false;
        if (!*visited) return tl::unexpected(visited->error());
        ticks = ticks.subspan(**visited);
        if (!goesOn()) return false;
    }
    return true;
}

}  // namespace mrose::gui
