// Runs the tests within a Qt application, without a display unless QT_QPA_PLATFORM says otherwise.
#include <QStandardPaths>
#include <QTemporaryDir>
#include <cstdlib>
#include <string>

#include <gtest/gtest.h>

#include "application.h"
#include "plugin/plugin_host.h"
#include "workflow/plugins.h"

int main(int argc, char** argv) {
    // The window's plug-ins live in processes of its program, which is this one here.
    if (argc == 3 && std::string(argv[1]) == mrose::pluginHostWord) {
        mrose::servePlugin(std::atoi(argv[2]));
        return 0;
    }
    testing::InitGoogleTest(&argc, argv);
    if (!qEnvironmentVariableIsSet("QT_QPA_PLATFORM")) qputenv("QT_QPA_PLATFORM", "offscreen");
    // What the window remembers of its user stays out of the tests, and theirs out of it.
    const QTemporaryDir home;
    for (const char* place : {"XDG_CONFIG_HOME", "XDG_CACHE_HOME", "XDG_DATA_HOME", "XDG_RUNTIME_DIR"})
        qputenv(place, home.path().toUtf8());
    const auto app = mrose::gui::makeApplication(argc, argv);
    return RUN_ALL_TESTS();
}
