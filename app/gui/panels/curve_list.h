#pragma once

#include <QTreeWidget>
#include <optional>
#include <vector>

#include "panels/curve_looks.h"
#include "widgets/theme.h"

namespace mrose::gui {

/// The legend of the plots: each curve's line, its name, its number and unit; several curves of one body under its
/// name.
class CurveList final : public QTreeWidget {
    Q_OBJECT

public:
    explicit CurveList(QWidget* parent = nullptr);

    struct Entry {
        CurveWords words;
        CurveLook look;
        QString whole;  ///< its name alone, for the tool tip
        QString unit;
    };
    void setEntries(const std::vector<Entry>& entries, const Theme& theme);
    void setNumber(std::size_t entry, const QString& number);

signals:
    void removalWanted(std::size_t entry);
    void clearWanted();

protected:
    void keyPressEvent(QKeyEvent* event) override;
    void contextMenuEvent(QContextMenuEvent* event) override;

private:
    std::optional<std::size_t> entryOf(QTreeWidgetItem* item) const;
    void makeRoomFor(const QString& number);

    std::vector<std::optional<std::size_t>> lines_;  ///< the entry of each; nothing: a body's name
    int numberWidth_ = 0;
};

}  // namespace mrose::gui
