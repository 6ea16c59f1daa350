#pragma once

#include <cstdint>
#include <vector>

#include "renderer/data/dataset.h"

namespace volcast::data {

/// Mean and standard deviation of all values of a field, over all its steps; NaN left out.
struct Moments {
    std::uint64_t values = 0;  ///< That are numbers.
    double mean = 0.0;         ///< 0 without values.
    double deviation = 0.0;
};

/// Of each field or channel, in the order of the dataset's; reads every value once.
///
/// Source: T. Chan, G. Golub, R. LeVeque, Updating Formulae and a Pairwise Algorithm for Computing
/// Sample Variances, 1979, equation 2.1: blocks are combined, so that no digits are lost.
std::vector<Moments> momentsOf(const Dataset& dataset);

}  // namespace volcast::data
