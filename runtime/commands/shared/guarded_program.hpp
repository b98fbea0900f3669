#pragma once

#include <functional>
#include <string>

namespace samara {

/// Runs the work of a program or command and returns its exit status: 0, or 1 after one line "PROGRAM: what
/// is wrong" on standard error for whatever the work throws, and where standard output did not take what was
/// printed. Before the work it makes sure of what the work rests on: standard streams that were closed are
/// opened, so that no file that is written gets their numbers, and a pipe without a reader or a file beyond
/// the limit of the shell is an error of the writing, which cleans up, not the end of the process. Programs
/// that are started get these signals as they were. With `as_json` what is wrong is on standard output too,
/// as {"error": "what is wrong"}, without the program's name.
int run_guarded(const std::string& program, const std::function<void()>& work, bool as_json = false);

}  // namespace samara
