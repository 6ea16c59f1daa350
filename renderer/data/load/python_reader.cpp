#include "renderer/data/load/python_reader.h"

#include <array>
#include <charconv>
#include <cmath>
#include <cstring>
#include <optional>
#include <utility>

#include "renderer/base/seccomp_filter.h"
#include "renderer/data/load/mixed_mesh.h"
#include "renderer/data/load/reader_process.h"
#include "renderer/data/load/reader_sources.h"
#include "renderer/data/load/record_stream.h"

namespace volcast::data::load {

namespace {

constexpr std::size_t kMaxWarnings = 100;
constexpr std::size_t kMaxTextShown = 2000;

Error nonsense(const std::string& what) {
    return fail(ErrorCode::kInvalidArgument, "its reader sent nonsense (" + what + ")");
}

std::vector<std::string> splitAt(const std::string& text, char separator) {
    std::vector<std::string> parts(1);
    for (const char c : text) {
        if (c == separator) {
            parts.emplace_back();
        } else {
            parts.back() += c;
        }
    }
    return parts;
}

template <class T>
std::optional<T> parsed(const std::string& text) {
    T value{};
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
    return value;
}

/// Collects records into what they describe.
class Collector {
public:
    Collector(RecordStream& stream, const Progress& progress)
        : stream_{stream}, progress_{progress} {}

    /// True after the last record.
    Result<bool> take(const Record& record) {
        switch (record.kind) {
            case RecordKind::kProgress: return more(progress(record));
            case RecordKind::kWarning:
                if (warnings_.size() < kMaxWarnings) {
                    warnings_.push_back(record.text.substr(0, kMaxTextShown));
                }
                return more(skip(record));
            case RecordKind::kRefused: return refused(record);
            case RecordKind::kFormat:
                format_ = record.text.substr(0, 100);
                return more(skip(record));
            case RecordKind::kPoints: return more(points(record));
            case RecordKind::kCells: return more(cells(record));
            case RecordKind::kField: return more(field(record));
            case RecordKind::kGrid: return more(grid(record));
            case RecordKind::kChannel: return more(channel(record));
            case RecordKind::kEnd: return true;
        }
        return nonsense("kind");
    }

    Result<Loaded> finish() {
        Loaded loaded{.format = format_, .warnings = std::move(warnings_)};
        if (volume_) {
            if (channels_ != volume_->channels()) return nonsense("number of channels");
            loaded.input = std::move(*volume_);
            return loaded;
        }
        auto mesh = splitCells(std::move(mesh_));
        if (!mesh) return mesh.error();
        loaded.input = std::move(*mesh);
        return loaded;
    }

private:
    static Result<bool> more(const Result<void>& done) {
        if (!done) return done.error();
        return false;
    }

    Result<void> skip(const Record& record) {
        auto ignored = stream_.values<char>(record);
        if (!ignored) return ignored.error();
        return {};
    }

    Result<void> progress(const Record& record) {
        auto fraction = stream_.values<double>(record);
        if (!fraction) return fraction.error();
        if (fraction->size() != 1) return nonsense("progress");
        progress_(record.text.substr(0, 100), fraction->front());
        return {};
    }

    Error refused(const Record& record) {
        auto code = stream_.values<std::int32_t>(record);
        const bool known = code && code->size() == 1 && code->front() >= 0 &&
                           code->front() <= static_cast<int>(ErrorCode::kLimitExceeded);
        return fail(known ? static_cast<ErrorCode>(code->front()) : ErrorCode::kInvalidArgument,
                    record.text.substr(0, kMaxTextShown));
    }

    Result<void> points(const Record& record) {
        static_assert(sizeof(glm::dvec3) == 3 * sizeof(double));
        auto values = stream_.values<glm::dvec3>(record);
        if (!values) return values.error();
        mesh_.points = std::move(*values);
        return {};
    }

    Result<void> cells(const Record& record) {
        const auto kind = cellKind(record.text);
        if (!kind) return nonsense("cell kind");
        auto values = stream_.values<std::int64_t>(record);
        if (!values) return values.error();
        mesh_.blocks.push_back({.kind = *kind, .vertices = std::move(*values)});
        return {};
    }

    Result<void> field(const Record& record) {
        const std::vector<std::string> parts = splitAt(record.text, '\x1f');
        if (parts.size() != 5) return nonsense("field");
        const auto step = parsed<std::size_t>(parts[3]);
        const auto time = parsed<double>(parts[4]);
        if (!step || !time) return nonsense("field step");
        auto values = stream_.values<double>(record);
        if (!values) return values.error();
        const Association where = parts[2] == "cell"        ? Association::kCell
                                  : parts[2] == "cellpoint" ? Association::kCellVertex
                                                            : Association::kVertex;
        FieldInput& target = fieldOf(parts[0], parts[1], where);
        if (target.steps.size() != *step) {
            return fail(ErrorCode::kInvalidArgument, "field \"" + parts[0] +
                                                         "\": does not have values at every time "
                                                         "step, or occurs twice");
        }
        target.steps.push_back(std::move(*values));
        target.times.push_back(*time);
        return {};
    }

    FieldInput& fieldOf(const std::string& name, const std::string& unit, Association where) {
        for (FieldInput& known : mesh_.fields) {
            if (known.name == name && known.association == where) return known;
        }
        return mesh_.fields.emplace_back(
            FieldInput{.name = name, .unit = unit, .association = where});
    }

    Result<void> grid(const Record& record) {
        auto n = stream_.values<double>(record);
        if (!n) return n.error();
        if (n->size() != 18) return nonsense("grid");
        // The voxels' type, and the name of each channel that comes.
        const std::vector<std::string> parts = splitAt(record.text, '\x1f');
        VolumeInput volume;
        for (std::size_t i = 1; i < parts.size(); ++i)
            volume.channels.push_back({.name = parts[i]});
        for (int i = 0; i < 3; ++i) {
            const double size = n->at(i);
            if (!(size >= 1 && size <= kMaxVolumeSide) || size != std::floor(size)) {
                return fail(ErrorCode::kLimitExceeded,
                            "has " + std::to_string(size) + " voxels along an axis; 1 to " +
                                std::to_string(kMaxVolumeSide) + " can be drawn");
            }
            volume.size[i] = static_cast<int>(size);
            volume.spacing[i] = n->at(3 + i);
            volume.origin[i] = n->at(6 + i);
            for (int row = 0; row < 3; ++row) volume.direction[i][row] = n->at(9 + 3 * row + i);
        }
        const std::array<std::pair<const char*, VoxelType>, 4> kinds{{{"u8", VoxelType::kU8},
                                                                      {"u16", VoxelType::kU16},
                                                                      {"i16", VoxelType::kI16},
                                                                      {"f32", VoxelType::kF32}}};
        for (const auto& [name, type] : kinds) {
            if (parts.front() == name) {
                volume.type = type;
                return startVolume(std::move(volume));
            }
        }
        return nonsense("voxel type");
    }

    Result<void> startVolume(VolumeInput volume) {
        if (volume_) return nonsense("grid");
        auto packer = VolumePacker::create(std::move(volume));
        if (!packer) return packer.error();
        volume_ = std::move(*packer);
        return {};
    }

    /// Its bytes go where they will stay.
    Result<void> channel(const Record& record) {
        if (!volume_ || channels_ == volume_->channels()) return nonsense("channel");
        const std::span<std::byte> voxels = volume_->voxels(channels_);
        if (record.dataBytes != voxels.size()) {
            return fail(ErrorCode::kInvalidArgument, "channel '" + volume_->name(channels_) +
                                                         "': " + std::to_string(record.dataBytes) +
                                                         " bytes, expected " +
                                                         std::to_string(voxels.size()));
        }
        ++channels_;
        return stream_.read(voxels.data(), voxels.size());
    }

    RecordStream& stream_;
    const Progress& progress_;
    std::string format_;
    std::vector<std::string> warnings_;
    MixedMesh mesh_;
    std::optional<VolumePacker> volume_;
    std::size_t channels_ = 0;  ///< That have come.
};

std::string programOf(const Format& format) {
    std::string program = sources::kReaderCommon;
    switch (format.family) {
        case Family::kVtk: program += sources::kVtkImport; break;
        case Family::kGrid: program += sources::kGridImport; break;
        default: program += format.name == "XDMF" ? sources::kXdmfImport : sources::kGmshImport;
    }
    return program + "\nrun(read)\n";
}

/// What a reader that ended without a word most likely met.
Error deathOf(const std::string& end) {
    if (end.find("bad_alloc") != std::string::npos) {
        return fail(ErrorCode::kLimitExceeded, "needs more memory than the import may use");
    }
    return fail(ErrorCode::kInvalidArgument,
                "its reader failed" + (end.empty() ? std::string{} : " (" + end + ")"));
}

}  // namespace

Result<Loaded> readWithPython(const Format& format, const Request& request,
                              const Progress& progress) {
    const auto named = [&](Error error) {
        error.message = request.path + ": " + error.message;
        return error;
    };
    auto process = ReaderProcess::start(programOf(format), request.path);
    if (!process) return process.error();
    auto closed = base::applySeccomp({.mayExecute = false});
    if (!closed) return closed.error();
    RecordStream stream{process->records(), request.maxMemoryBytes};
    Collector collector{stream, progress};
    for (;;) {
        const auto record = stream.next();
        const Result<bool> done = record ? collector.take(*record) : record.error();
        if (!done) {
            const bool stopped = stream.ended();
            const std::string end = process->finish();
            return named(stopped ? deathOf(end) : done.error());
        }
        if (*done) break;
    }
    process->finish();
    auto loaded = collector.finish();
    if (!loaded) return named(loaded.error());
    return loaded;
}

}  // namespace volcast::data::load
