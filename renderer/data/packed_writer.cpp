#include "renderer/data/packed_writer.h"

#include <cstring>

namespace volcast::data::packed {

namespace {

std::size_t aligned(std::size_t offset) {
    return (offset + kAlignment - 1) / kAlignment * kAlignment;
}

}  // namespace

Result<void> Writer::open(Kind kind) {
    std::size_t end = sizeof(Header) + entries_.size() * sizeof(Entry);
    for (Entry& entry : entries_) {
        entry.offset = aligned(end);
        end = entry.offset + entry.count * entry.elementBytes;
    }
    auto fd = base::createMemfd("volcast-dataset", end);
    if (!fd) return fd.error();
    auto mapping = base::map(*fd, true);
    if (!mapping) return mapping.error();
    fd_ = std::move(*fd);
    mapping_ = std::move(*mapping);
    const Header header{.kind = kind, .sections = entries_.size(), .bytes = end};
    std::memcpy(mapping_.bytes.data(), &header, sizeof(header));
    std::memcpy(mapping_.bytes.data() + sizeof(header), entries_.data(),
                entries_.size() * sizeof(Entry));
    for (std::size_t i = 0; i < entries_.size(); ++i) {
        if (contents_[i].empty()) continue;
        std::memcpy(mapping_.bytes.data() + entries_[i].offset, contents_[i].data(),
                    contents_[i].size());
    }
    return {};
}

Result<base::FileDescriptor> Writer::seal() {
    mapping_ = {};  // A writable mapping would forbid the seal.
    if (const auto sealed = base::sealReadOnly(fd_); !sealed) return sealed.error();
    return std::move(fd_);
}

}  // namespace volcast::data::packed
