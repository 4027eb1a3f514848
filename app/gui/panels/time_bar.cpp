#include "panels/time_bar.h"

#include <QComboBox>
#include <QLabel>
#include <QToolButton>
#include <algorithm>
#include <array>
#include <limits>

#include "frame/actions.h"
#include "frame/tool_bar_keys.h"
#include "widgets/icons.h"

namespace mrose::gui {
namespace {

constexpr std::array speeds{0.1, 0.25, 0.5, 1.0, 2.0, 5.0, 10.0, 50.0, 0.0};
constexpr int usualSpeed = 3;

QString speedName(double speed) {
    if (speed == 0) return QObject::tr("as fast as possible");
    return QString::fromUtf8("\u00d7 ") + QString::number(speed, 'g', 3);
}

}  // namespace

TimeBar::TimeBar(const WindowFrame& frame)
    : QToolBar(tr("Time")), frame_(frame), speed_(new QComboBox), factor_(new QLabel), seed_(new QToolButton) {
    setObjectName("time_bar");
    setMovable(false);
    setIconSize({20, 20});
    for (const double speed : speeds) speed_->addItem(speedName(speed), speed);
    speed_->setCurrentIndex(usualSpeed);
    speed_->setToolTip(tr("Simulated seconds per second"));
    connect(speed_, QOverload<int>::of(&QComboBox::currentIndexChanged), this,
            [this](int index) { frame_.session.setSpeed(speed_->itemData(index).toDouble()); });
    factor_->setMinimumWidth(190);
    factor_->setContentsMargins(10, 0, 0, 0);
    seed_->setToolButtonStyle(Qt::ToolButtonTextOnly);
    connect(&frame.session, &Session::shown, this, &TimeBar::refresh);
}

void TimeBar::addActions() {
    for (const char* name :
         {"reset", "to_start", "period_back", "tick_back", "play", "tick_forward", "period_forward", "to_end"})
        addAction(&frame_.actions[name]);
    addSeparator();
    addWidget(speed_);
    addWidget(factor_);
    addSeparator();
    seed_->setDefaultAction(&frame_.actions["restart_with_seed"]);
    addWidget(seed_);
    addSeparator();
    addAction(&frame_.actions["fit"]);
    addAction(&frame_.actions["follow"]);
    new ToolBarKeys(*this);
}

void TimeBar::changeSpeed(int by) {
    speed_->setCurrentIndex(std::clamp(speed_->currentIndex() + by, 0, speed_->count() - 1));
}

void TimeBar::setSpeed(double speed) {
    const auto rank = [](double some) { return some > 0 ? some : std::numeric_limits<double>::infinity(); };
    int at = 0;
    while (at < speed_->count() && rank(speed_->itemData(at).toDouble()) < rank(speed)) ++at;
    if (at == speed_->count() || speed_->itemData(at).toDouble() != speed)
        speed_->insertItem(at, speedName(speed), speed);
    speed_->setCurrentIndex(at);
}

void TimeBar::setTheme(const Theme& theme) {
    const std::initializer_list<std::pair<const char*, Icon>> icons{{"tick_forward", Icon::tickForward},
                                                                    {"tick_back", Icon::tickBack},
                                                                    {"period_forward", Icon::periodForward},
                                                                    {"period_back", Icon::periodBack},
                                                                    {"to_start", Icon::toStart},
                                                                    {"to_end", Icon::toEnd},
                                                                    {"reset", Icon::reset},
                                                                    {"fit", Icon::fit},
                                                                    {"follow", Icon::follow}};
    for (const auto& [name, which] : icons) frame_.actions[name].setIcon(icon(which, theme));
    play_ = icon(Icon::play, theme);
    pause_ = icon(Icon::pause, theme);
    refresh();
}

void TimeBar::refresh() {
    const Shown* shown = frame_.shown();
    const bool playing = shown != nullptr && shown->playing;
    QAction& play = frame_.actions["play"];
    play.setIcon(playing ? pause_ : play_);
    play.setText(playing ? tr("&Pause") : tr("&Play"));
    // Keys and scripts ask for it themselves; a button that does nothing looks so.
    for (QAction* action : actions())
        if (auto* button = qobject_cast<QToolButton*>(widgetForAction(action))) button->setEnabled(shown != nullptr);
    if (shown == nullptr) return seed_->setText(tr("seed \u2013"));
    seed_->setText(tr("seed %1").arg(shown->frame->state.seed));
    factor_->setText(
        playing ? tr("real-time factor %1").arg(shown->realTimeFactor, 0, 'f', shown->realTimeFactor < 10 ? 2 : 0)
                : tr("paused"));
}

}  // namespace mrose::gui
