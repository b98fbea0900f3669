#pragma once

#include <string>

namespace samara::test {

/// A sheet of two quads in the plane z = 0, each with a material of its own and UVs that share a seam, as an
/// .obj file; the second counts its corners back from the last.
inline constexpr const char* painted_obj =
    "mtllib leaf.mtl\n"
    "v -0.04 -0.01 0\nv 0 -0.01 0\nv 0.04 -0.01 0\nv -0.04 0.01 0\nv 0 0.01 0\nv 0.04 0.01 0\n"
    "vt 0 0\nvt 0.5 0\nvt 0.5 1\nvt 0 1\n"
    "vn 0 0 1\n"
    "usemtl leaf_front\nf 1/1/1 2/2/1 5/3/1 4/4/1\n"
    "vt 0.75 0.25\nvt 1 0.25\nvt 1 0.75\nvt 0.75 0.75\n"
    "usemtl stalk\nf -5/-4/-1 -4/-3/-1 -1/-2/-1 -2/-1/-1\n";
inline constexpr const char* painted_mtl =
    "newmtl leaf_front\nKd 0.1 0.6 0.2\nmap_Kd -s 1 1 1 C:\\pictures\\leaf.png\nmap_d leaf.png\nnewmtl "
    "stalk\nKd 0.4 0.2 0.1\nd 0.5\nnewmtl unused\nKd 1 1 1\n";
/// Returns the image of painted_obj: one green pixel.
inline std::string painted_png() {
    constexpr unsigned char bytes[] = {0x89, 0x50, 0x4e, 0x47, 0x0d, 0x0a, 0x1a, 0x0a, 0x00, 0x00, 0x00, 0x0d,
                                       0x49, 0x48, 0x44, 0x52, 0x00, 0x00, 0x00, 0x01, 0x00, 0x00, 0x00, 0x01,
                                       0x08, 0x06, 0x00, 0x00, 0x00, 0x1f, 0x15, 0xc4, 0x89, 0x00, 0x00, 0x00,
                                       0x0d, 0x49, 0x44, 0x41, 0x54, 0x78, 0xda, 0x63, 0x50, 0x58, 0x60, 0xf0,
                                       0x1f, 0x00, 0x03, 0xc4, 0x01, 0xf0, 0xcb, 0x83, 0xd1, 0x82, 0x00, 0x00,
                                       0x00, 0x00, 0x49, 0x45, 0x4e, 0x44, 0xae, 0x42, 0x60, 0x82};
    return {reinterpret_cast<const char*>(bytes), sizeof bytes};
}

}  // namespace samara::test
