// Does all that a plug-in may: reads options, remembers, annotates, kicks, breaks, uses what the headers declare.
#include <array>

#include "control/controller.h"
#include "plugin/plugin.h"

namespace {

class WellBehaved : public mrose::Controller {
public:
    explicit WellBehaved(mrose::PluginOptions& options)
        : speed_(options.number("speed_mps", 0.5)),
          kicks_(options.flag("kicks", false)),
          label_(options.text("label", "count")),
          gain_(options.mapping("gain")) {
        for (std::uint32_t i = 0; const mrose::PluginLandmark* landmark = options.landmark(i); ++i)
            landmarks_ += std::string(landmark->name) + (landmark->x < landmark->y ? "<" : ">");
        if (speed_ < 0) options.reject("speed_mps", "expected at least 0");
    }

    struct Memory {
        std::int64_t count = 0;
        double turned = 0;
    };
    std::size_t memorySize() const override { return sizeof(Memory); }
    void start(std::span<std::byte> memory) const override { mrose::as<Memory>(memory).count = 100; }
    std::size_t commandsPerPeriod(mrose::Nanoseconds period) const override {
        return static_cast<std::size_t>(period / 50'000'000);
    }
    mrose::Attention attention() const override {
        return mrose::Attention::only({"self", "odometry", "robots", "messages"});
    }

    void explain(std::span<const std::byte> memory, mrose::MemoryEntries& entries) const override {
        const auto& known = mrose::as<Memory>(memory);
        entries.add("count", static_cast<double>(known.count));
        entries.add("turned", known.turned, "rad");
        entries.add("label", label_);
        if (!landmarks_.empty()) entries.add("landmarks", landmarks_);
    }

    void decide(const mrose::Observation& observation, std::span<std::byte> memory,
                mrose::Decision& decision) const override {
        Memory& known = mrose::as<Memory>(memory);
        ++known.count;
        known.turned = mrose::wrapAngle(known.turned + observation.velocity().w);
        const mrose::Pose ahead = observation.self() * mrose::exp({1, 0, 0.1});
        double nearest = 10;
        for (const mrose::SeenBody& body : observation.robots())
            nearest = std::min(nearest, mrose::length(body.position_B));
        decision.clear();
        double speed = speed_;
        if (gain_ != nullptr) gain_->evaluate(std::array{known.turned, speed_}, std::span(&speed, 1));
        decision.messages.push_back(mrose::RadioMessage::of(known.turned));
        for (const mrose::ReceivedMessage& message : observation.messages()) known.count += message.from;
        decision.earlier.push_back({observation.time - 1, {speed_ / 2, 0}});
        const double dice = 0x1p-70 * static_cast<double>(observation.noise);
        decision.command = mrose::Command{speed, known.turned + 0.01 * nearest + dice};
        if (kicks_ && observation.manipulators > 0 && known.count % 3 == 0) decision.kicks.push_back({0, 0.5});
        decision.annotations.push_back(
            {mrose::Annotation::Kind::value, label_, static_cast<double>(known.count), "", {}});
        decision.annotations.push_back({mrose::Annotation::Kind::line, "way", 0, "", {{}, mrose::position(ahead)}});
        if (known.count == 105) decision.breakHere();
    }

private:
    double speed_;
    bool kicks_;
    std::string label_, landmarks_;
    const mrose::LearnedMapping* gain_;
};

}  // namespace

MROSE_PLUGIN(WellBehaved)
