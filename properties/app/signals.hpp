#pragma once
// Ctrl-C, SIGTERM and SIGHUP stop a command, which then returns what is done.

namespace liecheck::properties {

/// The first signal sets stop_requested; the second ends the program at once. Two signals within 0.3 s count
/// as one, because `timeout` sends its signal to the program and then to its process group. A signal that
/// nohup ignores stays ignored. Call this after the robot was read, because reading may wait for a pipe.
void stop_on_signals();

}  // namespace liecheck::properties
