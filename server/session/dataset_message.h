#pragma once

#include <string>
#include <vector>

#include "renderer/data/dataset.h"
#include "server/workers/import_service.h"
#include "volcast/v1/session.pb.h"

namespace volcast::session {

/// A loaded dataset as clients see it; the version is left to the caller.
v1::DatasetInfo describe(const std::string& id, const std::string& name,
                         const data::DatasetSummary& summary,
                         const std::vector<std::string>& warnings);

/// What of the fields' statistics is not in the summary; `moments` are in their order.
void addMoments(v1::DatasetInfo& info, const std::vector<data::Moments>& moments);

/// How `imported` was read; now is when.
v1::ImportLog logOf(const workers::ImportedDataset& imported);

}  // namespace volcast::session
