#pragma once

#include <array>
#include <optional>
#include <span>

#include "perception/reading_form.h"

namespace mrose {

/// What is wrong with readings for once: a share of them is anywhere within +-reach of the truth, evenly.
struct GrossErrors {
    double share = 0;
    std::array<double, ReadingForm::maxDimensions> reach{};  ///< m or rad, by dimension
    bool operator==(const GrossErrors&) const = default;

    double density(int dimensions) const;  ///< of what is within reach
};

/// Errors by dimension: what was reported less what is true.
using ReadingError = std::array<double, ReadingForm::maxDimensions>;

/// Where from the random in one reading comes: independent numbers. Those of `reported` and `error` may be partly
/// shared with other readings (ReadingNoise).
struct ReadingDraw {
    double reported = 0;   ///< standard normal
    double which = 0;      ///< uniform in (0, 1): which member and component, or a gross error
    ReadingError error{};  ///< standard normal
};

/// The distribution of one reading: whether there is one, and of which error. The members' mixtures of normal
/// distributions, each as probable as the others, with rare gross errors.
struct ReadingDistribution {
    struct Component {
        double share = 1;               ///< of its member
        ReadingError mean{}, spread{};  ///< spread: standard deviation
    };

    ReadingForm form;
    double threshold = 0;  ///< the normal quantile of the probability that there is a reading
    std::array<Component, ReadingForm::maxMembers * ReadingForm::maxComponents> component{};  ///< member by member
    GrossErrors gross;

    /// `values`: as many as form.outputs(), in the units of the errors. Standard deviations are kept from 1e-5 to 1e3.
    static ReadingDistribution of(const ReadingForm& form, std::span<const double> values, const GrossErrors& gross);

    /// Of all members.
    std::span<const Component> components() const {
        return std::span(component).first(static_cast<std::size_t>(form.members * form.components));
    }
    /// Of all readings that are no gross errors.
    double shareOf(const Component& one) const { return one.share / form.members; }

    double probability() const;  ///< that there is a reading
    /// Density of an error given that there is a reading, and its logarithm.
    double density(const ReadingError& error) const;
    /// Of the marginal distribution of one dimension: the probability of less than `error`, mean, standard deviation.
    double probabilityBelow(int dimension, double error) const;
    double mean(int dimension) const;
    double deviation(int dimension) const;

    /// Whether there is a reading by this draw.
    bool reports(const ReadingDraw& draw) const { return draw.reported < threshold; }
    /// Its error, given that there is one.
    ReadingError error(const ReadingDraw& draw) const;
};

/// Of which member a draw's error is, and where in it.
struct MemberDraw {
    int member = 0;    ///< -1: of none, it is gross
    double which = 0;  ///< in [0, 1): which component
};
MemberDraw memberOf(const ReadingDraw& draw, const ReadingForm& form, const GrossErrors& gross);
/// The error by the member's values alone, ReadingForm::memberOutputs(), for who does not need the others':
/// ReadingDistribution::error() to the bit.
ReadingError memberError(const ReadingForm& form, const double* values, const ReadingDraw& draw, double which);
ReadingError grossError(const ReadingForm& form, const GrossErrors& gross, const ReadingDraw& draw);

/// Minus the logarithm of the likelihood of what happened, and its gradient by the values that describe the
/// distribution, which is overwritten: by the threshold, and by the values of one member as if it were the only one.
double reportLoss(double threshold, bool reported, double* gradient);
double errorLoss(const ReadingForm& form, const double* values, const GrossErrors& gross, const ReadingError& error,
                 double* gradient);

}  // namespace mrose
