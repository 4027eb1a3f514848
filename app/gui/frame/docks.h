#pragma once

#include <QMainWindow>
#include <QSize>
#include <QTimer>
#include <array>
#include <optional>
#include <vector>

class QDockWidget;
class QSettings;

namespace mrose {
class FieldView;
}

namespace mrose::gui {

/// The panels around the field: where they lie, and how large they are. A run and a real log are looked at in layouts
/// of their own, each of which is as its user left it. Panels have the size that the user or the new window gave them,
/// but the field keeps its least share of the window, and one that has nothing to show takes no more than a narrow bar.
class Docks final : public QObject {
    Q_OBJECT

public:
    /// Of the window's width and height, for as long as the mouse does not say otherwise.
    static constexpr double leastFieldWidth = 0.45, leastFieldHeight = 0.4;
    enum class Layout { run, log };

    Docks(QMainWindow& window, FieldView& field);

    /// `size` in pixels, in a new window. One above others keeps the height of what is in it, or if that is given
    /// `leastHeight`, where the others need theirs.
    QDockWidget& add(const char* name, const QString& title, QWidget* content, Qt::DockWidgetArea area,
                     const QSize& size, std::optional<int> leastHeight = {});
    /// Takes what is there now for a new window's.
    void keepAsNew();

    QDockWidget& operator[](const char* name) const;
    /// It is a panel that has nothing to show, and a narrow bar.
    static bool isFolded(const QWidget& part);
    /// There is nothing to be seen in it, or is again. What the mouse holds in the field does not move meanwhile, nor
    /// between two clicks.
    void setEmpty(const char* name, bool empty);
    void setLayout(Layout layout);
    void reset();  ///< as in a new window, of both kinds

    void save(QSettings& settings);
    void restore(const QSettings& settings);

protected:
    bool eventFilter(QObject* watched, QEvent* event) override;

private:
    struct Panel {
        QDockWidget* dock = nullptr;
        QSize size;  ///< pixels, wanted while it is not folded
        std::optional<int> leastHeight;
        bool empty = false;
        bool folded() const;
    };
    struct Kept {
        QByteArray state;
        std::vector<QSize> sizes;  ///< of the panels, in their order
    };
    void arrange();
    void arrangeColumns();
    void arrangeColumn(Qt::DockWidgetArea area);
    void arrangeRows();
    void fold();
    void openNew();
    void open(const Kept& kept);
    Kept present() const;
    void setSizes(const std::vector<QSize>& sizes);
    std::vector<const Panel*> shownIn(Qt::DockWidgetArea area) const;
    Panel& panelOf(const QObject* dock);
    bool mayFold(const QDockWidget& dock) const;
    int separator() const;  ///< pixels, between panels and what is beside them

    /// Of the docks' arrangement: another one makes old settings unfit.
    static constexpr int version = 2;

    QMainWindow& window_;
    FieldView& field_;
    std::vector<Panel> panels_;
    Kept new_;
    std::array<Kept, 2> kept_;  ///< empty: as in a new window
    Layout layout_ = Layout::run;
    bool dragged_ = false;  ///< a separator is
    QTimer soon_, afterClick_;
};

}  // namespace mrose::gui
