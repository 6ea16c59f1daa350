#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <utility>
#include <vector>

namespace volcast::base {

/// An immutable array that keeps what backs it (a vector, a mapped file) alive; cheap to copy.
template <class T>
class Array {
public:
    Array() = default;
    /// Takes over `values`.
    Array(std::vector<T> values) {  // NOLINT(google-explicit-constructor): a vector is an array
        auto owned = std::make_shared<const std::vector<T>>(std::move(values));
        view_ = *owned;
        owner_ = std::move(owned);
    }
    /// Views memory that `owner` keeps alive.
    Array(std::shared_ptr<const void> owner, std::span<const T> view)
        : owner_{std::move(owner)}, view_{view} {}

    [[nodiscard]] std::size_t size() const noexcept { return view_.size(); }
    [[nodiscard]] bool empty() const noexcept { return view_.empty(); }
    [[nodiscard]] const T* data() const noexcept { return view_.data(); }
    [[nodiscard]] const T& operator[](std::size_t i) const noexcept { return view_[i]; }
    [[nodiscard]] auto begin() const noexcept { return view_.begin(); }
    [[nodiscard]] auto end() const noexcept { return view_.end(); }
    [[nodiscard]] std::span<const T> span() const noexcept { return view_; }
    [[nodiscard]] std::span<const std::byte> bytes() const noexcept { return std::as_bytes(view_); }

private:
    std::shared_ptr<const void> owner_;
    std::span<const T> view_;
};

}  // namespace volcast::base
