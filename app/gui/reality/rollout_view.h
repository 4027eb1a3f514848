#pragma once

#include <optional>
#include <string>

#include "debug/log_rollouts.h"
#include "session/session.h"
#include "widgets/view_transform.h"

namespace mrose {
class FieldView;
}

namespace mrose::gui {

/// What the field shows of the rollouts of a log: which part of the place, and which robot is selected, from one
/// rollout to the next.
class RolloutView {
public:
    RolloutView(const Session& session, FieldView& field, const LogRollouts& rollouts)
        : session_(session), field_(field), rollouts_(rollouts) {}

    /// The rollout of the robot that is asked about from near: errors are small beside the place.
    void showNear();
    /// Where all of the place is seen, or it lies outside of what is seen.
    void showNearer();
    void showNearIfAside();
    void select(std::size_t robot);

    /// What is seen now, to be seen in another rollout again.
    struct Kept {
        std::string selected;  ///< its name; empty: nothing
        bool near = false;
        std::optional<ViewTransform> view = {};  ///< the part of the place that was seen; nullopt: all of it
    };
    /// `robot` is picked: it is selected, and its rollout seen from near. `sameLog`: what is shown is a rollout too.
    Kept keep(std::optional<std::size_t> robot, bool sameLog) const;
    /// A robot that is not in the shown rollout is selected in the next that has it.
    void selectAgain(const Kept& kept);
    void showAgain(const Kept& kept);
    void forget() { absent_.clear(); }

private:
    bool isAside() const;

    const Session& session_;
    FieldView& field_;
    const LogRollouts& rollouts_;
    std::string absent_;  ///< was selected before a rollout that does not have it; empty: none
};

}  // namespace mrose::gui
