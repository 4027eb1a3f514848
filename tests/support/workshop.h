#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "support/run_program.h"
#include "support/temporary_folder.h"
#include "workflow/train_network.h"

namespace mrose {

/// Four runs of 25 s of one robot called "planted", dead time 200 ms, as a CSV file's text.
std::string plantedCsv();

/// A folder in which a user works: a log, a network learned from it.
class Workshop : public testing::Test {
protected:
    std::string path(const std::string& name) const { return (folder_.path() / name).string(); }
    std::string write(const std::string& name, const std::string& content) const {
        return folder_.write(name, content).string();
    }
    /// The file's content; "" where there is none.
    std::string read(const std::string& name) const;
    /// Names of what the folder holds, folders included, sorted.
    std::vector<std::string> listing() const;

    /// The log, written once.
    std::string log();
    /// A network that was learned from it in a few epochs.
    std::string network();
    /// Where each run of the log has a window, in the order of the log.
    std::string windows();

    /// In a few epochs, as trainWords() says it to the program.
    static TrainRequest training(const std::string& log, const std::string& out);
    std::vector<std::string> trainWords(const std::string& out) { return trainWords(log(), out); }
    std::vector<std::string> trainWords(const std::string& log, const std::string& out) const {
        return {"train", log, "-o", out, "--epochs", "20", "--members", "1", "--folds", "2", "--hidden", "6"};
    }

private:
    TemporaryFolder folder_;
};

/// The program where MROSE_DATA names that folder.
ProgramResult runWithData(const std::string& folder, const std::vector<std::string>& words);

/// `text` with `from`, which must be in it, replaced by `to` where it first occurs.
std::string replaced(std::string text, const std::string& from, const std::string& to);

/// The text's first `count` lines.
std::string firstLines(const std::string& text, int count);

/// One line on standard error that begins "mrose: " and holds all of `parts`; nothing else but what training prints.
void expectOneLine(const ProgramResult& result, const std::vector<std::string>& parts, int status = 1);

}  // namespace mrose
