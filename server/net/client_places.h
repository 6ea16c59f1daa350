#pragma once

#include <map>
#include <optional>
#include <string>

#include <boost/asio/ip/address.hpp>

namespace volcast::net {

/// Who has the places that there are for WebSockets. One address has a share of them; in IPv6 what
/// has its first 64 bits in common is one, as a single machine often has all of those. This machine
/// itself is exempt, for the sake of a proxy on it.
class ClientPlaces {
public:
    using Address = boost::asio::ip::address;

    /// `perAddress` 0: as many as there are.
    ClientPlaces(unsigned all, unsigned perAddress) : all_{all}, perAddress_{perAddress} {}

    /// Takes a place for `peer`; where there is none, why not, naming the limit.
    std::optional<std::string> take(const Address& peer);
    /// Gives back one that it took.
    void giveBack(const Address& peer);
    [[nodiscard]] unsigned taken() const noexcept { return taken_; }

private:
    unsigned all_, perAddress_;
    unsigned taken_ = 0;
    std::map<Address, unsigned> takenBy_;  ///< Without those that are exempt.
};

}  // namespace volcast::net
