#pragma once
// Ctrl-C, SIGTERM and SIGHUP stop a command, which keeps what is done.

namespace liecheck::properties {

/// The first signal sets stop_requested, the second ends the program at once. Two within 0.3 s, longer than a busy
/// machine delays one and shorter than a second thought, are one: `timeout` sends its own to the program and then to
/// the program's whole group. A signal that nohup ignores stays ignored. To be called once the robot is read, which may
/// wait for a pipe.
void stop_on_signals();

}  // namespace liecheck::properties
