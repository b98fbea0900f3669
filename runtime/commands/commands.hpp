#pragma once

namespace samara {

// Each is one command of the program samara: argv[0] is the command's name. Returns the exit status.
int export_command(int argc, const char* const* argv);
int plot_command(int argc, const char* const* argv);

}  // namespace samara
