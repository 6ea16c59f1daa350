#pragma once

#include <array>
#include <cstdio>
#include <filesystem>
#include <string>
#include <utility>

#include <gtest/gtest.h>

namespace volcast::test {

/// stdout and stderr of a shell's command, and its status.
inline std::pair<std::string, int> outputOf(const std::string& command) {
    FILE* pipe = ::popen((command + " 2>&1").c_str(), "r");
    std::string text;
    std::array<char, 4096> buffer{};
    while (std::fgets(buffer.data(), static_cast<int>(buffer.size()), pipe) != nullptr) {
        text += buffer.data();
    }
    return {text, ::pclose(pipe)};
}

/// cert.pem and key.pem for 127.0.0.1, signed by themselves.
inline void makeCertificate(const std::filesystem::path& folder) {
    const auto [text, status] = outputOf(
        "openssl req -x509 -newkey ec -pkeyopt ec_paramgen_curve:prime256v1 -nodes -days 1 "
        "-subj /CN=127.0.0.1 -addext subjectAltName=IP:127.0.0.1 -keyout " +
        (folder / "key.pem").string() + " -out " + (folder / "cert.pem").string());
    ASSERT_EQ(status, 0) << text;
}

}  // namespace volcast::test
