#include "meshes/reading/three_mf_file.hpp"

#include <algorithm>
#include <array>
#include <memory>
#include <string>

#include <Model/COM/NMR_DLLInterfaces.h>
#include <fmt/format.h>

#include "samara/core/base/error.hpp"
#include "samara/core/surface/stl_file.hpp"

namespace samara {
namespace {

struct Release {
    void operator()(NMR::PLib3MFBase* object) const { NMR::lib3mf_release(object); }
};
using Object = std::unique_ptr<NMR::PLib3MFBase, Release>;

// By the number of lib3mf's eModelUnit: micrometre, millimetre, centimetre, inch, foot, metre.
constexpr std::array<double, 6> metres = {1e-6, 1e-3, 1e-2, 0.0254, 0.3048, 1.0};

class Reader {
  public:
    explicit Reader(std::string label) : label_(std::move(label)) {
        NMR::PLib3MFModel* model = nullptr;
        require(NMR::lib3mf_createmodel(&model), nullptr);
        model_.reset(model);
    }

    void read(const std::string& file) {
        NMR::PLib3MFModelReader* reader = nullptr;
        require(NMR::lib3mf_model_queryreader(model_.get(), "3mf", &reader), model_.get());
        const Object held(reader);
        require(NMR::lib3mf_reader_readfromfileutf8(reader, file.c_str()), reader);
    }

    [[nodiscard]] double unit() const {
        DWORD number = 0;
        require(NMR::lib3mf_model_getunit(model_.get(), &number), model_.get());
        return metres.at(std::min<std::size_t>(number, metres.size() - 1));
    }

    // All that is built, placed: lib3mf does so itself where it writes an STL file.
    [[nodiscard]] std::string built() const {
        NMR::PLib3MFModelWriter* writer = nullptr;
        require(NMR::lib3mf_model_querywriter(model_.get(), "stl", &writer), model_.get());
        const Object held(writer);
        ULONG64 size = 0;
        require(NMR::lib3mf_writer_getstreamsize(writer, &size), writer);
        std::string bytes(size, '\0');
        require(NMR::lib3mf_writer_writetobuffer(writer, reinterpret_cast<BYTE*>(bytes.data()), size),
                writer);
        return bytes;
    }

  private:
    void require(LIB3MFRESULT result, NMR::PLib3MFBase* object) const {
        if (result == 0) return;
        DWORD code = 0;
        LPCSTR reason = nullptr;
        if (object != nullptr) NMR::lib3mf_getlasterror(object, &code, &reason);
        throw Error(fmt::format("{}: is no sound 3MF file: {}; export it again, or as .stl", label_,
                                reason == nullptr ? "lib3mf cannot read it" : reason));
    }

    std::string label_;
    Object model_;
};

}  // namespace

Surface read_3mf_file(const std::filesystem::path& file) {
    Reader reader(file.string());
    reader.read(file.string());
    Surface surface = read_stl(reader.built(), file.string());
    if (surface.corners.empty()) {
        throw Error(
            fmt::format("{}: builds no object with triangles; export the model again", file.string()));
    }
    const double unit = reader.unit();
    for (Vector3d& vertex : surface.vertices) vertex *= unit;
    return surface;
}

}  // namespace samara
