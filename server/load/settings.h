#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "server/load/script.h"
#include "server/net/client_loop.h"

namespace volcast::load {

struct Group {
    Kind kind = Kind::kOrbit;
    unsigned clients = 1;
};

/// How a client answers frames; with less than kFull it also pins quality, scale, accuracy and
/// rate, so that the server's control has nothing to change.
enum class Acks {
    kFull,       ///< Each frame as it arrives: the server paces as it likes.
    kOneCredit,  ///< As a client that is always behind: one frame under way at a time.
    kNone,       ///< All that may ever come, again and again: nothing but the socket slows frames.
};

/// All of one load run.
struct LoadSettings {
    net::WsUrl url;
    std::string trustFile;  ///< PEM; empty: the system's certificates.
    std::vector<Group> groups;
    /// So many views for all clients: the first clients that move open and steer one each, the
    /// others join by its link and watch. 0: one a client.
    unsigned views = 0;
    Acks acks = Acks::kFull;
    std::optional<std::uint32_t> quality;  ///< Of JPEG, pinned; empty: the server's choice.
    double rampUpS = 1;     ///< Clients connect one after the other over so long; not measured.
    double durationS = 10;  ///< Measured, after that.
    double inputsPerSecond = 30;
    std::string dataset;  ///< Empty: the first that the server lists.
    std::uint32_t width = 512, height = 512;
    double slowBytesPerSecond = 200e3;  ///< Of "slow".
    net::LinkShape shaped{.bytesPerSecond = 1.25e6, .delay = std::chrono::milliseconds{25}};
    int serverPid = 0;  ///< Whose processes are measured; 0: nobody's.
};

}  // namespace volcast::load
