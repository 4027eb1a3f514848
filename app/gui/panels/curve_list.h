#pragma once

#include <QPen>
#include <QTreeWidget>
#include <optional>
#include <vector>

#include "widgets/theme.h"
#include "widgets/whole_rows.h"

namespace mrose::gui {

/// A legend of the plots with the numbers of an instant; several curves of one body or of one axis under its name.
class CurveList final : public WholeRows<QTreeWidget> {
    Q_OBJECT

public:
    explicit CurveList(const QFont& font);

    struct Line {
        QPen pen;
        QString label, unit, tip;
        QString group = {};  ///< written above the first of those that have it; empty: nothing
        int number = 0;      ///< the caller's for it
        std::size_t axis = 0;
        bool counts = true;  ///< it has numbers
    };
    void setLines(const std::vector<Line>& lines, const Theme& theme);
    /// Of a line. The column grows with its numbers and stays so: nothing jumps.
    void setNumber(int line, double number, int decimals);

signals:
    void removalWanted(int line);
    void clearWanted();

protected:
    void keyPressEvent(QKeyEvent* event) override;
    void contextMenuEvent(QContextMenuEvent* event) override;

private:
    std::optional<int> lineOf(QTreeWidgetItem* item) const;
    void makeRoomFor(const QString& number);

    std::vector<std::optional<int>> lines_;  ///< of each item its line's number; nullopt: it is a group's name
    std::vector<QString> units_;             ///< of each item
    int numberWidth_ = 0;
};

}  // namespace mrose::gui
