#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace volcast::protocol {

/// One row of protocol/vectors/vectors.json.
struct VectorCase {
    std::string name;
    std::string kind;  ///< "client", "server", "frame" or "invalid_frame".
    std::string hex;   ///< The bytes of one WebSocket message.
    std::string json;  ///< What they mean (protocol/README.md, "Test vectors").
};

/// All rows, made by this build from the meanings in vector_cases.cpp.
std::vector<VectorCase> makeVectors();

/// The rows as the file holds them, one a line.
std::string vectorsFile(const std::vector<VectorCase>& cases);

std::vector<std::byte> bytesFromHex(const std::string& hex);

}  // namespace volcast::protocol
