#pragma once

#include "server/net/beast.h"
#include "server/net/client_loop.h"

namespace volcast::net {

/// Puts a link of `shape` in front of `server`, a connection: bytes of both directions, pings and
/// closes among them, come after its delay, those of the server at its rate. Neither lost nor
/// reordered. It ends when both sides have, or with the context.
///
/// Returns where the client is to connect, once.
Tcp::endpoint shapeLink(Socket server, const LinkShape& shape);

/// To be set before it connects: else the kernel takes what the link has not carried yet.
void keepLittle(Socket& server, const LinkShape& shape);

}  // namespace volcast::net
