#pragma once

#include <QApplication>
#include <memory>

namespace mrose::gui {

/// Qt's application as the window wants it: `count` and `words` must live as long.
std::unique_ptr<QApplication> makeApplication(int& count, char** words);

}  // namespace mrose::gui
