// What a session tells of how its views are drawn: plans, what accuracy costs, controls of code.
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "server/session/explain.h"
#include "server/session/session.h"
#include "server/session/shader_description.h"

namespace volcast::session {

void Session::explain(const v1::Explain& message) {
    const View* view = findOrRefuse(message.view(), 0);
    if (view == nullptr) return;
    if (!view->plan) {
        return send(errorMessage(
            v1::ERROR_CODE_NOT_FOUND,
            "view " + std::to_string(view->number) + " has no picture yet that could be explained",
            {.view = view->number}, "view"));
    }
    v1::ServerMessage reply;
    *reply.mutable_plan() = *view->plan;
    send(reply);
}

void Session::describeShader(const v1::DescribeShader& message) {
    v1::ServerMessage reply;
    *reply.mutable_shader_description() =
        shaderDescription(message, shared_.catalogue.summaries({message.dataset()}));
    send(reply);
}

void Session::measureAccuracy(const v1::MeasureAccuracy& message) {
    View* view = findOrRefuse(message.view(), 0);
    if (view == nullptr) return;
    if (message.stop()) return stopMeasuring(*view, "stopped by the client");
    const auto refuseWith = [&](v1::ErrorCode code, const std::string& why) {
        send(errorMessage(code, "view " + std::to_string(view->number) + " " + why,
                          {.view = view->number}, "view"));
    };
    const std::optional<scene::Scene>& scene = view->scene.scene();
    if (!scene || !view->plan) {
        return refuseWith(v1::ERROR_CODE_NOT_FOUND, "has no picture yet that could be measured");
    }
    stopMeasuring(*view, "measured anew");
    std::set<std::string> volumes;
    std::vector<std::string> ids;
    for (const scene::Layer& layer : scene->layers) ids.push_back(layer.dataset);
    for (const auto& [id, summary] : shared_.catalogue.summaries(ids)) {
        if (!summary.isMesh) volumes.insert(id);
    }
    view->accuracy.start(*scene, view->scene.size(), message.max_pixels(), volumes);
    if (!view->accuracy.running()) {
        return refuseWith(v1::ERROR_CODE_UNSUPPORTED, "has no visible layer to measure");
    }
    measureNext(*view);
}

void Session::measured(std::uint64_t global, std::uint64_t tag,
                       const Result<accuracy::Measurement>& result) {
    View* view = findGlobal(global);
    if (view == nullptr || !view->accuracy.measured(tag, result)) return;
    v1::ServerMessage message;
    *message.mutable_accuracy_report() = view->accuracy.report(view->number);
    send(message);
    if (view->accuracy.running()) measureNext(*view);
}

void Session::measureNext(View& view) {
    std::uint64_t tag = 0;
    accuracy::Job job = view.accuracy.job(tag);
    shared_.render.measure({.view = view.global, .tag = tag, .job = std::move(job)});
}

void Session::stopMeasuring(View& view, const std::string& why) {
    if (!view.accuracy.running()) return;
    view.accuracy.stop();
    shared_.render.stopMeasuring(view.global);
    v1::ServerMessage message;
    *message.mutable_accuracy_report() = view.accuracy.report(view.number);
    message.mutable_accuracy_report()->set_stopped(why);
    send(message);
}

}  // namespace volcast::session
