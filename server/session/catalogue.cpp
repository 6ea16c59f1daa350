#include "server/session/catalogue.h"

#include <algorithm>
#include <sys/stat.h>
#include <utility>

#include <spdlog/spdlog.h>

#include "renderer/base/printable.h"
#include "server/session/beneath.h"
#include "server/session/dataset_message.h"

namespace volcast::session {

namespace {

constexpr int kRestPerScan = 10;
constexpr std::chrono::nanoseconds kLongestRest = std::chrono::seconds{1};
constexpr double kProgressStep = 0.02;
constexpr std::uint64_t kMib = std::uint64_t{1} << 20U;

std::string mib(std::uint64_t bytes) {
    return std::to_string((bytes + kMib - 1) / kMib) + " MiB";
}

std::uint64_t sizeOf(const base::FileDescriptor& packed) {
    struct stat status {};
    return ::fstat(packed.get(), &status) == 0 ? static_cast<std::uint64_t>(status.st_size) : 0;
}

v1::DatasetInfo listed(const std::string& id, const std::string& name) {
    v1::DatasetInfo info;
    info.set_id(id);
    info.set_name(name);
    return info;
}

}  // namespace

Result<std::unique_ptr<Catalogue>> Catalogue::create(CatalogueDesc desc,
                                                     workers::RenderService& render) {
    base::FileDescriptor root;
    if (!desc.folder.empty()) {
        auto opened = openFolder(desc.folder);
        if (!opened) return opened.error();
        root = std::move(*opened);
    }
    return std::unique_ptr<Catalogue>{new Catalogue{std::move(desc), render, std::move(root)}};
}

Catalogue::Catalogue(CatalogueDesc desc, workers::RenderService& render, base::FileDescriptor root)
    : desc_{std::move(desc)}, render_{render}, root_{std::move(root)} {
    if (desc_.folder.empty()) {
        entries_["demo:mesh"].info = listed("demo:mesh", "Demo: tetrahedral mesh");
        entries_["demo:volume"].info = listed("demo:volume", "Demo: voxels");
    } else {
        scan();
    }
    for (unsigned i = 0; i < std::max(1U, desc_.importsAtOnce); ++i) {
        threads_.emplace_back([this] { importLoop(); });
    }
}

Catalogue::~Catalogue() {
    {
        const std::lock_guard lock{mutex_};
        stopping_ = true;
        listeners_.clear();
    }
    wake_.notify_all();
    for (std::thread& thread : threads_) thread.join();
}

void Catalogue::look() {
    const std::lock_guard lock{scanMutex_};
    if (desc_.now() >= restUntil_) scan();
}

void Catalogue::scan() {
    if (desc_.folder.empty()) return;
    const auto began = desc_.now();
    const std::vector<FoundDataset> all = desc_.scanner(desc_.folder, root_);
    const auto ended = desc_.now();
    restUntil_ =
        ended + std::min<std::chrono::nanoseconds>(kRestPerScan * (ended - began), kLongestRest);
    merge(all);
}

void Catalogue::merge(const std::vector<FoundDataset>& all) {
    const std::lock_guard lock{mutex_};
    for (auto& [id, entry] : entries_) entry.present = false;
    for (const FoundDataset& found : all) {
        const auto [at, isNew] = entries_.try_emplace(found.id);
        at->second.present = true;
        at->second.signature = found.signature;
        if (!isNew) continue;
        at->second.info = listed(found.id, found.name);
        tell(at->second.info);
    }
    for (auto at = entries_.begin(); at != entries_.end();) {
        Entry& entry = at->second;
        const bool busy = entry.info.state() == v1::DATASET_STATE_IMPORTING;
        if (entry.present || entry.summary || busy) {
            ++at;
            continue;
        }
        entry.info.set_state(v1::DATASET_STATE_FAILED);
        entry.info.set_error(at->first + ": no longer in the data folder");
        tell(entry.info);
        at = entries_.erase(at);
    }
}

v1::DatasetList Catalogue::list() {
    look();
    const std::lock_guard lock{mutex_};
    v1::DatasetList all;
    for (const auto& [id, entry] : entries_) *all.add_datasets() = entry.info;
    return all;
}

void Catalogue::refresh() {
    const std::lock_guard lock{scanMutex_};
    scan();
}

Result<v1::DatasetInfo> Catalogue::open(const std::string& id) {
    look();
    const std::lock_guard lock{mutex_};
    const auto found = entries_.find(id);
    if (found == entries_.end()) {
        return fail(ErrorCode::kNotFound, "dataset \"" + id + "\" is not in the data folder",
                    "dataset");
    }
    Entry& entry = found->second;
    entry.asked = ++asks_;
    if (entry.info.state() == v1::DATASET_STATE_IMPORTING) return entry.info;
    if (!entry.present) {
        const std::string rest =
            entry.summary ? "; version " + std::to_string(entry.version) + " of it stays in use"
                          : "";
        return fail(ErrorCode::kNotFound,
                    "dataset \"" + id + "\" is no longer in the data folder" + rest, "dataset");
    }
    const bool current = entry.summary && entry.importSignature == entry.signature;
    if (!current || entry.info.state() == v1::DATASET_STATE_FAILED) startImport(entry);
    return entry.info;
}

Result<DatasetStanding> Catalogue::require(const std::string& id) {
    {
        const std::lock_guard lock{mutex_};
        const auto found = entries_.find(id);
        if (found != entries_.end()) found->second.asked = ++asks_;
    }
    const DatasetStanding now = standing(id);
    if (now.loaded) return now;
    const auto opened = open(id);
    if (!opened) return opened.error();
    return standing(id);
}

void Catalogue::startImport(Entry& entry) {
    entry.importSignature = entry.signature;
    entry.info.set_state(v1::DATASET_STATE_IMPORTING);
    entry.info.set_stage("waiting");
    entry.info.set_progress(0);
    entry.info.clear_error();
    queue_.push_back(entry.info.id());
    tell(entry.info);
    wake_.notify_one();
}

DatasetStanding Catalogue::standing(const std::string& id) const {
    const std::lock_guard lock{mutex_};
    const auto found = entries_.find(id);
    if (found == entries_.end()) return {};
    const Entry& entry = found->second;
    return {.loaded = entry.summary.has_value(),
            .failed = entry.info.state() == v1::DATASET_STATE_FAILED,
            .version = entry.version,
            .error = entry.info.error()};
}

scene::Summaries Catalogue::summaries(const std::vector<std::string>& ids) const {
    const std::lock_guard lock{mutex_};
    scene::Summaries all;
    for (const std::string& id : ids) {
        const auto found = entries_.find(id);
        if (found != entries_.end() && found->second.summary) all[id] = *found->second.summary;
    }
    return all;
}

void Catalogue::setThumbnail(const std::string& id, std::uint64_t version, std::string jpeg) {
    const std::lock_guard lock{mutex_};
    const auto found = entries_.find(id);
    if (found == entries_.end() || found->second.version != version) return;
    found->second.info.set_thumbnail(std::move(jpeg));
    tell(found->second.info);
}

bool Catalogue::hasThumbnail(const std::string& id) const {
    const std::lock_guard lock{mutex_};
    const auto found = entries_.find(id);
    return found != entries_.end() && !found->second.info.thumbnail().empty();
}

bool Catalogue::importing() const {
    const std::lock_guard lock{mutex_};
    return running_ > 0;
}

ImportCounts Catalogue::importCounts() const {
    const std::lock_guard lock{mutex_};
    ImportCounts counts = counts_;
    counts.waiting = queue_.size();
    return counts;
}

std::uint64_t Catalogue::subscribe(Listener listener) {
    const std::lock_guard lock{mutex_};
    listeners_.emplace(++lastListener_, std::move(listener));
    return lastListener_;
}

void Catalogue::unsubscribe(std::uint64_t number) {
    const std::lock_guard lock{mutex_};
    listeners_.erase(number);
}

void Catalogue::tell(const v1::DatasetInfo& info) {
    for (const auto& [number, listener] : listeners_) listener(info);
}

void Catalogue::importLoop() {
    while (true) {
        std::string id;
        {
            std::unique_lock lock{mutex_};
            wake_.wait(lock, [this] { return stopping_ || !queue_.empty(); });
            if (stopping_) return;
            id = std::move(queue_.front());
            queue_.pop_front();
            ++running_;
        }
        importOne(id);
        const std::lock_guard lock{mutex_};
        --running_;
    }
}

void Catalogue::importOne(const std::string& id) {
    const std::string path = desc_.folder.empty() ? id : desc_.folder + "/" + id;
    workers::ImportRequest request;
    request.path = path;
    auto imported = desc_.importer(
        request, desc_.imports,
        [&](const std::string& stage, double fraction) { progressed(id, stage, fraction); });
    const std::lock_guard lock{mutex_};
    Entry& entry = entries_.at(id);
    const std::uint64_t bytes = imported ? sizeOf(imported->packed) : 0;
    if (imported) {
        if (const auto room = makeRoom(entry, bytes); !room) imported = room.error();
    }
    ++(imported ? counts_.good : counts_.failed);
    if (imported) {
        spdlog::info(R"(event=imported dataset="{}" format="{}" ms={:.0f} peak_mb={:.0f})",
                     base::printable(id), imported->format, imported->ms, imported->peakMb);
        finished(entry, std::move(*imported), bytes);
    } else {
        spdlog::warn(R"(event=import_failed dataset="{}" code={} error="{}")", base::printable(id),
                     name(imported.error().code), base::printable(imported.error().message, 1000));
        entry.info.set_state(v1::DATASET_STATE_FAILED);
        entry.info.set_error(imported.error().message);
    }
    entry.info.clear_stage();
    tell(entry.info);
}

void Catalogue::progressed(const std::string& id, const std::string& stage, double fraction) {
    const std::lock_guard lock{mutex_};
    v1::DatasetInfo& info = entries_.at(id).info;
    if (info.stage() == stage && fraction - info.progress() < kProgressStep) return;
    info.set_stage(stage);
    info.set_progress(std::clamp(fraction, 0.0, 1.0));
    tell(info);
}

void Catalogue::finished(Entry& entry, workers::ImportedDataset imported, std::uint64_t bytes) {
    dataBytes_ += bytes - std::exchange(entry.bytes, bytes);
    const std::string id = entry.info.id();
    entry.info = describe(id, entry.info.name(), imported.summary, imported.warnings);
    addMoments(entry.info, imported.moments);
    *entry.info.mutable_log() = logOf(imported);
    entry.info.set_version(++entry.version);
    entry.summary = std::move(imported.summary);
    render_.addDataset(id, std::move(imported.packed));
}

Result<void> Catalogue::makeRoom(const Entry& entry, std::uint64_t bytes) {
    const auto mayGo = [&](const Entry& one) {
        return &one != &entry && one.bytes > 0 && !holds_->holds(one.info.id()) &&
               one.info.state() != v1::DATASET_STATE_IMPORTING;
    };
    const auto taken = [&] { return dataBytes_ - entry.bytes; };
    std::uint64_t staying = taken();
    for (const auto& [id, one] : entries_) staying -= mayGo(one) ? one.bytes : 0;
    while (desc_.maxDataBytes > 0 && taken() + bytes > desc_.maxDataBytes) {
        Entry* oldest = nullptr;
        for (auto& [id, one] : entries_) {
            if (mayGo(one) && (oldest == nullptr || one.asked < oldest->asked)) oldest = &one;
        }
        if (oldest == nullptr || staying + bytes > desc_.maxDataBytes) {
            return fail(ErrorCode::kLimitExceeded,
                        entry.info.id() + ": takes " + mib(bytes) + " of memory beside " +
                            mib(staying) + " of data that views show; the limit is " +
                            mib(desc_.maxDataBytes) + " (--max-data-mb)");
        }
        letGo(*oldest);
    }
    return {};
}

void Catalogue::letGo(Entry& entry) {
    const std::string id = entry.info.id();
    spdlog::info(R"(event=dataset_let_go dataset="{}" mb={})", base::printable(id),
                 entry.bytes / kMib);
    render_.removeDataset(id);
    dataBytes_ -= std::exchange(entry.bytes, 0);
    entry.summary.reset();
    if (entry.info.state() != v1::DATASET_STATE_READY) return;  // Says why it cannot be read.
    v1::DatasetInfo info = listed(id, entry.info.name());
    info.set_thumbnail(entry.info.thumbnail());
    entry.info = std::move(info);
    tell(entry.info);
}

}  // namespace volcast::session
