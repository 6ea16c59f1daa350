#pragma once

#include <string>
#include <vector>

#include "renderer/data/dataset.h"
#include "volcast/v1/session.pb.h"

namespace volcast::session {

/// A loaded dataset as clients see it; the version is left to the caller.
v1::DatasetInfo describe(const std::string& id, const std::string& name,
                         const data::DatasetSummary& summary,
                         const std::vector<std::string>& warnings);

}  // namespace volcast::session
