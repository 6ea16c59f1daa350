#pragma once

#include <cstdint>
#include <memory>

namespace volcast::test {

/// A way to a server on 127.0.0.1 that carries one connection, with little buffered on it: what the
/// server sends at `bytesPerS`, what the client sends at once. Ends with the object.
class SlowLink {
public:
    static std::unique_ptr<SlowLink> create(std::uint16_t serverPort, double bytesPerS);
    virtual ~SlowLink() = default;
    SlowLink(const SlowLink&) = delete;
    SlowLink& operator=(const SlowLink&) = delete;
    SlowLink(SlowLink&&) = delete;
    SlowLink& operator=(SlowLink&&) = delete;

    /// Where the client connects to.
    [[nodiscard]] virtual std::uint16_t port() const = 0;
    /// From now on as fast as the machine is.
    virtual void widen() = 0;

protected:
    SlowLink() = default;
};

}  // namespace volcast::test
