#pragma once

#include <QObject>
#include <memory>
#include <optional>

#include "frame/window_frame.h"
#include "session/job_queue.h"
#include "simulation/motion_bands.h"

namespace mrose {
class FieldView;
}

namespace mrose::gui {

class Overlay;

/// Finds out, off the frame, where robots may be, while that layer of the field is shown: of the shown rollout of a log
/// from its start on; elsewhere from the shown tick on. What is under way for a tick that is shown no more is dropped,
/// but while the run plays on from there: then what is known stays until something newer is.
class FieldBands final : public QObject {
    Q_OBJECT

public:
    FieldBands(const WindowFrame& frame, FieldView& field, const Overlay& overlay);

    /// How far ahead of the shown tick.
    void setAhead(Nanoseconds ahead);
    Nanoseconds ahead() const { return ahead_; }
    /// Of the shown rollout, as long as the layer is; null: not known.
    std::shared_ptr<const MotionBands> ofRollout() const { return rollout_ ? rollout_->bands : nullptr; }
    bool busy() { return sampling_.busy() || ofRollouts_.busy(); }
    void settle();  ///< all is known and shown; for scripts and tests

signals:
    void rolloutChanged();

private:
    /// What was asked for, and what came of it.
    struct OfTick {
        std::uint64_t run = 0;
        std::uint32_t branch = 0;
        std::int64_t tick = 0;
        Nanoseconds ahead = 0;
        std::shared_ptr<const MotionBands> bands = {};

        bool sameWish(const OfTick& other) const {
            return run == other.run && branch == other.branch && tick == other.tick && ahead == other.ahead;
        }
    };
    struct OfRollout {
        const void* log = nullptr;
        std::uint64_t run = 0;
        std::shared_ptr<const MotionBands> bands = {};
    };
    void follow();
    void forget();
    void followRollout(const Shown& shown);
    bool showsRollout(const Shown& shown) const;
    void followTick(const Shown& shown);
    void sample(const OfTick& wish, std::shared_ptr<const FieldFrame> frame);
    void sayWhatIsUnknown(const MotionBands& bands);

    const WindowFrame& frame_;
    FieldView& field_;
    const Overlay& overlay_;
    Nanoseconds ahead_;
    bool on_ = false;
    bool says_ = false;  ///< the layer was switched on, and nothing has been shown or said since
    std::optional<OfTick> pending_, known_;
    std::optional<OfRollout> rollout_;
    /// Made once for a scenario.
    struct Sampler {
        std::shared_ptr<const Scenario> of;
        std::shared_ptr<const MotionSampler> sampler;
    };
    std::shared_ptr<const Sampler> sampler_;
    JobQueue sampling_, ofRollouts_;
};

}  // namespace mrose::gui
