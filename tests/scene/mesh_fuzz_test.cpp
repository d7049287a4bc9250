// SPDX-License-Identifier: MIT
// Changes small mesh files at random and reads them. Whatever the bytes are, a reader returns a valid scene
// or throws Error, and its memory is bounded by the file's size. A crash leaves the file in the temporary
// folder.
//
// METAMARCH_FUZZ_SECONDS=60 goes on for a minute with each format; METAMARCH_FUZZ_SEED=7 makes other files.
#include "metamarch/error/error.h"
#include "scene/counted_memory.h"
#include "scene/mesh_file.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <cstdlib>
#include <random>

namespace metamarch {
namespace {

// A small file costs some memory before a reader sees it. A file of "3 0 1 2" and the like has two bytes for
// a number, and a scene has less than a hundred for each corner of a triangle.
constexpr std::size_t kFreeBytes = 1 << 20;
constexpr std::size_t kBytesOfByte = 200;

const std::string kXyz = "property float x\nproperty float y\nproperty float z\n";
const std::string kFaces = "element face 2\nproperty list uchar int vertex_indices\n";
const std::string kSquare = "0 0 0\n1 0 0\n1 1 0\n0 1 0\n";

std::string binaryPly() {
    BinaryText body(std::endian::little);
    body.add<float>({0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0});
    body.add<std::uint8_t>({4})
        .add<std::int32_t>({0, 1, 2, 3})
        .add<std::uint8_t>({3})
        .add<std::int32_t>({0, 1, 2});
    body.add<std::uint32_t>({4, 0, 1, 3, 2});
    return "ply\nformat binary_little_endian 1.0\nelement vertex 4\n" + kXyz + kFaces +
           "element tristrips 1\nproperty list uint int vertex_indices\nend_header\n" + body.text();
}

std::string bigEndianPly() {
    BinaryText body(std::endian::big);
    body.add<std::uint16_t>({2}).add<std::int8_t>({1, 2});
    for (const double coordinate : {0.0, 1.0, 2.0, 3.0}) {
        body.add<double>({coordinate, coordinate * coordinate, 1.0}).add<std::uint8_t>({255, 0, 9, 8});
    }
    body.add<std::int8_t>({4}).add<std::uint8_t>({0, 1, 2, 3}).add<std::uint8_t>({8});
    body.add<float>({0, 0, 1, 0, 1, 1, 0, 1}).add<std::int32_t>({0});
    return "ply\nformat binary_big_endian 1.0\ncomment TextureFile t.png\nelement other 1\n"
           "property list ushort char a\nelement vertex 4\nproperty double x\nproperty double y\n"
           "property double z\nproperty uchar red\nproperty uchar green\nproperty uchar blue\n"
           "property uchar alpha\nelement face 1\nproperty list char uchar vertex_index\n"
           "property list uchar float texcoord\nproperty int texnumber\nend_header\n" +
           body.text();
}

std::string binaryOff() {
    BinaryText body(std::endian::big);
    body.add<std::int32_t>({4, 1, 0}).add<float>({0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0});
    body.add<std::int32_t>({4, 0, 1, 2, 3, 3}).add<float>({1, 0, 0});
    return "OFF BINARY\n" + body.text();
}

std::string binaryStl() {
    BinaryText body(std::endian::little);
    body.add<std::uint32_t>({2});
    for (const std::uint16_t attribute : std::initializer_list<std::uint16_t>{0x8123, 0}) {
        body.add<float>({0, 0, 1, 0, 0, 0, 1, 0, 0, 1, 1, 0}).add<std::uint16_t>({attribute});
    }
    return "solid COLOR=abcd" + std::string(64, ' ') + body.text();
}

// Reads the library that is changed.
const std::string kObjOfMtl =
    "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nusemtl m\nf 1/1 "
    "2/2 3/3\nusemtl n\nf 1/1 2/2 3/3\n";

struct Format {
    std::string ending;
    std::vector<std::string> files; // small ones, which together have everything that the reader knows
};

// To fuzz another reader: its ending, and files.
std::vector<Format> formats() {
    return {
        {".ply",
         {"ply\nformat ascii 1.0\ncomment a\nelement vertex 4\n" + kXyz + kFaces + "end_header\n" + kSquare +
              "4 0 1 2 3\n3 0 1 2\n",
          "ply\r\nformat ascii 1.0\r\nelement vertex 4\r\nproperty float x\r\nproperty float y\r\n"
          "property float z\r\nproperty float nx\r\nproperty float ny\r\nproperty float nz\r\n"
          "property float s\r\nproperty float t\r\nelement tristrips 1\r\n"
          "property list int int vertex_indices\r\nend_header\r\n0 0 0 0 0 1 0 0\r\n1 0 0 0 0 1 0 1\r\n"
          "1 1 0 0 0 1 1 1\r\n0 1 0 0 0 1 1 0\r\n8 0 1 2 -1 3 2 1 0\r\n",
          "ply\nformat ascii 1.0\nobj_info num_cols 2\nobj_info num_rows 2\nelement vertex 4\n" + kXyz +
              "element range_grid 4\nproperty list uchar int vertex_indices\nend_header\n" + kSquare +
              "1 0\n1 1\n1 3\n1 2\n",
          "ply\nformat ascii 1.0\nelement vertex 4\n" + kXyz +
              "element face 1\nproperty list uchar int vertex_indices\nproperty float red\nproperty float "
              "green\n"
              "property float blue\nend_header\n" +
              kSquare + "4 0 1 2 3 0.5 1 0\n",
          binaryPly(), bigEndianPly()}},
        {".off",
         {"OFF\n# a\n4 2 0\n" + kSquare + "4 0 1 2 3\n3 0 1 2 255 0 0\n",
          "STCN4OFF 4 1 0\n0 0 0 1 0 0 1 255 0 0 255 0 0\n1 0 0 1 0 0 1 255 0 0 255 0 1\n"
          "1 1 0 1 0 0 1 255 0 0 255 1 1\n0 1 0 1 0 0 1 255 0 0 9 1 0\n4 0 1 2 3\n",
          "nOFF 3\n4 1 0 0 0 0 1 0 0 1 1 0 0 1 0 4 0 1 2 3", binaryOff()}},
        {".stl",
         {"solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 1 1 "
          "0\nendloop\nendfacet\n"
          "endsolid a\nsolid b\nfacet normal 0 0 1 outer loop vertex 0 0 0 vertex 1 1 0 vertex 0 1 0 vertex "
          "0 0 1 "
          "endloop endfacet\nendsolid\n",
          binaryStl()}},
        {".obj",
         {"# a\nmtllib a.mtl\no a\nv 0 0 0\nv 1 0 0 1\nv 1 1 0 0.5 0.5 0\nv 0 1 0 1 1 1 0.5\nv .5 .5 .0\nvt "
          "0 0\n"
          "vt 1 0 0\nvn 0 0 1\ng b c\nusemtl m # n\ns 1\nf 1/1/1 2/2/1 3/1/1 4/2/1\nf 1//1 5//1 2//1 3//1 "
          "4//1\n"
          "usemtl n\nf -5 -4 -3 -2 \\\n-1\nf 1/1 2/2 3/1\nl 1 2\np 1\nvp 0 1\ncurv 0 1 1 2\n",
          "v 0 0 0\rv 4 0 0\rv 4 4 0\rv 2 2 0\rv 0 4 0\rv 2 2 0\rf 1 2 3 4 5 6\rf 1 3 5 2 4\rf 1 2 3 4 5 "
          "4\r"}},
        {".mtl",
         {"# a\nnewmtl m\nKa 1 1 1\nKd 0.5 0.5 0.5\nKs 0.5\nNs 10\nKe 0 0 1\nd 0.5\nillum 2\nmap_Kd -s 2 2 1 "
          "-o "
          "0.5 -clamp on t.png\nmap_d -imfchan g t.png\nbump -bm 0.5 t.png\nnewmtl n\nTr 0.5\nNi 1.5\nillum "
          "7\n"
          "norm t.png\n",
          "# Meshlab\r\nnewmtl m\r\nTr 1\r\nPr 0.5\r\nPm 1\r\nPs 0.5\r\nPc 1\r\nPcr 0.1\r\naniso "
          "0.5\r\nanisor "
          "0.5\r\nmap_Pr -mm 0 0.5 t.png\r\nmap_Pm .\\t.png\r\nmap_Ps t.png\r\nmap_Pc t.png\r\nmap_Bump "
          "-imfchan l "
          "t.png\r\nnewmtl n\r\nKd spectral a 1\r\nmap_Ke -blendu off -t 1 1 1 \"t.png\"\r\nmap_Ks t.png # "
          "a\r\n"}},
    };
}

class Mutator {
  public:
    Mutator(const std::vector<std::string>& files, std::uint64_t seed) : files_(files), random_(seed) {}

    std::string next() {
        std::string text = files_[below(files_.size())];
        for (std::size_t changes = 1 + below(4); changes > 0; --changes) {
            change(text);
        }
        return text.empty() ? " " : text;
    }

  private:
    void change(std::string& text) {
        const std::size_t at = below(text.size() + 1);
        const std::size_t length = below(std::min<std::size_t>(text.size() - at, 40) + 1);
        switch (below(8)) {
        case 0:
            if (at < text.size()) {
                text[at] = static_cast<char>(text[at] ^ (1 << below(8)));
            }
            break;
        case 1:
            text.insert(at, 1, static_cast<char>(below(256)));
            break;
        case 2:
            text.erase(at, length);
            break;
        case 3:
            text.insert(at, text.substr(below(text.size() + 1), length));
            break;
        case 4:
            text.resize(at);
            break;
        case 5: {
            const std::string& other = files_[below(files_.size())];
            text = text.substr(0, at) + other.substr(below(other.size()));
            break;
        }
        case 6:
            text.replace(at, length, strangeWord());
            break;
        default:
            replaceNumber(text, at);
            break;
        }
    }

    // Replaces the digits behind `at`.
    void replaceNumber(std::string& text, std::size_t at) {
        constexpr const char* kDigits = "0123456789";
        const std::size_t begin = text.find_first_of(kDigits, at);
        if (begin != std::string::npos) {
            const std::size_t end = std::min(text.find_first_not_of(kDigits, begin), text.size());
            text.replace(begin, end - begin, strangeWord());
        }
    }

    std::string strangeWord() {
        static const std::vector<std::string> kWords = {"0",
                                                        "-1",
                                                        "1",
                                                        "2",
                                                        "3",
                                                        "4",
                                                        "5",
                                                        "7",
                                                        "255",
                                                        "256",
                                                        "65536",
                                                        "2147483647",
                                                        "2147483648",
                                                        "4294967295",
                                                        "4294967296",
                                                        "9223372036854775807",
                                                        "18446744073709551615",
                                                        "1e9",
                                                        "1e400",
                                                        "-1e400",
                                                        "1e-400",
                                                        "nan",
                                                        "-inf",
                                                        "0.5",
                                                        ".",
                                                        "1.5",
                                                        "char",
                                                        "uchar",
                                                        "ushort",
                                                        "int",
                                                        "uint",
                                                        "float",
                                                        "double",
                                                        "list",
                                                        "vertex",
                                                        "face",
                                                        "vertex_indices",
                                                        "x",
                                                        "red",
                                                        "texcoord",
                                                        "property list uchar int a\n",
                                                        "property char a\n",
                                                        "comment ",
                                                        "obj_info ",
                                                        "element face 1000\n",
                                                        "element e 9\n",
                                                        "#",
                                                        "\n",
                                                        "\r",
                                                        "\\\n",
                                                        "f ",
                                                        "usemtl m",
                                                        "newmtl m\n",
                                                        "-s ",
                                                        "-",
                                                        "/",
                                                        "solid ",
                                                        "endsolid ",
                                                        "facet ",
                                                        "BINARY",
                                                        std::string(4, '\0'),
                                                        std::string(4, '\xff')};
        return kWords[below(kWords.size())];
    }

    std::size_t below(std::size_t count) { return static_cast<std::size_t>(random_() % count); }

    const std::vector<std::string>& files_;
    std::mt19937_64 random_;
};

bool isFinite(const glm::vec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

void expectValid(const Scene& scene) {
    EXPECT_TRUE(std::ranges::all_of(scene.positions, isFinite));
    EXPECT_FALSE(scene.triangles.empty());
    EXPECT_EQ(scene.normals.size(), scene.positions.size());
    EXPECT_EQ(scene.texCoords.size(), scene.positions.size());
    EXPECT_TRUE(scene.colors.empty() || scene.colors.size() == scene.positions.size());
    EXPECT_EQ(scene.triangleMaterial.size(), scene.triangles.size());
    for (const glm::uvec3& triangle : scene.triangles) {
        EXPECT_LT(std::max({triangle.x, triangle.y, triangle.z}), scene.positions.size());
    }
    for (const std::uint32_t material : scene.triangleMaterial) {
        EXPECT_TRUE(material == kNoMaterial || material < scene.materials.size());
    }
}

std::uint64_t environment(const char* name, std::uint64_t otherwise) {
    const char* value = std::getenv(name);
    return value == nullptr ? otherwise : std::strtoull(value, nullptr, 10);
}

class MeshFuzz : public testing::TestWithParam<Format> {};

TEST_P(MeshFuzz, ReturnsAValidSceneOrThrowsAnError) {
    constexpr std::uint64_t kFilesOfAShortRun = 1500;
    const auto seconds = std::chrono::seconds(environment("METAMARCH_FUZZ_SECONDS", 0));
    const auto begin = std::chrono::steady_clock::now();
    const TemporaryFolder folder;
    const std::filesystem::path path = folder / ("a" + GetParam().ending);
    writeFile(folder / "a.obj", kObjOfMtl);
    writeFile(folder / "a.mtl", "newmtl m\nmap_Kd t.png\n");
    const std::filesystem::path read = GetParam().ending == ".mtl" ? folder / "a.obj" : path;
    Mutator mutator(GetParam().files, environment("METAMARCH_FUZZ_SEED", 1));
    std::uint64_t tried = 0;
    std::uint64_t accepted = 0;
    while (tried < kFilesOfAShortRun || std::chrono::steady_clock::now() - begin < seconds) {
        const std::string content = mutator.next();
        writeFile(path, content);
        const std::size_t before = bytesInUse();
        watchMemory();
        try {
            expectValid(loadScene(read, {.allowMissingTextures = true}));
            ++accepted;
        } catch (const Error& error) {
            EXPECT_EQ(error.kind, ErrorKind::inputRefused) << error.what();
            EXPECT_LT(std::string(error.what()).size(), 500u);
        }
        EXPECT_LT(mostBytesInUse() - before, kFreeBytes + kBytesOfByte * content.size());
        ++tried;
        ASSERT_FALSE(HasFailure()) << "file " << tried << ":\n" << testing::PrintToString(content);
    }
    std::cout << GetParam().ending << ": " << tried << " files, " << accepted << " accepted\n";
    EXPECT_GT(accepted, tried / 100); // else the changes are so wild that they test only the refusals
}

INSTANTIATE_TEST_SUITE_P(Formats, MeshFuzz, testing::ValuesIn(formats()),
                         [](const auto& format) { return format.param.ending.substr(1); });

} // namespace
} // namespace metamarch
