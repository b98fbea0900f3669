#pragma once

#include <filesystem>
#include <functional>

#include "samara/core/files/hdf5_writer.hpp"
#include "samara/motion/motion.hpp"

namespace samara {

/// Writes a motion file block by block, so that memory does not grow with its length.
class MotionWriter {
  public:
    /// Writes all of `motion` but the poses. It must outlive the writer.
    MotionWriter(Hdf5Writer& file, const Motion& motion);

    /// Writes poses of body number `body` at the frames from `first_frame` on, (run, frame, copy) in
    /// row-major order. It takes the fewest operations where the blocks are those of frames_in_block().
    /// Throws Error where a pose breaks a rule of read_motion_file.
    void write(std::size_t body, std::size_t first_frame, const std::vector<Pose>& poses);
    /// Writes the fluid's forces likewise, of a motion that has them.
    void write_forces(std::size_t body, std::size_t first_frame, const std::vector<FluidForces>& forces);

    /// Ends the motion after `frames` frames, where it was cut short.
    void finish(std::size_t frames);

  private:
    Hdf5Writer& file_;
    const Motion& motion_;
};

/// Returns how many frames to write at once: so many that a block of all bodies, copies and runs takes some
/// 64 MB, one at least. It depends on nothing but the motion's sizes, so that equal motions give equal bytes.
std::size_t frames_in_block(const Motion& motion);

/// Writes a motion file through a temporary file: `fill` writes the poses. The file stands at `path` once
/// `fill` returns; where it throws, nothing is left behind. Throws Error where the file cannot be written or
/// the disk has not the room for it, which is known before `fill` is called.
void write_motion_file(const std::filesystem::path& path, const Motion& motion_but_poses,
                       const std::function<void(MotionWriter&)>& fill);

}  // namespace samara
