#include "server/net/client_places.h"

#include <algorithm>

namespace volcast::net {

namespace {

namespace ip = boost::asio::ip;

/// What is counted as one address; nullopt for this machine.
std::optional<ip::address> counted(const ip::address& peer) {
    if (peer.is_v4()) {
        return peer.is_loopback() ? std::nullopt : std::optional{peer};
    }
    const ip::address_v6 v6 = peer.to_v6();
    if (v6.is_v4_mapped()) return counted(ip::make_address_v4(ip::v4_mapped, v6));
    if (v6.is_loopback()) return std::nullopt;
    auto bytes = v6.to_bytes();
    std::fill(bytes.begin() + 8, bytes.end(), 0);
    return ip::address_v6{bytes};
}

}  // namespace

std::optional<std::string> ClientPlaces::take(const Address& peer) {
    if (taken_ >= all_) {
        return "this server has " + std::to_string(all_) +
               " clients, the most that it takes (--max-clients); try again later";
    }
    if (const auto address = counted(peer); address && perAddress_ > 0) {
        unsigned& own = takenBy_[*address];
        if (own >= perAddress_) {
            return "your address has " + std::to_string(perAddress_) +
                   " clients here, the most that one address may have "
                   "(--max-clients-per-address)";
        }
        ++own;
    }
    ++taken_;
    return std::nullopt;
}

void ClientPlaces::giveBack(const Address& peer) {
    --taken_;
    const auto address = counted(peer);
    const auto own = address ? takenBy_.find(*address) : takenBy_.end();
    if (own != takenBy_.end() && --own->second == 0) takenBy_.erase(own);
}

}  // namespace volcast::net
