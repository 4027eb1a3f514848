#pragma once

namespace mrose {

/// The main loop of a plug-in's own process: loads what the program at the other end of the socket names, and answers
/// for it until that end is gone. Takes the socket.
void servePlugin(int socket);

}  // namespace mrose
