#pragma once

#include <memory>

#include "gtest/gtest.h"

#include "renderer/gpu/device.h"

namespace volcast::support {

/// A test with a GL device: surfaceless, so Mesa's software rasteriser where there is no GPU.
///
/// One device serves all tests of a program: opening one costs 20 to 150 ms.
class GlTest : public ::testing::Test {
protected:
    static gpu::Device& device() {
        static const std::unique_ptr<gpu::Device> kDevice = open();
        return *kDevice;
    }

    void TearDown() override {
        const Result<void> clean = device().check("the test");
        EXPECT_TRUE(clean.has_value()) << clean.error().message;
    }

private:
    static std::unique_ptr<gpu::Device> open() {
        Result<std::unique_ptr<gpu::Device>> device = gpu::Device::create();
        if (!device) {
            ADD_FAILURE() << "no device: " << device.error().message;
            std::abort();
        }
        return std::move(*device);
    }
};

/// The value of `result`; a failed result ends the test program with its message.
template <class T>
T must(Result<T> result) {
    if (!result) {
        ADD_FAILURE() << result.error().message;
        std::abort();
    }
    return std::move(*result);
}

inline void must(const Result<void>& result) {
    if (result) return;
    ADD_FAILURE() << result.error().message;
    std::abort();
}

}  // namespace volcast::support
