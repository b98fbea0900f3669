#pragma once

namespace samara {

// Each function is one command of the program samara: argv[0] is the command's name. Returns the exit status.

/// Runs samara kirchhoff: the added mass of a body or shape.
int kirchhoff_command(int argc, const char* const* argv);

/// Runs samara mass: the mass of a body where a scene gives none.
int mass_command(int argc, const char* const* argv);

/// Runs samara recommend: the models of a body where a scene gives none.
int recommend_command(int argc, const char* const* argv);

/// Runs samara simulate: a scene's motion.
int simulate_command(int argc, const char* const* argv);

/// Runs samara search: the seeds and launches with which a body reaches its goals.
int search_command(int argc, const char* const* argv);

/// Runs samara bodies: the ready-baked bodies.
int bodies_command(int argc, const char* const* argv);

/// Runs samara export: a motion for other tools.
int export_command(int argc, const char* const* argv);

/// Runs samara plot: a picture of a motion.
int plot_command(int argc, const char* const* argv);

/// Runs samara compare: a motion compared with a reference.
int compare_command(int argc, const char* const* argv);

/// Runs samara info: the content of a file.
int info_command(int argc, const char* const* argv);

/// Runs samara report: the verdict on a bake, as a page; without its cases, which samara-report reads.
int report_command(int argc, const char* const* argv);

/// Runs samara check: whether a file from elsewhere is sound.
int check_command(int argc, const char* const* argv);

}  // namespace samara
