// Keeps its distance from the ball, and tells its team where that is: the example to grow a controller from.
#include <algorithm>
#include <cmath>
#include <cstring>

#include "control/controller.h"
#include "plugin/plugin.h"

namespace {

class KeepDistance : public mrose::Controller {
public:
    explicit KeepDistance(mrose::PluginOptions& options)
        : distance_(options.number("distance_m", 0.8)), speed_(options.number("speed_mps", 0.5)) {
        if (speed_ <= 0) options.reject("speed_mps", "expected more than 0");
    }

    // All that it remembers is here, never in members or static variables: mrose saves it with the world and puts it
    // back when the run is rewound.
    struct Memory {
        mrose::Point ball;      // where the ball was last, in the world
        std::int64_t seen = 0;  // how often, by itself or a team mate
    };
    std::size_t memorySize() const override { return sizeof(Memory); }

    // It reads no robots: they are not searched for.
    mrose::Attention attention() const override {
        return mrose::Attention::only({mrose::selfReading, mrose::objectsReading, mrose::messagesReading});
    }

    void decide(const mrose::Observation& observation, std::span<std::byte> memory,
                mrose::Decision& decision) const override {
        Memory& known = mrose::as<Memory>(memory);
        const mrose::Placement self(observation.self());
        if (!observation.objects().empty()) {
            known.ball = self.place(observation.objects().front().position_B);
            ++known.seen;
            decision.messages.push_back(mrose::RadioMessage::of(known.ball, ballAt));
        } else {
            for (const mrose::ReceivedMessage& message : observation.messages()) {
                if (message.kind != ballAt || message.size != sizeof known.ball) continue;
                std::memcpy(&known.ball, message.bytes.data(), sizeof known.ball);
                ++known.seen;
            }
        }
        if (known.seen == 0) {
            decision.command = mrose::Command{0, 0.5};  // look round for it
            return;
        }
        const mrose::Point ball = self.placeBack(known.ball);
        const double bearing = mrose::direction(ball), tooFar = mrose::length(ball) - distance_;
        const double ahead = std::abs(bearing) < 0.5 ? std::clamp(tooFar, -speed_, speed_) : 0;
        decision.command = mrose::Command{ahead, 2 * bearing};
        decision.annotations.push_back({mrose::Annotation::Kind::point, "ball", 0, "", {known.ball}});
        if (known.seen == 1) decision.breakHere("the ball is found");
    }

private:
    static constexpr std::uint32_t ballAt = 1;  // what its messages say: a place in the world
    double distance_, speed_;
};

}  // namespace

MROSE_PLUGIN(KeepDistance)
