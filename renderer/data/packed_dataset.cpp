#include "renderer/data/packed_dataset.h"

#include <cstring>
#include <span>

#include "renderer/base/memfd.h"
#include "renderer/data/packed_checks.h"
#include "renderer/data/packed_format.h"
#include "renderer/data/packed_writer.h"

namespace volcast::data {

namespace {

Result<base::FileDescriptor> finish(packed::Writer& writer, packed::Kind kind) {
    if (const auto opened = writer.open(kind); !opened) return opened.error();
    return writer.seal();
}

Result<base::FileDescriptor> packMesh(const Mesh& mesh) {
    packed::Writer writer;
    const packed::MeshHeader header{.origin = mesh.origin,
                                    .cellsWithoutVolume = mesh.cellsWithoutVolume,
                                    .cellsInverted = mesh.cellsInverted,
                                    .cellsDoubled = mesh.cellsDoubled,
                                    .facesNotManifold = mesh.facesNotManifold,
                                    .fields = mesh.fields.size(),
                                    .convex = mesh.convex ? 1U : 0U};
    writer.addOne(packed::Tag::kMesh, header);
    writer.add(packed::Tag::kVertices, mesh.vertices.span());
    writer.add(packed::Tag::kCells, mesh.cells.span());
    writer.add(packed::Tag::kNeighbours, mesh.neighbours.span());
    writer.add(packed::Tag::kBoundaryFaces, mesh.boundaryFaces.span());
    writer.add(packed::Tag::kBoundaryNeighbours, mesh.boundaryNeighbours.span());
    std::vector<packed::FieldHeader> headers;
    headers.reserve(mesh.fields.size());  // The writer keeps views of the elements.
    for (const Field& field : mesh.fields) {
        headers.push_back({.range = field.range,
                           .association = static_cast<std::uint32_t>(field.association),
                           .steps = field.steps.size(),
                           .cellsWithoutValue = field.cellsWithoutValue});
        writer.addOne(packed::Tag::kField, headers.back());
        writer.addText(field.name);
        writer.addText(field.unit);
        writer.add(packed::Tag::kTimes, std::span<const double>{field.times});
        for (const auto& step : field.steps) writer.add(packed::Tag::kValues, step.span());
    }
    return finish(writer, packed::Kind::kMesh);
}

Result<base::FileDescriptor> packVolume(const Volume& volume) {
    packed::Writer writer;
    const packed::VolumeHeader header{
        .spacing = volume.spacing,
        .origin = volume.origin,
        .direction = volume.direction,
        .size = volume.size,
        .type = static_cast<std::uint32_t>(volume.type),
        .channels = volume.channels.size(),
        .coarserLevels = static_cast<std::uint64_t>(volume.coarserLevels())};
    writer.addOne(packed::Tag::kVolume, header);
    std::vector<packed::ChannelHeader> headers;  // The writer refers to them.
    headers.reserve(volume.channels.size());
    for (const Channel& channel : volume.channels) {
        headers.push_back(
            {.range = channel.range, .voxelsWithoutValue = channel.voxelsWithoutValue});
        writer.addOne(packed::Tag::kChannel, headers.back());
        writer.addText(channel.name);
        writer.addText(channel.unit);
        writer.add(packed::Tag::kVoxels, channel.voxels.span());
        writer.add(packed::Tag::kBricks, channel.bricks.span());
        for (const ChannelLevel& level : channel.coarser) {
            writer.add(packed::Tag::kVoxels, level.voxels.span());
            writer.add(packed::Tag::kBricks, level.bricks.span());
        }
    }
    return finish(writer, packed::Kind::kVolume);
}

Error damaged(const std::string& what) {
    return fail(ErrorCode::kInvalidArgument, "packed dataset: " + what);
}

/// Hands out the sections of a mapped dataset in the order they were written in.
class Reader {
public:
    explicit Reader(base::Mapping mapping) : mapping_{std::move(mapping)} {}

    /// Checks the header and the table; every section lies inside the mapping afterwards.
    Result<packed::Kind> open() {
        packed::Header header;
        if (mapping_.bytes.size() < sizeof(header)) return damaged("shorter than its header");
        std::memcpy(&header, mapping_.bytes.data(), sizeof(header));
        if (header.magic != packed::kMagic) return damaged("wrong magic or version");
        if (header.bytes != mapping_.bytes.size()) return damaged("size differs from the header's");
        const std::size_t room = (mapping_.bytes.size() - sizeof(header)) / sizeof(packed::Entry);
        if (header.sections > room) return damaged("table of sections is cut off");
        entries_.resize(header.sections);
        if (!entries_.empty()) {
            std::memcpy(entries_.data(), mapping_.bytes.data() + sizeof(header),
                        entries_.size() * sizeof(packed::Entry));
        }
        for (const packed::Entry& entry : entries_) {
            const std::size_t size = mapping_.bytes.size();
            if (entry.elementBytes == 0 || entry.offset > size ||
                entry.offset % packed::kAlignment != 0 ||
                entry.count > (size - entry.offset) / entry.elementBytes) {
                return damaged("a section lies outside the data");
            }
        }
        return header.kind;
    }

    template <class T>
    Result<base::Array<T>> take(packed::Tag tag) {
        if (next_ == entries_.size()) return damaged("a section is missing");
        const packed::Entry& entry = entries_[next_++];
        if (entry.tag != tag || entry.elementBytes != sizeof(T)) {
            return damaged("section " + std::to_string(next_ - 1) + " is of another kind");
        }
        // Offsets are multiples of kAlignment and the mapping starts on a page.
        const auto* first = reinterpret_cast<const T*>(mapping_.bytes.data() + entry.offset);
        return base::Array<T>{mapping_.owner, {first, entry.count}};
    }

    template <class T>
    Result<T> takeOne(packed::Tag tag) {
        const auto array = take<T>(tag);
        if (!array) return array.error();
        if (array->size() != 1) return damaged("a header is missing or doubled");
        return (*array)[0];
    }

    Result<std::string> takeText() {
        const auto text = take<char>(packed::Tag::kText);
        if (!text) return text.error();
        return std::string{text->begin(), text->end()};
    }

    [[nodiscard]] Result<void> finish() const {
        if (next_ != entries_.size()) return damaged("has sections nobody asked for");
        return {};
    }

private:
    base::Mapping mapping_;
    std::vector<packed::Entry> entries_;
    std::size_t next_ = 0;
};

/// Stores the value of `source` in `target`; false where it is an error, kept in `error`.
template <class T>
bool store(Result<T> source, T& target, Error& error) {
    if (!source) {
        error = source.error();
        return false;
    }
    target = std::move(*source);
    return true;
}

Result<Field> readField(Reader& reader) {
    Field field;
    Error error;
    packed::FieldHeader header;
    base::Array<double> times;
    if (!store(reader.takeOne<packed::FieldHeader>(packed::Tag::kField), header, error) ||
        !store(reader.takeText(), field.name, error) ||
        !store(reader.takeText(), field.unit, error) ||
        !store(reader.take<double>(packed::Tag::kTimes), times, error)) {
        return error;
    }
    if (header.association > static_cast<std::uint32_t>(Association::kCellVertex)) {
        return damaged("field '" + field.name + "' sits nowhere");
    }
    field.association = static_cast<Association>(header.association);
    field.range = header.range;
    field.cellsWithoutValue = header.cellsWithoutValue;
    field.times.assign(times.begin(), times.end());
    for (std::uint64_t step = 0; step < header.steps; ++step) {
        auto values = reader.take<float>(packed::Tag::kValues);
        if (!values) return values.error();
        field.steps.push_back(std::move(*values));
    }
    return field;
}

Result<Dataset> readMesh(Reader& reader) {
    Mesh mesh;
    Error error;
    packed::MeshHeader header;
    if (!store(reader.takeOne<packed::MeshHeader>(packed::Tag::kMesh), header, error) ||
        !store(reader.take<glm::vec3>(packed::Tag::kVertices), mesh.vertices, error) ||
        !store(reader.take<glm::ivec4>(packed::Tag::kCells), mesh.cells, error) ||
        !store(reader.take<glm::ivec4>(packed::Tag::kNeighbours), mesh.neighbours, error) ||
        !store(reader.take<BoundaryFace>(packed::Tag::kBoundaryFaces), mesh.boundaryFaces, error) ||
        !store(reader.take<glm::ivec3>(packed::Tag::kBoundaryNeighbours), mesh.boundaryNeighbours,
               error)) {
        return error;
    }
    mesh.origin = header.origin;
    mesh.convex = header.convex != 0;
    mesh.cellsWithoutVolume = header.cellsWithoutVolume;
    mesh.cellsInverted = header.cellsInverted;
    mesh.cellsDoubled = header.cellsDoubled;
    mesh.facesNotManifold = header.facesNotManifold;
    for (std::uint64_t i = 0; i < header.fields; ++i) {
        auto field = readField(reader);
        if (!field) return field.error();
        mesh.fields.push_back(std::move(*field));
    }
    if (const auto checked = packed::check(mesh); !checked) return checked.error();
    return Dataset{std::move(mesh)};
}

Result<Dataset> readVolume(Reader& reader, Trust trust) {
    const auto header = reader.takeOne<packed::VolumeHeader>(packed::Tag::kVolume);
    if (!header) return header.error();
    if (header->type > static_cast<std::uint32_t>(VoxelType::kF32)) {
        return damaged("unknown voxel type");
    }
    Volume volume{.size = header->size,
                  .spacing = header->spacing,
                  .origin = header->origin,
                  .direction = header->direction,
                  .type = static_cast<VoxelType>(header->type),
                  .channels = {}};
    for (std::uint64_t i = 0; i < header->channels; ++i) {
        Channel channel;
        Error error;
        packed::ChannelHeader channelHeader;
        if (!store(reader.takeOne<packed::ChannelHeader>(packed::Tag::kChannel), channelHeader,
                   error) ||
            !store(reader.takeText(), channel.name, error) ||
            !store(reader.takeText(), channel.unit, error) ||
            !store(reader.take<std::byte>(packed::Tag::kVoxels), channel.voxels, error) ||
            !store(reader.take<glm::vec2>(packed::Tag::kBricks), channel.bricks, error)) {
            return error;
        }
        channel.range = channelHeader.range;
        channel.voxelsWithoutValue = channelHeader.voxelsWithoutValue;
        for (std::uint64_t level = 0; level < header->coarserLevels; ++level) {
            ChannelLevel& coarser = channel.coarser.emplace_back();
            if (!store(reader.take<std::byte>(packed::Tag::kVoxels), coarser.voxels, error) ||
                !store(reader.take<glm::vec2>(packed::Tag::kBricks), coarser.bricks, error)) {
                return error;
            }
        }
        volume.channels.push_back(std::move(channel));
    }
    if (const auto checked = packed::check(volume, trust); !checked) return checked.error();
    return Dataset{std::move(volume)};
}

}  // namespace

Result<base::FileDescriptor> pack(const Dataset& dataset) {
    if (const Mesh* mesh = std::get_if<Mesh>(&dataset)) return packMesh(*mesh);
    return packVolume(std::get<Volume>(dataset));
}

Result<Dataset> unpack(const base::FileDescriptor& fd, Trust trust) {
    if (!base::isSealedReadOnly(fd)) {
        return damaged("can still be written to, so checks of it mean nothing");
    }
    auto mapping = base::map(fd, false);
    if (!mapping) return mapping.error();
    Reader reader{std::move(*mapping)};
    const auto kind = reader.open();
    if (!kind) return kind.error();
    if (*kind != packed::Kind::kMesh && *kind != packed::Kind::kVolume) {
        return damaged("is neither a mesh nor a volume");
    }
    auto dataset = *kind == packed::Kind::kMesh ? readMesh(reader) : readVolume(reader, trust);
    if (!dataset) return dataset;
    if (const auto finished = reader.finish(); !finished) return finished.error();
    return dataset;
}

}  // namespace volcast::data
