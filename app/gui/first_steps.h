#pragma once

#include <QFrame>
#include <vector>

class QLabel;

namespace mrose::gui {

class MainWindow;

/// What to try first, ticked off as it is done: a card in a corner of the field view. Its user may close it, and the
/// menu brings it back.
class FirstSteps final : public QFrame {
    Q_OBJECT

public:
    explicit FirstSteps(MainWindow& window);

    struct Step {
        QString keys, text;
        bool done = false;
    };
    const std::vector<Step>& steps() const { return steps_; }
    void setVisible(bool visible) override;

signals:
    void closeRequested();

protected:
    bool eventFilter(QObject* watched, QEvent* event) override;
    void showEvent(QShowEvent* event) override;
    void paintEvent(QPaintEvent* event) override;

private:
    void add(const Step& step, std::initializer_list<const char*> actions);
    void tick(std::size_t step);
    void place();

    MainWindow& window_;
    std::vector<Step> steps_;
    std::vector<QLabel*> marks_;
    std::size_t branches_ = 1;
    bool waits_ = false;  ///< to be shown again
};

}  // namespace mrose::gui
