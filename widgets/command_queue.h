#pragma once

#include <vector>

#include <QWidget>

#include "motion/motion_model.h"
#include "widgets/theme.h"
#include "world/command.h"

namespace mrose {

/// The commands of one robot on their way: each travels from "issued" on the right to "takes effect" on the left, where
/// the one in force has arrived. Two lanes, of forward speed and of rotation, since their dead times may differ.
class CommandQueue final : public QWidget {
    Q_OBJECT

public:
    struct Content {
        std::vector<StampedCommand> commands;  ///< oldest first
        Command before;                        ///< in force before those
        Nanoseconds now = 0;
        MotionModel::DeadTimes deadTimes;
    };
    explicit CommandQueue(QWidget* parent = nullptr);

    void setContent(Content content);
    void setTheme(const Theme& theme);

    QSize sizeHint() const override { return {260, 92}; }
    QSize minimumSizeHint() const override { return {160, 92}; }

protected:
    void paintEvent(QPaintEvent* event) override;

private:
    void lane(QPainter& painter, const QRectF& box, bool rotation);

    Content content_;
    Theme theme_ = Theme::light();
};

/// The command that takes effect now, and those still on their way with the time until they do, in order.
struct CommandsOnTheWay {
    Command active;
    struct Coming {
        StampedCommand issued;
        Nanoseconds untilV = 0, untilW = 0;  ///< 0: already in effect
    };
    std::vector<Coming> coming;
};
CommandsOnTheWay commandsOnTheWay(const CommandQueue::Content& content);

}  // namespace mrose
