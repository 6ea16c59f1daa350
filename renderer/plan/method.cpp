#include "renderer/plan/method.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <limits>
#include <string>

namespace volcast::plan {

using scene::Accuracy;
using scene::Integrator;

namespace {

std::string number(double value) {
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), "%.3g", value);
    return text.data();
}

std::string named(Integrator integrator) {
    return std::string{scene::name(integrator)};
}

double costOf(const Evidence& one) {
    return one.predictedMs.value_or(std::numeric_limits<double>::infinity());
}

/// The cheapest whose error holds; where costs are not known the first that holds.
Method withinError(double bound, std::span<const Evidence> evidence, Integrator exact) {
    const Evidence* best = nullptr;
    for (const Evidence& one : evidence) {
        if (!one.error || *one.error > bound) continue;
        if (best == nullptr || costOf(one) < costOf(*best)) best = &one;
    }
    if (best == nullptr) {
        return {.integrator = exact,
                .reason = "no other is known to stay within " + number(bound) + "/255"};
    }
    return {.integrator = best->integrator,
            .reason = "the cheapest within " + number(bound) + "/255: off by " +
                      number(*best->error) + "/255 at most on a sample"};
}

/// The most accurate whose time holds; among those of unknown error the last listed.
Method withinTime(double bound, std::span<const Evidence> evidence, Integrator exact) {
    const Evidence* best = nullptr;
    const Evidence* cheapest = nullptr;
    for (const Evidence& one : evidence) {
        if (!one.predictedMs) continue;
        if (cheapest == nullptr || costOf(one) < costOf(*cheapest)) cheapest = &one;
        if (*one.predictedMs > bound) continue;
        const bool better =
            best == nullptr || !one.error || !best->error || *one.error <= *best->error;
        if (better) best = &one;
    }
    if (cheapest == nullptr) {
        return {.integrator = exact, .reason = "nothing is known of what others cost"};
    }
    if (best == nullptr) {
        return {.integrator = cheapest->integrator,
                .reason = "the fastest; even it takes about " + number(costOf(*cheapest)) +
                          " ms of " + number(bound)};
    }
    return {.integrator = best->integrator,
            .reason = "the most accurate within " + number(bound) + " ms: about " +
                      number(costOf(*best)) + " ms"};
}

}  // namespace

bool needsEvidence(const scene::Layer& layer, const Accuracy& wish) {
    const bool bounded =
        wish.kind == Accuracy::Kind::kErrorBound || wish.kind == Accuracy::Kind::kTimeBudget;
    return bounded && layer.shader.code.empty() && layer.integrator == Integrator::kAuto &&
           scene::row(layer.model).integrators.size() > 1;
}

Method chooseMethod(const scene::Layer& layer, std::span<const scene::IntegratorRow> integrators,
                    const Accuracy& wish, bool constantInCells,
                    std::span<const Evidence> evidence) {
    const Integrator exact = integrators.back().integrator;
    const Integrator cheap = integrators.front().integrator;
    if (layer.integrator != Integrator::kAuto) {
        return {.integrator = layer.integrator, .reason = "asked for by name"};
    }
    if (integrators.size() == 1) {
        return {.integrator = exact, .reason = "the model has one way, and it is exact"};
    }
    if (constantInCells) {
        return {.integrator = cheap,
                .reason = "one value a cell, so that " + named(cheap) + " is exact"};
    }
    switch (wish.kind) {
        case Accuracy::Kind::kFastest:
            return {.integrator = cheap, .reason = "the fastest is asked for"};
        case Accuracy::Kind::kExact:
            return {.integrator = exact, .reason = "an exact picture is asked for"};
        case Accuracy::Kind::kErrorBound: return withinError(wish.bound, evidence, exact);
        case Accuracy::Kind::kTimeBudget: return withinTime(wish.bound, evidence, exact);
        case Accuracy::Kind::kAuto: break;
    }
    return {.integrator = exact, .reason = "exact costs little more"};
}

}  // namespace volcast::plan
