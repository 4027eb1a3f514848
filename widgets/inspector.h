#pragma once

#include <QSet>
#include <QWidget>
#include <map>
#include <memory>
#include <optional>

#include "debug/field_frame.h"
#include "widgets/command_queue.h"
#include "widgets/inspector_rows.h"
#include "widgets/theme.h"

class QLabel;
class QTreeWidget;
class QTreeWidgetItem;

namespace mrose {

class ElidingLabel;

/// All about one body at the shown tick. Its rows keep their places, so that selection, what is unfolded and where it
/// is scrolled to stay while playing; numbers can be plotted by a click at their right end, by Enter or the context
/// menu.
class Inspector final : public QWidget {
    Q_OBJECT

public:
    explicit Inspector(QWidget* parent = nullptr);

    void setFrame(std::shared_ptr<const FieldFrame> frame);
    void setBody(std::optional<std::size_t> body);
    void setTheme(const Theme& theme);
    /// What is plotted, and in which colour.
    void setPlotted(std::map<ValueKey, QColor> plotted);

    const std::optional<std::size_t>& body() const { return body_; }
    /// What the current row can plot; nullopt: there is none, or it is no number.
    std::optional<ValueKey> currentValue() const;
    CommandQueue& queue() const { return *queue_; }

    QSize sizeHint() const override { return {330, 560}; }
    QSize minimumSizeHint() const override { return {240, 160}; }

signals:
    /// To be plotted, or not any longer.
    void plotRequested(const mrose::ValueKey& key);
    void plotOfAllRequested(const mrose::ValueKey& key);  ///< of all robots
    void commandActivated(qint64 issued);                 ///< CommandQueue::commandActivated

protected:
    bool eventFilter(QObject* watched, QEvent* event) override;
    void resizeEvent(QResizeEvent* event) override;
    void showEvent(QShowEvent* event) override;

private:
    void refresh();
    void refreshHead(bool robot);
    void fitTitle();
    void sync(QTreeWidgetItem* parent, const QString& path, const std::vector<InspectorRow>& rows);
    void write(QTreeWidgetItem* item, const InspectorRow& row);
    std::optional<ValueKey> valueOf(const QTreeWidgetItem* item) const;
    void askForPlot(const QTreeWidgetItem* item);
    void showMenu(const QPoint& place);
    void fitColumns();
    void measureNames();

    std::shared_ptr<const FieldFrame> frame_;
    std::optional<std::size_t> body_;
    Theme theme_ = Theme::light();
    std::map<ValueKey, QColor> plotted_;
    QSet<QString> open_;  ///< paths of rows whose children are shown
    bool syncing_ = false, fitting_ = false;
    std::optional<int> nameWidth_;  ///< pixels, of the column as the user likes it; nullopt: of the widest name
    int widestName_ = 0;            ///< pixels, that was shown of this body
    QLabel* chip_;
    QString name_, type_;  ///< of the body; the type is empty where it says the same
    ElidingLabel *title_, *kind_;
    QLabel* hint_;
    CommandQueue* queue_;
    QTreeWidget* tree_;
};

}  // namespace mrose
