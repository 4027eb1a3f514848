#pragma once

#include <optional>
#include <string>
#include <vector>

#include "assessment/evaluate.h"
#include "report/page.h"

namespace mrose {

/// What is said of a drive that would teach a network most. All of it is plain text.
struct SheetAdvice {
    std::string drive;                 ///< "120 s, in 3.1 x 2.7 m"
    std::vector<std::string> reasons;  ///< what it is made of, and why
    std::string command;               ///< that writes it
};

/// Of one motion network and a team's own log: how true, how certain, where not to trust it, what to drive next.
struct Sheet {
    Evaluation evaluation;
    ReportContext context;
    /// By window the share of its periods in which the robot was driven as the network was never learned; empty: not
    /// known.
    std::vector<double> unfamiliar;
    std::optional<SheetAdvice> advice;  ///< nullopt: there is none
    std::string withoutAdvice;          ///< why
};

/// On one page, which prints on one side of A4; it needs nothing else. The evaluation has a model and a window.
std::string sheetHtml(const Sheet& sheet);

}  // namespace mrose
