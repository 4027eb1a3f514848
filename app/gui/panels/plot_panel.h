#pragma once

#include <QWidget>
#include <map>
#include <memory>
#include <optional>
#include <vector>

#include "debug/plotted_value.h"
#include "panels/curve_looks.h"
#include "session/series_worker.h"
#include "session/session.h"
#include "widgets/plot_view.h"
#include "widgets/theme.h"

class QLabel;
class QLineEdit;
class QProgressBar;
class QScrollArea;

namespace mrose {
class ElidingLabel;
}

namespace mrose::gui {

class CurveList;

/// What is plotted over the time of the shown branch, with the branch beside it as ghosts; the list of the curves with
/// their numbers; and a line for expressions.
class PlotPanel final : public QWidget {
    Q_OBJECT

public:
    explicit PlotPanel(Session& session, QWidget* parent = nullptr);
    ~PlotPanel() override;

    void setShown(std::shared_ptr<const Shown> shown);
    void setTheme(const Theme& theme);

    /// Error: the scenario has nothing like that.
    Expected<void> add(const ValueKey& key);
    Expected<void> addExpression(const QString& text);
    /// Adds it, or removes it where it is plotted.
    void toggle(const ValueKey& key);
    /// Of every robot, where not all are plotted; otherwise removes them.
    void toggleOfAll(const ValueKey& key);
    /// All of them, where not all are plotted; otherwise removes them.
    void toggleAll(std::vector<ValueKey> keys);
    /// Puts others where the first of some is, without those, or before all where none is.
    void replace(const std::vector<ValueKey>& some, const std::vector<ValueKey>& others);
    void remove(const ValueKey& key);
    void removeReal();  ///< what depends on the real log: there is none any more
    void clear();
    void askForExpression();  ///< the keyboard goes to its line
    void settle();            ///< all is computed and drawn; for scripts and tests
    void cancel();            ///< what has not been computed of the past stays unknown

    /// What is known of a run before it has happened.
    struct Foresight {
        std::uint64_t run = 0;                                ///< Shown::run
        std::int64_t end = 0;                                 ///< the tick to which the axis of time reaches
        QString model;                                        ///< that moves the run's robots
        std::map<ValueKey, QVector<QPointF>> ahead;           ///< PlotCurve::ahead
        std::map<ValueKey, QVector<ExpectedRange>> expected;  ///< PlotCurve::expected
        bool operator==(const Foresight&) const = default;
    };
    void setForesight(Foresight foresight);

    /// As of PlotView; the list names what is dashed.
    void setReferences(std::vector<PlotLevel> levels, std::optional<std::int64_t> instant);
    /// Those that are drawn: some curve is of their unit.
    std::vector<PlotLevel> levels() const;

    const std::vector<ValueKey>& keys() const { return keys_; }
    std::map<ValueKey, QColor> plotted() const;
    /// The branch whose curves are beside those of the shown one; nullopt: none.
    std::optional<std::uint32_t> ghostBranch() const;
    QString ghostName() const;
    /// All of them in the colours of a theme. They live as long as this.
    std::vector<PlotCurve> curvesIn(const Theme& theme, ModelNames names = ModelNames::whole) const;
    PlotView& view() const { return *view_; }
    SeriesWorker& computing() const { return *series_; }
    const ValueSeries& series() const { return series_->series(); }

    QSize sizeHint() const override { return {400, 230}; }  // panels beside it keep their widths

signals:
    void tickRequested(std::int64_t tick);
    void changed();  ///< of what is plotted
    void asked();    ///< something was added and is to be seen

protected:
    void resizeEvent(QResizeEvent* event) override;

private:
    QWidget* makeSide();
    void rebuild();
    const Foresight* foresight() const;
    void follow();
    void updateList();
    void updateNumbers();
    void updateProgress();

    std::unique_ptr<SeriesWorker> series_;
    std::shared_ptr<const Shown> shown_;
    std::vector<ValueKey> keys_;  ///< in the order in which they were added
    std::vector<CurveLook> looks_;
    Foresight foresight_;
    std::optional<std::int64_t> hovered_;
    std::int64_t mostBehind_ = 0;
    Theme theme_ = Theme::light();

    PlotView* view_;
    QScrollArea* area_;  ///< about it
    QLabel* hint_;
    QWidget* side_ = nullptr;
    CurveList* list_;
    ElidingLabel* ghostNote_;  ///< which curves are the other branch's
    QLineEdit* expression_;
    QLabel* error_;
    QWidget* progress_;
    QProgressBar* bar_;
};

}  // namespace mrose::gui
