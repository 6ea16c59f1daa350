// Measurements: asked for part by part, when no view waits for a picture.
#include <string>

#include "server/workers/supervisor.h"

namespace volcast::workers {

void Supervisor::dispatchMeasure() {
    const MeasureRequest* request = measures_.next(Clock::now());
    if (request == nullptr) return;
    measureNumber_ = nextNumber_++;
    auto asked = main_->measure(measureNumber_, request->job, settings_.frameDeadline);
    if (!asked) return finishMeasure(measureNumber_, asked.error());
    static_cast<void>(main_->flush());
}

void Supervisor::continueMeasure(std::uint64_t number) {
    if (!measures_.inHand() || number != measureNumber_) {
        return lose(main_, "measured what nobody asked for");
    }
    const auto late = measures_.goOn(Clock::now());
    if (!late) return;
    main_->stopMeasuring();
    tell(*late,
         fail(ErrorCode::kTimeout, "the measurement missed its deadline of " +
                                       std::to_string(settings_.measureDeadline.count()) + " ms"));
}

void Supervisor::stopMeasure(std::uint64_t view) {
    if (measures_.stop(view) && main_) main_->stopMeasuring();
}

void Supervisor::tell(const MeasureRequest& request,
                      const Result<accuracy::Measurement>& result) const {
    if (events_.measured) events_.measured(request.view, request.tag, result);
}

void Supervisor::finishMeasure(std::uint64_t number, const Result<accuracy::Measurement>& result) {
    if (!measures_.inHand() || number != measureNumber_) {
        return lose(main_, "measured what nobody asked for");
    }
    tell(measures_.finish(), result);
}

}  // namespace volcast::workers
