#include "plugin_watch.h"

#include <array>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <ctime>
#include <memory>
#include <mutex>
#include <string_view>
#include <thread>
#include <utility>
#include <vector>

#include <poll.h>
#include <semaphore.h>
#include <unistd.h>

#include "common.h"
#include "plugin/load_plugin.h"

namespace mrose::cli {
namespace {

constexpr std::int64_t noTick = -1, explaining = -2;

/// What a thread is doing with a plug-in. Signal handlers read it, so that it holds nothing but lock-free numbers.
struct Activity {
    std::atomic<bool> taken{false};                ///< by a thread
    std::atomic<const std::string*> who{nullptr};  ///< null: no plug-in runs
    std::atomic<std::int64_t> tick{noTick};
    std::atomic<std::uint64_t> count{0};  ///< changes with every begin
    std::atomic<bool> ofBatch{false};     ///< the next two count
    std::atomic<std::uint64_t> trial{0}, seed{0};

    void begin(const std::string* name, std::int64_t now) {
        tick.store(now, std::memory_order_relaxed);
        count.fetch_add(1, std::memory_order_relaxed);
        who.store(name, std::memory_order_release);
    }
    void end() { who.store(nullptr, std::memory_order_release); }
};

constexpr std::size_t mostThreads = 1024;
std::array<Activity, mostThreads> activities;
std::mutex actionMutex;
std::function<void()> endAction;

/// A line put together and written by means that a signal handler may use.
class SignalSafeLine {
public:
    SignalSafeLine& operator<<(std::string_view text) {
        for (const char c : text)
            if (size_ + 1 < line_.size()) line_[size_++] = static_cast<unsigned char>(c) < 0x20 ? '?' : c;
        return *this;
    }
    SignalSafeLine& operator<<(std::uint64_t number) {
        std::array<char, 24> digits;
        std::size_t first = digits.size();
        for (std::uint64_t rest = number; rest > 0 || first == digits.size(); rest /= 10)
            digits[--first] = static_cast<char>('0' + rest % 10);
        return *this << std::string_view(digits.data() + first, digits.size() - first);
    }
    void write() {
        line_[size_++] = '\n';
        for (std::size_t done = 0; done < size_;) {
            const ssize_t written = ::write(STDERR_FILENO, line_.data() + done, size_ - done);
            if (written <= 0) break;
            done += static_cast<std::size_t>(written);
        }
    }

private:
    std::array<char, 2048> line_;
    std::size_t size_ = 0;
};

void say(const std::string& who, const Activity& activity, std::string_view what, std::string_view more) {
    SignalSafeLine line;
    line << "mrose: " << who << what;
    const std::int64_t tick = activity.tick;
    if (tick == noTick)
        line << " while it was loaded";
    else if (tick == explaining)
        line << " when it was asked to explain itself";
    else
        line << " at tick " << static_cast<std::uint64_t>(tick);
    const bool ofBatch = activity.ofBatch;
    if (ofBatch) line << " of trial " << activity.trial.load() << ", seed " << activity.seed.load();
    line << more;
    if (ofBatch)
        line << "; the same command with --isolate goes on with the rest";
    else if (tick != noTick)
        line << "; with --isolate only its robot stops";
    line.write();
}

thread_local Activity* current = nullptr;  ///< of this thread, for handlers: it is there before any plug-in runs

/// A thread's activity, and a stack on which it can report that its own has overflown.
class ThreadWatch {
public:
    ThreadWatch() {
        for (Activity& activity : activities) {
            bool free = false;
            if (!activity.taken.compare_exchange_strong(free, true)) continue;
            activity_ = &activity;
            break;
        }
        stack_t present{};
        if (::sigaltstack(nullptr, &present) != 0 || (present.ss_flags & SS_DISABLE) == 0) return;
        stack_.resize(1 << 16);
        stack_t own{};
        own.ss_sp = stack_.data();
        own.ss_size = stack_.size();
        ::sigaltstack(&own, nullptr);
    }
    ThreadWatch(const ThreadWatch&) = delete;
    ThreadWatch& operator=(const ThreadWatch&) = delete;
    ~ThreadWatch() {
        if (!stack_.empty()) {
            stack_t none{};
            none.ss_flags = SS_DISABLE;
            ::sigaltstack(&none, nullptr);
        }
        if (activity_ == &spare_) {
            current = nullptr;
        } else if (activity_->who == nullptr) {  // else it ends in a plug-in, which onExit() has yet to name
            activity_->ofBatch = false;
            activity_->taken = false;
        }
    }

    Activity& activity() const { return *activity_; }

private:
    Activity spare_;  ///< of threads beyond mostThreads: crashes are reported, and no more
    Activity* activity_ = &spare_;
    std::vector<char> stack_;
};

Activity& activityOfThisThread() {
    thread_local ThreadWatch watch;
    current = &watch.activity();
    return *current;
}

std::atomic<bool> ending{false};

[[noreturn]] void saveAndEnd() {
    ending = true;
    const std::lock_guard lock(actionMutex);
    if (endAction) endAction();
    ::_exit(failure);
}

/// Names the plug-in that this thread runs, if it does.
bool sayIfInPlugin(std::string_view what, std::string_view more) {
    const std::string* const who = current != nullptr ? current->who.load() : nullptr;
    if (who != nullptr) say(*who, *current, what, more);
    return who != nullptr;
}

sem_t crashes;  ///< how many threads wait in a signal handler for the end
/// Announced before that: sanitizers see what an atomic orders, and not what sem_clockwait does.
std::atomic<bool> crashed{false};

struct FatalSignal {
    int number;
    std::string_view meaning;
    struct sigaction before;
};
std::array<FatalSignal, 5> fatalSignals{{{SIGSEGV, " (segmentation fault)", {}},
                                         {SIGBUS, " (bus error)", {}},
                                         {SIGFPE, " (arithmetic exception)", {}},
                                         {SIGILL, " (illegal instruction)", {}},
                                         {SIGABRT, " (aborted)", {}}}};

extern "C" void onFatalSignal(int number) {
    for (const FatalSignal& fatal : fatalSignals) {
        if (fatal.number != number) continue;
        if (sayIfInPlugin(" crashed", fatal.meaning)) {
            // A handler may do hardly anything: the watch saves and ends, unless what crashed has broken that, too.
            crashed = true;
            ::sem_post(&crashes);
            constexpr int mostWait = 5000;  // ms
            ::poll(nullptr, 0, mostWait);
            ::_exit(failure);
        }
        if (ending) ::_exit(failure);
        // Not a plug-in's: what would have happened happens when this returns.
        ::sigaction(number, &fatal.before, nullptr);
        ::raise(number);
    }
}

void onExit() {
    if (sayIfInPlugin(" ended the program", "")) saveAndEnd();
}

/// Whether a thread crashed in so many seconds.
bool crashedWithin(double seconds) {
    timespec until{};
    ::clock_gettime(CLOCK_MONOTONIC, &until);
    const auto nanoseconds = static_cast<std::int64_t>(seconds * 1e9) + until.tv_nsec;
    until.tv_sec += nanoseconds / 1'000'000'000;
    until.tv_nsec = nanoseconds % 1'000'000'000;
    int waited = 0;
    do waited = ::sem_clockwait(&crashes, CLOCK_MONOTONIC, &until);
    while (waited != 0 && errno == EINTR);
    return waited == 0;
}

/// Counts its own rounds and not the time, so that a program that was stopped for a while is not taken for stuck.
void watch(double limit) {
    constexpr int rounds = 20;
    struct Seen {
        std::uint64_t count = 0;
        int rounds = 0;
    };
    std::vector<Seen> seen(activities.size());
    for (;;) {
        if (crashedWithin(limit / rounds) && crashed) saveAndEnd();
        for (std::size_t i = 0; i < activities.size(); ++i) {
            const std::string* const who = activities[i].who.load();
            const std::uint64_t count = activities[i].count.load();
            seen[i] = {count, who != nullptr && count == seen[i].count ? seen[i].rounds + 1 : 0};
            if (who == nullptr || seen[i].rounds <= rounds) continue;
            say(*who, activities[i], " does not return", "");
            saveAndEnd();
        }
    }
}

class WatchedController final : public Controller {
public:
    WatchedController(std::shared_ptr<const Controller> watched, std::string who, Nanoseconds tickLength)
        : watched_(std::move(watched)), who_(std::move(who)), tickLength_(tickLength) {}

    std::size_t memorySize() const override { return watched_->memorySize(); }
    void start(std::span<std::byte> memory) const override { watched_->start(memory); }
    std::size_t commandsPerPeriod(Nanoseconds period) const override {
        const PluginGuard guard(who_);
        return watched_->commandsPerPeriod(period);
    }
    Attention attention() const override { return watched_->attention(); }
    void explain(std::span<const std::byte> memory, MemoryEntries& entries) const override {
        Activity& activity = activityOfThisThread();
        activity.begin(&who_, explaining);
        watched_->explain(memory, entries);
        activity.end();
    }
    void decide(const Observation& observation, std::span<std::byte> memory, Decision& decision) const override {
        Activity& activity = activityOfThisThread();
        activity.begin(&who_, observation.time / tickLength_);
        watched_->decide(observation, memory, decision);
        activity.end();
    }

private:
    std::shared_ptr<const Controller> watched_;
    std::string who_;
    Nanoseconds tickLength_;
};

}  // namespace

void startPluginWatch(double limit) {
    static bool started = false;
    if (std::exchange(started, true)) return;
    ::sem_init(&crashes, 0, 0);
    struct sigaction action {};
    action.sa_handler = onFatalSignal;
    action.sa_flags = SA_ONSTACK;
    for (FatalSignal& fatal : fatalSignals) ::sigaction(fatal.number, &action, &fatal.before);
    std::atexit(onExit);
    std::thread(watch, limit).detach();
}

void beforePluginEndsProgram(std::function<void()> action) {
    const std::lock_guard lock(actionMutex);
    endAction = std::move(action);
}

void sayPluginsRun(const RunKey& key) {
    Activity& activity = activityOfThisThread();
    activity.trial = key.trial;
    activity.seed = key.seed;
    activity.ofBatch = true;
}

PluginGuard::PluginGuard(const std::string& who) : who_(who) { activityOfThisThread().begin(&who_, noTick); }
PluginGuard::~PluginGuard() { activityOfThisThread().end(); }

void watchPlugins(ScenarioParts& parts) {
    for (std::size_t i = 0; i < parts.controllers.size(); ++i) {
        const auto* const plugin = dynamic_cast<const PluginController*>(parts.controllers[i].get());
        if (plugin == nullptr) continue;
        std::string who = "robot \"" + parts.scene.robots[i].name + "\": its plug-in " + plugin->path();
        parts.controllers[i] =
            std::make_shared<const WatchedController>(parts.controllers[i], std::move(who), parts.scene.tickLength);
    }
}

}  // namespace mrose::cli
