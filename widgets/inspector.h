#pragma once

#include <memory>
#include <optional>

#include <QWidget>

#include "widgets/command_queue.h"
#include "widgets/field_frame.h"
#include "widgets/theme.h"

class QLabel;
class QTreeWidget;

namespace mrose {

/// All about one body at the shown tick.
class Inspector final : public QWidget {
    Q_OBJECT

public:
    explicit Inspector(QWidget* parent = nullptr);

    void setFrame(std::shared_ptr<const FieldFrame> frame);
    void setBody(std::optional<std::size_t> body);
    void setTheme(const Theme& theme);

    QSize sizeHint() const override { return {320, 560}; }

private:
    void refresh();

    std::shared_ptr<const FieldFrame> frame_;
    std::optional<std::size_t> body_;
    Theme theme_ = Theme::light();
    QLabel *chip_, *title_, *hint_;
    CommandQueue* queue_;
    QTreeWidget* tree_;
};

}  // namespace mrose
