#pragma once

namespace samara::test {

/// A sheet of two quads in the plane z = 0, each with a material of its own and UVs that meet in a seam, as
/// an .obj file; the second counts its corners back from the last.
inline constexpr const char* painted_obj =
    "mtllib leaf.mtl\n"
    "v -0.04 -0.01 0\nv 0 -0.01 0\nv 0.04 -0.01 0\nv -0.04 0.01 0\nv 0 0.01 0\nv 0.04 0.01 0\n"
    "vt 0 0\nvt 0.5 0\nvt 0.5 1\nvt 0 1\n"
    "vn 0 0 1\n"
    "usemtl leaf_front\nf 1/1/1 2/2/1 5/3/1 4/4/1\n"
    "vt 0.75 0.25\nvt 1 0.25\nvt 1 0.75\nvt 0.75 0.75\n"
    "usemtl stalk\nf -5/-4/-1 -4/-3/-1 -1/-2/-1 -2/-1/-1\n";
inline constexpr const char* painted_mtl =
    "newmtl leaf_front\nKd 0.1 0.6 0.2\nnewmtl stalk\nKd 0.4 0.2 0.1\nd 0.5\nnewmtl unused\nKd 1 1 1\n";

}  // namespace samara::test
