#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <vector>

#include "samara/core/files/hdf5_writer.hpp"
#include "samara/motion/motion.hpp"

namespace samara {

/// The number of bodies, about, in a section of a crowd's motion.
inline constexpr std::size_t bodies_in_section = 1U << 16U;

/// Writes a motion file block by block, so that memory does not grow with its length.
class MotionWriter {
  public:
    /// Writes all of `motion` but the poses. It must outlive the writer.
    MotionWriter(Hdf5Writer& file, const Motion& motion);

    /// Writes a block. It takes the fewest operations where the blocks are those of frames_in_block() and of
    /// a section's copies. Throws Error where a pose breaks a rule of read_motion_file.
    void write(const MotionBlock& block);

    /// Ends the motion after `frames` frames and so many copies of each body, where it was cut short.
    void finish(std::size_t frames, const std::vector<std::size_t>& copies);

  private:
    void write_forces(const MotionBlock& block);

    Hdf5Writer& file_;
    const Motion& motion_;
    std::vector<double> values_;  ///< of one series of a block
};

/// Returns the number of sections of a motion: a crowd is stored section by section, the copies in a section
/// for all frames, and may be simulated so, in memory that does not grow with the crowd.
std::size_t section_count(const Motion& motion);

/// Returns the copies of a body in a section of its motion.
CopySpan copies_in_section(const Motion& motion, const BodyMotion& body, std::size_t section);

/// Returns how many frames to write at once: so many that a block of all bodies and runs of a section takes
/// some 64 MB, one at least. It depends on nothing but the motion's sizes, so that equal motions give equal
/// bytes.
std::size_t frames_in_block(const Motion& motion);

/// Writes a motion file through a temporary file: `fill` writes the poses. The file stands at `path` once
/// `fill` returns; where it throws, nothing is left behind. Throws Error where the file cannot be written or
/// the disk has not the room for it, which is known before `fill` is called.
void write_motion_file(const std::filesystem::path& path, const Motion& motion_but_poses,
                       const std::function<void(MotionWriter&)>& fill);

}  // namespace samara
