#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "renderer/scene/scene.h"
#include "server/session/dataset_hold.h"
#include "server/session/folder_scan.h"
#include "server/workers/import_service.h"
#include "server/workers/render_service.h"
#include "volcast/v1/session.pb.h"

namespace volcast::session {

/// Runs one import to its end; workers::runImport.
using Importer = std::function<Result<workers::ImportedDataset>(
    const workers::ImportRequest&, const workers::ImportSettings&,
    const std::function<void(const std::string& stage, double fraction)>&)>;

/// Lists what the data folder holds; scanFolder.
using Scanner = std::function<std::vector<FoundDataset>(const std::string& folder,
                                                        const base::FileDescriptor& root)>;

struct CatalogueDesc {
    std::string folder;  ///< Empty: the built-in demo datasets.
    Scanner scanner = scanFolder;
    std::function<std::chrono::steady_clock::time_point()> now = std::chrono::steady_clock::now;
    workers::ImportSettings imports;
    unsigned importsAtOnce = 1;
    std::uint64_t maxDataBytes = 0;  ///< Of all imported data together; 0: no limit.
    Importer importer = workers::runImport;
};

struct ImportCounts {
    std::uint64_t good = 0, failed = 0;  ///< Since the start.
    std::size_t waiting = 0;             ///< That no thread has begun.
};

/// What a view has to know of one dataset.
struct DatasetStanding {
    bool loaded = false;        ///< Can be drawn now.
    bool failed = false;        ///< Its latest import failed.
    std::uint64_t version = 0;  ///< Of what is loaded; 0: nothing.
    std::string error;          ///< Where `failed`.
};

/// The datasets of one folder: listed cheaply, imported on demand on threads of its own, given to
/// the render service when ready. What was loaded stays usable whatever happens to its file, until
/// other data needs its memory: where an import passes `maxDataBytes`, loaded datasets that nobody
/// holds are let go, beginning with the one that was not asked for the longest. Such a one is
/// listed as it was before its import, and imported again when it is asked for.
///
/// All methods may be called from any thread. Names are looked up in the list, never in the file
/// system, so they cannot lead out of the folder.
///
/// A look into the folder is followed by a rest of ten times its length, a second at most, in
/// which the list is taken as it is: whoever asks for what was put there asks again then. While
/// somebody looks, only those wait who want to look as well.
class Catalogue {
public:
    using Listener = std::function<void(const v1::DatasetInfo&)>;

    /// `render` must outlive the catalogue.
    ///
    /// Errors: kNotFound, kInvalidArgument, kIo for a folder that cannot be listed.
    static Result<std::unique_ptr<Catalogue>> create(CatalogueDesc desc,
                                                     workers::RenderService& render);
    Catalogue(const Catalogue&) = delete;
    Catalogue& operator=(const Catalogue&) = delete;
    Catalogue(Catalogue&&) = delete;
    Catalogue& operator=(Catalogue&&) = delete;
    /// Waits for imports that run; those that wait are dropped.
    ~Catalogue();

    /// All datasets; looks into the folder first where the rest is over.
    v1::DatasetList list();

    /// Looks into the folder now, and tells everybody what is new in it.
    void refresh();

    /// Starts an import where the dataset was never read, failed before, or changed on disk; looks
    /// into the folder first where the rest is over.
    ///
    /// Errors: kNotFound (no such dataset, or its file vanished; what is loaded stays).
    Result<v1::DatasetInfo> open(const std::string& id);

    /// As open(), but content with what is loaded, be it of an older file.
    Result<DatasetStanding> require(const std::string& id);

    /// Keeps `ids`, known or not, from being let go; to be had before it is asked whether they are
    /// loaded.
    [[nodiscard]] DatasetHold hold(std::vector<std::string> ids) const {
        return {holds_, std::move(ids)};
    }
    [[nodiscard]] DatasetStanding standing(const std::string& id) const;
    /// Summaries of those of `ids` that are loaded.
    [[nodiscard]] scene::Summaries summaries(const std::vector<std::string>& ids) const;
    /// Tells everybody, if that version is still the one that is loaded.
    void setThumbnail(const std::string& id, std::uint64_t version, std::string jpeg);
    [[nodiscard]] bool hasThumbnail(const std::string& id) const;
    [[nodiscard]] bool importing() const;
    [[nodiscard]] ImportCounts importCounts() const;

    /// `listener` hears of every change, under a lock: it must not call back. Returns its number.
    std::uint64_t subscribe(Listener listener);
    void unsubscribe(std::uint64_t number);

private:
    struct Entry {
        v1::DatasetInfo info;
        std::uint64_t signature = 0;        ///< Of the files as they are now.
        std::uint64_t importSignature = 0;  ///< Of the files when the latest import began.
        bool present = true;                ///< Still in the folder.
        std::optional<data::DatasetSummary> summary;  ///< Of what is loaded.
        std::uint64_t version = 0;
        std::uint64_t bytes = 0;  ///< Of what is loaded.
        std::uint64_t asked = 0;  ///< When it was asked for last, counted by `asks_`.
    };

    Catalogue(CatalogueDesc desc, workers::RenderService& render, base::FileDescriptor root);
    /// Looks into the folder where the rest is over; without mutex_.
    void look();
    void scan();
    void merge(const std::vector<FoundDataset>& all);
    void startImport(Entry& entry);
    void importLoop();
    void importOne(const std::string& id);
    void progressed(const std::string& id, const std::string& stage, double fraction);
    void finished(Entry& entry, workers::ImportedDataset imported, std::uint64_t bytes);
    /// Errors: kLimitExceeded where so much more than `entry` holds now is too much.
    Result<void> makeRoom(const Entry& entry, std::uint64_t bytes);
    void letGo(Entry& entry);
    void tell(const v1::DatasetInfo& info);

    const CatalogueDesc desc_;
    workers::RenderService& render_;
    const base::FileDescriptor root_;
    std::mutex scanMutex_;  ///< Held while the folder is looked into; locked before mutex_.
    std::chrono::steady_clock::time_point restUntil_{};  ///< Guarded by scanMutex_.
    mutable std::mutex mutex_;
    std::condition_variable wake_;
    std::map<std::string, Entry> entries_;
    const std::shared_ptr<DatasetHolds> holds_ = std::make_shared<DatasetHolds>();
    std::uint64_t dataBytes_ = 0;  ///< Of all entries.
    std::uint64_t asks_ = 0;
    std::map<std::uint64_t, Listener> listeners_;
    std::uint64_t lastListener_ = 0;
    std::deque<std::string> queue_;
    unsigned running_ = 0;
    ImportCounts counts_;
    bool stopping_ = false;
    std::vector<std::thread> threads_;
};

}  // namespace volcast::session
