#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "renderer/base/memfd.h"
#include "renderer/base/result.h"
#include "renderer/data/packed_format.h"

namespace volcast::data::packed {

/// Writes a packed dataset: first every section is named, in order, then there is room for all of
/// them in a memfd, then they are filled and it is sealed.
class Writer {
public:
    /// A section of `values`, which must outlive open().
    template <class T>
    std::size_t add(Tag tag, std::span<const T> values) {
        const std::size_t section = reserve<T>(tag, values.size());
        contents_[section] = std::as_bytes(values);
        return section;
    }
    template <class T>
    std::size_t addOne(Tag tag, const T& value) {
        return add(tag, std::span<const T>{&value, 1});
    }
    std::size_t addText(const std::string& text) {
        return add(Tag::kText, std::span<const char>{text.data(), text.size()});
    }
    /// A section that is filled after open().
    template <class T>
    std::size_t reserve(Tag tag, std::size_t count) {
        entries_.push_back({.tag = tag, .elementBytes = sizeof(T), .offset = 0, .count = count});
        contents_.emplace_back();
        return entries_.size() - 1;
    }

    /// Makes the file and fills what was added.
    ///
    /// Errors: kIo (no memory).
    Result<void> open(Kind kind);
    /// A section of the open file; zero until it is filled.
    template <class T>
    [[nodiscard]] std::span<T> section(std::size_t i) const {
        // Offsets are multiples of kAlignment and the mapping starts on a page.
        return {reinterpret_cast<T*>(mapping_.bytes.data() + entries_[i].offset),
                entries_[i].count};
    }
    /// Seals the file against every change; sections are gone.
    ///
    /// Errors: kIo.
    Result<base::FileDescriptor> seal();

private:
    std::vector<Entry> entries_;
    std::vector<std::span<const std::byte>> contents_;
    base::FileDescriptor fd_;
    base::Mapping mapping_;
};

}  // namespace volcast::data::packed
