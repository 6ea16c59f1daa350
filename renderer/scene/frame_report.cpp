#include "renderer/scene/frame_report.h"

#include <algorithm>
#include <string>

#include "renderer/plan/effects.h"

namespace volcast::scene {

std::vector<LayerOrder> ordersOf(const Frame& frame) {
    std::vector<LayerOrder> orders;
    for (const LayerDraw& draw : frame.draws) {
        const mesh::OrderReport report = frame.view->layers[draw.layer->id].projection->order();
        if (report.cells > 0) orders.push_back({.layer = draw.layer->id, .report = report});
    }
    return orders;
}

std::vector<LayerSteps> stepsOf(const Frame& frame) {
    std::vector<LayerSteps> steps;
    for (const LayerDraw& draw : frame.draws) {
        const bool cells = draw.part != nullptr && draw.part->gpu != nullptr &&
                           draw.plan->evaluator != plan::Evaluator::kMeshRaster;
        if (!cells) continue;
        LayerSteps& one = steps.emplace_back(LayerSteps{.layer = draw.layer->id});
        if (isProjected(draw)) {
            one.cellsDrawn = draw.state->projection->cellsDrawn();
        } else {
            one.walkSteps = draw.state->walk->steps();
        }
    }
    return steps;
}

std::vector<LayerBricks> bricksOf(const Frame& frame) {
    std::vector<LayerBricks> bricks;
    for (const LayerDraw& draw : frame.draws) {
        const auto& report = frame.view->layers[draw.layer->id].brickReport;
        if (report) bricks.push_back({.layer = draw.layer->id, .report = *report});
    }
    return bricks;
}

void tellBricks(const LayerBricks& bricks, plan::FramePlan& frame) {
    const auto layer = std::ranges::find(frame.layers, bricks.layer, &plan::LayerPlan::layer);
    const auto effect = std::ranges::find(layer->effects, plan::kBricks, &plan::Effect::name);
    if (effect == layer->effects.end()) return;
    const volume::BrickReport& report = bricks.report;
    const auto count = [](std::size_t n) { return std::to_string(n); };
    effect->reason += "; level " + std::to_string(report.finest);
    if (report.coarsest != report.finest)
        effect->reason += " to " + std::to_string(report.coarsest);
    effect->reason += report.limited ? ", no finer because there is no room"
                                     : ", as the step and the pixels ask for";
    effect->reason += "; " + count(report.needed) + " bricks needed, " + count(report.resident) +
                      " of them there; " + count(report.hidden) +
                      " without a value that shows and " + count(report.outside) +
                      " outside of the picture passed over";
}

void tellOrder(const LayerOrder& order, plan::FramePlan& frame) {
    const auto layer = std::ranges::find(frame.layers, order.layer, &plan::LayerPlan::layer);
    const auto effect =
        std::ranges::find(layer->effects, plan::kVisibilityOrder, &plan::Effect::name);
    const mesh::OrderReport& report = order.report;
    effect->reason +=
        std::string{"; sorted by "} + (report.byPowerDistance ? "power distance" : "centroid") +
        ": " + std::to_string(report.sortViolations) + " pairs of neighbours came out wrong, " +
        std::to_string(report.orderViolations) + " are left";
}

}  // namespace volcast::scene
