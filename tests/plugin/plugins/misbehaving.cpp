// Does what its option `how` says, from the instant `after_s` on; until then it drives on.
#include <cmath>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <stdexcept>

#include <unistd.h>

#include "control/controller.h"
#include "plugin/plugin.h"

namespace {

volatile int* nowhere = nullptr;
volatile bool forEver = true;
int hidden = 0;

int overflow(int depth) {
    volatile char room[1000];
    room[0] = static_cast<char>(depth);
    return forEver ? overflow(depth + 1) + room[0] : 0;
}

class Misbehaving : public mrose::Controller {
public:
    explicit Misbehaving(mrose::PluginOptions& options)
        : how_(options.text("how", "")), after_(options.number("after_s", 0)), farewell_(options.text("farewell", "")) {
        if (how_ == "construction") throw std::runtime_error("no map\nhere");
        if (how_ == "crash while loading") *nowhere = 1;
        if (how_ == "loop while loading") loop();
        if (how_ == "announced loop while loading") {
            std::fputs("here it loops\n", stderr);
            loop();
        }
        if (how_ == "slow loading") ::usleep(800'000);
    }
    ~Misbehaving() override {
        if (!farewell_.empty()) std::ofstream(farewell_) << "destroyed";
    }
    std::size_t memorySize() const override {
        if (how_ == "memory size") throw std::runtime_error("how much?");
        if (how_ == "huge memory") return std::size_t{1} << 40;
        return std::getenv("MROSE_TEST_MORE_MEMORY") != nullptr ? 16 : 8;
    }
    std::size_t commandsPerPeriod(mrose::Nanoseconds) const override {
        if (how_ == "crash when asked for commands") *nowhere = 1;
        return 1;
    }
    void explain(std::span<const std::byte>, mrose::MemoryEntries&) const override {
        if (how_ == "explanation") throw std::runtime_error("no words");
        if (how_ == "crash when asked to explain") *nowhere = 1;
    }
    mrose::Attention attention() const override {
        return how_.starts_with("unasked") ? mrose::Attention::ofItself() : mrose::Attention{};
    }
    void start(std::span<std::byte>) const override {
        if (how_ == "start") throw std::runtime_error("not now");
    }

    void decide(const mrose::Observation& observation, std::span<std::byte> memory,
                mrose::Decision& decision) const override {
        decision.command = mrose::Command{0.3, 0};
        if (mrose::toSeconds(observation.time) < after_) return;
        if (how_ == "throw") throw std::out_of_range("index 7");
        if (how_ == "throw two lines") throw std::runtime_error("one\ntwo");
        if (how_ == "throw int") throw 7;
        if (how_ == "nan") decision.command->w = std::nan("");
        if (how_ == "huge v") decision.command->v = 1e160;
        if (how_ == "huge w") decision.command->w = -1e200;
        if (how_ == "huge earlier") decision.earlier.push_back({0, {0, 1001}});
        if (how_ == "infinite earlier") decision.earlier.push_back({0, {INFINITY, 0}});
        if (how_ == "unasked robots") decision.command->v = static_cast<double>(observation.robots().size());
        if (how_ == "unasked scan") decision.command->v = observation.newest("scan") != nullptr ? 1 : 0;
        if (how_ == "loop") loop();
        if (how_ == "slow") ::usleep(60'000);
        if (how_ == "print") std::fputs("what it prints\n", stdout), std::fflush(stdout);
        if (how_ == "crash") *nowhere = 1;
        if (how_ == "overflow") hidden = overflow(0);
        if (how_ == "abort") std::abort();
        if (how_ == "exit") std::exit(0);
        if (how_ == "quick exit") ::_exit(3);
        if (how_ == "huge answer") decision.breakReason.resize(20 << 20);
        if (how_ == "hidden command") decision.command->w = 0.01 * ++hidden;
        if (how_ == "hidden memory") mrose::as<std::int64_t>(memory) = ++hidden;
        if (how_ == "hidden kick" && ++hidden % 2 == 0) decision.kicks.push_back({0, 1});
        if (how_ == "hidden fault" && ++hidden % 2 == 0) throw std::runtime_error("every other time");
        if (how_ == "hidden note") decision.annotations.push_back({{}, "note", double(++hidden), "", {}});
    }

private:
    static void loop() {
        while (forEver) {
        }
    }

    std::string how_;
    double after_;
    std::string farewell_;
};

}  // namespace

MROSE_PLUGIN(Misbehaving)
