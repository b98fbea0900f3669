#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <vector>

#include "samara/motion/motion.hpp"

namespace samara {

class Hdf5Reader;

/// Writes a motion file (docs/file-formats) through a temporary file: equal motions give equal bytes. It
/// stands alone: it holds the bodies' surfaces, the scene's text and all that measures, pictures and exports
/// need. Throws Error where the file cannot be written or the motion breaks one of read_motion_file's rules.
void write_motion_file(const std::filesystem::path& file, const Motion& motion);

/// Reads a motion file. Throws Error, naming the file and the place in it, where the file is missing, cut
/// short, damaged, of another type or from a newer version, and where its content breaks a rule: there is a
/// frame, a body, a run and a copy; times ascend; all values are finite; all arrays agree on runs, frames and
/// copies; quaternions and axes have unit length to 1e-6; the surfaces hold triangles.
Motion read_motion_file(const std::filesystem::path& file);

/// A block of consecutive copies and runs of a body.
struct PoseBlock {
    int first_run = 0;   ///< counted from 0
    int runs = 1;        ///< number of runs
    int first_copy = 0;  ///< counted from 0
    int copies = 1;      ///< number of copies
};

/// Reads a motion file in parts, for files larger than memory. Throws like read_motion_file, each part when
/// it is read.
class MotionReader {
  public:
    /// Opens the file; throws Error where it is no sound motion file.
    explicit MotionReader(const std::filesystem::path& file);
    ~MotionReader();
    /// Moves the open file; the other reader may then only be destroyed or assigned to.
    MotionReader(MotionReader&&) noexcept;
    /// Moves the open file; the other reader may then only be destroyed or assigned to.
    MotionReader& operator=(MotionReader&&) noexcept;

    /// Returns the motion without its poses.
    [[nodiscard]] const Motion& motion() const { return motion_; }
    /// Reads the poses of a block at all frames, (run, frame, copy) in row-major order.
    [[nodiscard]] std::vector<Pose> poses(std::size_t body, const PoseBlock& block) const;
    /// Reads the fluid's forces of a block likewise; none where the motion has none.
    [[nodiscard]] std::vector<FluidForces> forces(std::size_t body, const PoseBlock& block) const;
    /// Calls `use` for all copies and runs of a body, some 64 MB at a time: with a motion that holds them as
    /// its one body, without the scene's text, and with their place in the whole.
    void for_each_block(std::size_t body,
                        const std::function<void(const Motion& part, const PoseBlock& block)>& use) const;

  private:
    std::unique_ptr<const Hdf5Reader> file_;
    Motion motion_;
};

/// Returns whether the file is an HDF5 file that holds a motion; false also where it cannot be read.
bool is_motion_file(const std::filesystem::path& file);

}  // namespace samara
