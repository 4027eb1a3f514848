#include "session/series_worker.h"

#include <future>

#include "session/awaited.h"
#include "widgets/qt_text.h"

namespace mrose::gui {
namespace {

/// In the thread of a job. nullopt: the run is not there any more, or that is not waited for any longer.
std::optional<SeriesWalk::Stretch> ask(Session& session, const SeriesWalk::Wish& wish, const GoesOn& goesOn) {
    auto promise = std::make_shared<std::promise<std::optional<SeriesWalk::Stretch>>>();
    session.look([promise, wish](TimeTravel* travel, std::uint64_t run) {
        promise->set_value(travel != nullptr && run == wish.run ? SeriesWalk::stretchOf(travel->branches(), wish)
                                                                : std::nullopt);
    });
    // Long work of the session may keep it from answering.
    return awaited(promise->get_future(), goesOn).value_or(std::nullopt);
}

}  // namespace

void SeriesWorker::want(std::vector<ValueKey> values) {
    series_.want(std::move(values));
    if (enough_) *enough_ = true;
    goOn();
}

void SeriesWorker::follow(std::uint64_t run, std::shared_ptr<const Reality> reality, std::vector<BranchTicks> wanted) {
    const std::uint64_t version = series_.version();
    series_.follow(run, std::move(reality), std::move(wanted));
    if (version != series_.version() && enough_) *enough_ = true;
    goOn();
}

void SeriesWorker::cancel() {
    series_.cancel();
    if (enough_) *enough_ = true;
}

void SeriesWorker::settle() {
    while (enough_) computing_.settle();
}

/// One task after the other; what is newest goes before another value's past.
void SeriesWorker::goOn() {
    const auto task = series_.nextTask();
    if (enough_) {
        if (task && task->front && !front_) *enough_ = true;
        return;
    }
    if (!task) return;
    const auto enough = std::make_shared<std::atomic<bool>>(false);
    enough_ = enough;
    front_ = task->front;
    const auto work = [this, task = *task, enough,
                       walk = walk_](const GoesOn& wanted) -> Expected<std::optional<std::int64_t>> {
        const auto goesOn = [&] { return !*enough && wanted(); };
        auto stretch = ask(session_, walk->wishFor(task), wanted);
        const auto add = [&](std::int64_t first, const std::vector<std::vector<float>>& columns) {
            computing_.report([this, task, first, columns] {
                series_.add(task, first, columns);
                emit grown();
            });
        };
        return walk->go(task, std::move(stretch), {add, goesOn});
    };
    computing_.run(work, [this, task = *task](Expected<std::optional<std::int64_t>> unknown) {
        enough_.reset();
        if (!unknown) emit session_.failed(qtText(unknown.error().message()));
        if (!unknown || *unknown) {
            series_.giveUp(task, unknown ? **unknown : task.last);
            emit grown();
        }
        goOn();
    });
}

}  // namespace mrose::gui
