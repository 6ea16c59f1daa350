#include "server/session/readiness.h"

#include <google/protobuf/struct.pb.h>
#include <google/protobuf/util/json_util.h>

namespace volcast::session {

std::string readinessJson(const workers::RenderStatus& status) {
    google::protobuf::Struct object;
    auto& fields = *object.mutable_fields();
    fields["ready"].set_bool_value(status.ready);
    fields["generation"].set_number_value(status.generation);
    fields["losses"].set_number_value(status.losses);
    fields["spare_ready"].set_bool_value(status.spareReady);
    fields["worker_pid"].set_number_value(status.workerPid);
    fields["spare_pid"].set_number_value(status.sparePid);
    fields["gl_renderer"].set_string_value(status.glRenderer);
    fields["gl_version"].set_string_value(status.glVersion);
    fields["gpu_given_up"].set_string_value(status.gpuGivenUp);
    fields["last_loss"].set_string_value(status.lastLoss);
    std::string text;
    (void)google::protobuf::util::MessageToJsonString(object, &text);
    return text + "\n";
}

}  // namespace volcast::session
