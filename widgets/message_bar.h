#pragma once

#include <QString>
#include <QWidget>
#include <functional>
#include <vector>

#include "widgets/theme.h"

class QVBoxLayout;

namespace mrose {

/// What there is to say, a line each, above the field: it takes no focus and blocks nothing. The text can be selected;
/// each line can be dismissed. Of more notes than two only the newest is seen, until its line is opened; of all
/// messages only the newest error, or else note, where they would hide more than a quarter of what they stand over.
class MessageBar final : public QWidget {
    Q_OBJECT

public:
    enum class Kind { note, error, progress };
    struct Button {
        QString text, tip;
        std::function<void()> run;
    };
    struct Message {
        Kind kind = Kind::note;
        QString text;
        QString topic = {};  ///< takes the place of the earlier one of this topic; empty: of the one that says the same
        std::vector<Button> buttons = {};
        double share = -1;  ///< of progress: how much is done; negative: unknown
    };

    explicit MessageBar(QWidget* parent = nullptr);

    /// Along another widget's upper edge, over what it shows: it does not move when something is said.
    void standOver(QWidget& host);

    void add(Message message);
    /// All of a topic; nothing where there is none.
    void remove(const QString& topic);
    void clear();
    /// The newest that is seen and waits for nothing; false: there is none.
    bool dismiss();
    /// Oldest first.
    std::vector<Message> messages() const;
    bool has(const QString& topic) const;
    void setTheme(const Theme& theme);

signals:
    void added(MessageBar::Kind kind, const QString& text);

protected:
    bool event(QEvent* event) override;
    bool eventFilter(QObject* watched, QEvent* event) override;

private:
    class Line;
    static constexpr std::size_t most = 4;       ///< notes give way before errors
    static constexpr std::size_t mostNotes = 2;  ///< that are not folded
    static constexpr double mostHidden = 0.25;   ///< of the host's height
    void drop(std::size_t index);
    void makeRoom();
    void fold();
    void place();
    int heightOfAll() const;

    std::vector<Line*> lines_;
    QVBoxLayout* layout_;
    bool open_ = false;  ///< folded ones are seen
    Theme theme_ = Theme::light();
};

}  // namespace mrose
