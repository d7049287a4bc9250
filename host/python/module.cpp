// SPDX-License-Identifier: MIT
// The extension module metamarch._native: what the Python files in metamarch/ call. It turns errors into
// exceptions, lends arrays to NumPy, and renders without Python's lock.
#include "metamarch/cli/scene_report.h"
#include "metamarch/cli/version.h"
#include "metamarch/error/error.h"
#include "metamarch/geometry/triangle_mesh.h"
#include "metamarch/image/comparison.h"
#include "metamarch/image/image_file.h"
#include "metamarch/python/film.h"
#include "metamarch/python/tracer.h"
#include "metamarch/render/picture.h"
#include "metamarch/vulkan/refusal.h"

#include <nlohmann/json.hpp>
#include <tbb/task_arena.h>

#include <array>
#include <cfenv>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <future>
#include <limits>
#include <new>
#include <optional>
#include <pthread.h>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <system_error>
#include <unistd.h>
#include <utility>

namespace py = pybind11;

namespace metamarch::python {
namespace {

// Indexed by ErrorKind. They live as long as the process.
std::array<PyObject*, 6> errorTypes;

PyObject* makeErrorType(const char* const name, const char* const doc, PyObject* const base,
                        PyObject* const builtin) {
    const py::tuple bases = builtin == nullptr ? py::tuple(py::make_tuple(py::handle(base)))
                                               : py::make_tuple(py::handle(base), py::handle(builtin));
    PyObject* const type = PyErr_NewExceptionWithDoc(name, doc, bases.ptr(), nullptr);
    if (type == nullptr) {
        throw py::error_already_set();
    }
    return type;
}

void addErrors(py::module_& module) {
    PyObject* const error =
        makeErrorType("metamarch.Error", "What metamarch refuses, in one line.", PyExc_Exception, nullptr);
    const auto add = [&](const ErrorKind kind, const char* const name, const char* const doc,
                         PyObject* const builtin) {
        const std::string full = std::string("metamarch.") + name;
        PyObject* const type = makeErrorType(full.c_str(), doc, error, builtin);
        errorTypes[static_cast<std::size_t>(kind)] = type;
        module.attr(name) = py::handle(type);
    };
    module.attr("Error") = py::handle(error);
    add(ErrorKind::invalidArgument, "InvalidArgument",
        "A value is out of range, or values exclude each other.", PyExc_ValueError);
    add(ErrorKind::inputRefused, "InputRefused", "A file cannot be read, or its content is wrong.",
        PyExc_ValueError);
    add(ErrorKind::noDevice, "NoDevice", "There is no usable Vulkan device, or the device was lost.",
        PyExc_RuntimeError);
    add(ErrorKind::outputNotWritable, "OutputNotWritable", "A file cannot be written.", PyExc_OSError);
    add(ErrorKind::outOfMemory, "OutOfMemory", "Memory ran out, or a limit was exceeded.", PyExc_MemoryError);
    add(ErrorKind::mismatch, "Mismatch", "Two results that should agree do not.", PyExc_AssertionError);
}

void raise(const Error& error) {
    std::string line = error.what();
    std::string names;
    for (const std::string& setting : error.settings) {
        names += (names.empty() ? "" : ", ") + spelled(setting);
    }
    if (!names.empty()) {
        line += " (" + names + ")";
    }
    // A message may quote bytes that are no UTF-8.
    const py::object text = py::reinterpret_steal<py::object>(
        PyUnicode_DecodeUTF8(line.data(), static_cast<Py_ssize_t>(line.size()), "replace"));
    PyErr_SetObject(errorTypes[static_cast<std::size_t>(error.kind)], text.ptr());
}

// NOLINTNEXTLINE(performance-unnecessary-value-param): pybind11 calls a function that takes a value.
void translate(const std::exception_ptr failure) {
    if (!failure) {
        return;
    }
    try {
        std::rethrow_exception(failure);
    } catch (const Error& error) {
        raise(error);
    } catch (const std::bad_alloc&) {
        raise(Error(ErrorKind::outOfMemory, "out of memory"));
    } catch (const std::system_error& error) {
        if (const std::optional<Error> refusal = vulkan::refusalOf(error, "Vulkan")) {
            raise(*refusal);
        }
        if (error.code() != std::errc::resource_unavailable_try_again) {
            throw;
        }
        raise(Error(ErrorKind::outOfMemory, "the system allows no more threads (see `ulimit -u`)"));
    }
}

// Calls `work` while other threads of Python run, and computes as IEEE 754 says. Libraries that are compiled
// with -ffast-math switch small numbers off in the thread that loads them, and programs choose how numbers
// are rounded; pictures do not depend on that.
template <class Work>
auto withoutPython(const Work& work) {
    const py::gil_scoped_release release;
    struct Floats {
        Floats() {
            std::fegetenv(&found);
            std::fesetenv(FE_DFL_ENV);
        }
        ~Floats() { std::fesetenv(&found); }
        std::fenv_t found{};
    };
    const Floats floats;
    // TBB computes as the thread did that made the arena.
    return tbb::task_arena().execute(work);
}

// Runs `work` in a thread of its own, because only Python's main thread hears of Ctrl-C. Then `work` is asked
// to end early, and its result is dropped.
template <class Work>
auto interruptible(const Work& work) {
    std::atomic<bool> isStopped = false;
    auto result = std::async(std::launch::async, [&] {
        std::fesetenv(FE_DFL_ENV); // the thread has the environment of the one that starts it
        return work(isStopped);
    });
    {
        const py::gil_scoped_release release;
        while (result.wait_for(std::chrono::milliseconds(50)) != std::future_status::ready) {
            const py::gil_scoped_acquire acquire;
            if (!isStopped && PyErr_CheckSignals() != 0) {
                isStopped = true;
            }
        }
    }
    if (isStopped) {
        throw py::error_already_set(); // what the signal's handler has raised
    }
    return result.get();
}

template <class T>
void seal(py::array_t<T>& array) {
    py::detail::array_proxy(array.ptr())->flags &= ~py::detail::npy_api::NPY_ARRAY_WRITEABLE_;
}

// An array of `rows` rows over memory that `owner` keeps.
template <class T, class Element>
py::array_t<T> lend(const std::vector<Element>& elements, const py::handle owner) {
    // NOLINTNEXTLINE(bugprone-sizeof-expression): an element may be one T.
    constexpr auto kColumns = static_cast<py::ssize_t>(sizeof(Element) / sizeof(T));
    const auto rows = static_cast<py::ssize_t>(elements.size());
    std::vector<py::ssize_t> shape = {rows};
    if (kColumns > 1) {
        shape.push_back(kColumns);
    }
    const auto* const first = reinterpret_cast<const T*>(elements.data());
    py::array_t<T> array(shape, first, owner);
    seal(array);
    return array;
}

// Channels [first, first + count) of interleaved pixels: height x width, and x count if there are several or
// if `isGroup`.
template <class T>
py::array_t<T> lendChannels(const Image& image, const std::vector<T>& values, const std::size_t channels,
                            const std::size_t first, const std::size_t count, const bool isGroup,
                            const py::handle owner) {
    const auto size = static_cast<py::ssize_t>(sizeof(T));
    const auto pixel = static_cast<py::ssize_t>(channels) * size;
    std::vector<py::ssize_t> shape = {image.height, image.width};
    std::vector<py::ssize_t> strides = {image.width * pixel, pixel};
    if (isGroup) {
        shape.push_back(static_cast<py::ssize_t>(count));
        strides.push_back(size);
    }
    py::array_t<T> array(shape, strides, values.data() + first, owner);
    seal(array);
    return array;
}

// noisy.R is of the group noisy, and noisy.direct.R is not.
bool isOfGroup(const std::string& channel, const std::string& group) {
    return group.empty() ? channel == "R" || channel == "G" || channel == "B"
                         : channel.starts_with(group + ".") && channel.rfind('.') == group.size();
}

// Returns where the channels of a group begin, and how many follow each other there.
std::pair<std::size_t, std::size_t> findGroup(const std::vector<std::string>& names,
                                              const std::string& group) {
    std::size_t first = 0;
    while (first < names.size() && !isOfGroup(names[first], group)) {
        ++first;
    }
    std::size_t end = first;
    while (end < names.size() && isOfGroup(names[end], group)) {
        ++end;
    }
    return {first, end - first};
}

// The channel of this name; otherwise those that have this name before their last dot; for "" R, G and B.
// None if there is none.
py::object channelsOf(const std::shared_ptr<Film>& film, const std::string& name) {
    const Image& image = film->image();
    const py::object owner = py::cast(film);
    if (const auto found = image.findChannel(name)) {
        return lendChannels(image, image.pixels, image.channels.size(), *found, 1, false, owner);
    }
    if (const auto found = image.findIdChannel(name)) {
        return lendChannels(image, image.ids, image.idChannels.size(), *found, 1, false, owner);
    }
    if (const auto [first, count] = findGroup(image.channels, name); count > 0) {
        return lendChannels(image, image.pixels, image.channels.size(), first, count, true, owner);
    }
    if (const auto [first, count] = findGroup(image.idChannels, name); count > 0) {
        return lendChannels(image, image.ids, image.idChannels.size(), first, count, true, owner);
    }
    return py::none();
}

py::array_t<float> rowsOf(const glm::mat4& matrix) {
    py::array_t<float> rows({4, 4});
    for (int row = 0; row < 4; ++row) {
        for (int column = 0; column < 4; ++column) {
            rows.mutable_at(row, column) = matrix[column][row];
        }
    }
    return rows;
}

using Rows = py::array_t<float, py::array::c_style | py::array::forcecast>;

std::vector<RayQuery> raysOf(const Rows& origins, const Rows& directions, const float tMin,
                             const float tMax) {
    if (origins.ndim() != 2 || origins.shape(1) != 3 || directions.ndim() != 2 || directions.shape(1) != 3 ||
        origins.shape(0) != directions.shape(0)) {
        throw Error(ErrorKind::invalidArgument, "give origins and directions as two arrays of N x 3");
    }
    if (!(tMin >= 0.0f) || std::isnan(tMax)) {
        throw Error(ErrorKind::invalidArgument, "give t_min of at least 0 and a t_max");
    }
    std::vector<RayQuery> rays(static_cast<std::size_t>(origins.shape(0)));
    const auto point = [](const float* const v) { return glm::vec3(v[0], v[1], v[2]); };
    const auto isFinite = [](const glm::vec3 v) {
        return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
    };
    for (std::size_t i = 0; i < rays.size(); ++i) {
        rays[i] = {point(origins.data() + 3 * i), tMin, point(directions.data() + 3 * i),
                   std::min(tMax, kFarthest)};
        if (!isFinite(rays[i].origin) || !isFinite(rays[i].dir) || rays[i].dir == glm::vec3(0.0f)) {
            throw Error(ErrorKind::invalidArgument,
                        "ray " + std::to_string(i) + " has no finite origin or no direction");
        }
    }
    return rays;
}

template <class T>
py::array_t<T> ownedArray(std::vector<py::ssize_t> shape, const void* const values) {
    return py::array_t<T>(std::move(shape), static_cast<const T*>(values));
}

// An image of float channels, row by row from the top.
Image imageOfArray(const Rows& array, std::vector<std::string> channels) {
    Image image(static_cast<int>(array.shape(1)), static_cast<int>(array.shape(0)), std::move(channels));
    std::copy_n(array.data(), image.pixels.size(), image.pixels.begin());
    return image;
}

py::dict dictOf(const ChannelComparison& channel) {
    using namespace py::literals;
    return py::dict("name"_a = channel.name, "judged"_a = channel.judged, "rmse"_a = channel.rmse,
                    "relative_mse"_a = channel.relativeMse, "mean_difference"_a = channel.meanDifference,
                    "max_difference"_a = channel.maxDifference,
                    "worst"_a = py::make_tuple(channel.worstX, channel.worstY), "worst_a"_a = channel.worstA,
                    "worst_b"_a = channel.worstB, "failing_pixels"_a = channel.failingPixels);
}

py::dict compare(const Image& a, const Image& b, const double maxAbs, const double maxFailPercent) {
    using namespace py::literals;
    if (!(maxAbs >= 0.0) || !(maxFailPercent >= 0.0)) {
        throw Error(ErrorKind::invalidArgument, "give bounds of 0 or more", {"maxAbs", "maxFailPercent"});
    }
    const Comparison comparison = withoutPython([&] {
        return compareImages(a, b, {maxAbs, maxFailPercent});
    });
    py::list channels;
    for (const ChannelComparison& channel : comparison.channels) {
        channels.append(dictOf(channel));
    }
    return py::dict("passed"_a = comparison.passed, "mismatches"_a = comparison.mismatches,
                    "pixels"_a = comparison.pixels, "failing_pixels"_a = comparison.failingPixels,
                    "failing_percent"_a = comparison.failingPercent, "channels"_a = channels);
}

const char* kindName(const Setting& setting) {
    return setting.kind() == Setting::Kind::flag   ? "flag"
           : setting.kind() == Setting::Kind::list ? "list"
                                                   : "value";
}

// The declared settings that a call takes.
py::list optionsOf(const Call call) {
    using namespace py::literals;
    const Choice choice;
    py::list options;
    for (const std::string& name : settingsOf(call)) {
        const Setting& setting = choice.settings.at(name);
        options.append(py::dict("name"_a = name, "kind"_a = kindName(setting), "help"_a = setting.help(),
                                "group"_a = setting.group(), "value_name"_a = setting.valueName(),
                                "default"_a = setting.defaultText(), "choices"_a = setting.choices()));
    }
    return options;
}

void addScene(py::module_& module) {
    using Pointer = std::shared_ptr<LoadedScene>;
    py::class_<LoadedScene, Pointer> scene(module, "Scene");
    scene.def(py::init([](const std::string& path, Words words) {
                  return withoutPython([&] { return std::make_shared<LoadedScene>(path, std::move(words)); });
              }),
              py::arg("path"), py::arg("words"));
    scene.def(py::init([](const std::string& name, const py::bytes& glb, Words words) {
                  const std::string_view view(glb);
                  std::vector<unsigned char> bytes(view.begin(), view.end());
                  return withoutPython([&] {
                      return std::make_shared<LoadedScene>(name, std::move(bytes), std::move(words));
                  });
              }),
              py::arg("name"), py::arg("glb"), py::arg("words"));
    scene.def("contents", [](const LoadedScene& self) {
        return cli::reportContents(self.scene())
            .dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
    });
    scene.def("meshes", [](const LoadedScene& self) {
        py::list meshes;
        for (const MeshInstance& mesh : self.scene().meshes) {
            meshes.append(py::make_tuple(mesh.name, mesh.mesh, mesh.node));
        }
        return meshes;
    });
    scene.def("bounds", [](const LoadedScene& self) {
        const Bounds bounds = boundsOf(self.scene());
        return std::pair(ownedArray<float>({3}, &bounds.lo), ownedArray<float>({3}, &bounds.hi));
    });
    scene.def_property_readonly("warnings", [](const LoadedScene& self) { return self.scene().warnings; });
    scene.def_property_readonly("positions", [](const Pointer& self) {
        return lend<float>(self->scene().positions, py::cast(self));
    });
    scene.def_property_readonly(
        "normals", [](const Pointer& self) { return lend<float>(self->scene().normals, py::cast(self)); });
    scene.def_property_readonly(
        "uvs", [](const Pointer& self) { return lend<float>(self->scene().texCoords, py::cast(self)); });
    scene.def_property_readonly("triangles", [](const Pointer& self) {
        return lend<std::uint32_t>(self->scene().triangles, py::cast(self));
    });
    scene.def_property_readonly("triangle_mesh", [](const Pointer& self) {
        return lend<std::uint32_t>(self->scene().triangleMesh, py::cast(self));
    });
    scene.def_property_readonly("triangle_material", [](const Pointer& self) {
        return lend<std::uint32_t>(self->scene().triangleMaterial, py::cast(self));
    });
    scene.def(
        "render",
        [](const Pointer& self, const Words& words, const bool onePass, Film* const before) {
            return interruptible([&](const std::atomic<bool>& isStopped) {
                return renderFilm(self, words, onePass, before, isStopped);
            });
        },
        py::arg("words"), py::arg("one_pass"), py::arg("before").none(true));
}

void addFilm(py::module_& module) {
    using Pointer = std::shared_ptr<Film>;
    py::class_<Film, Pointer> film(module, "Film");
    film.def_property_readonly("channels", [](const Film& self) {
        std::vector<std::string> names = self.image().channels;
        names.insert(names.end(), self.image().idChannels.begin(), self.image().idChannels.end());
        return names;
    });
    film.def("channel", channelsOf, py::arg("name"));
    film.def("image", [](const Film& self) { return self.image(); });
    film.def("rgba8", [](const Film& self, const Words& words) {
        const std::vector<std::uint8_t> bytes = withoutPython([&] { return self.rgba8(words); });
        return ownedArray<std::uint8_t>({self.image().height, self.image().width, 4}, bytes.data());
    });
    film.def("save", [](const Film& self, const std::string& path, const Words& words) {
        withoutPython([&] { self.save(path, words); });
    });
    film.def_property_readonly("is_complete", &Film::isComplete);
    film.def_property_readonly("warnings", &Film::warnings);
    film.def_property_readonly("width", [](const Film& self) { return self.image().width; });
    film.def_property_readonly("height", [](const Film& self) { return self.image().height; });
    film.def_property_readonly("samples",
                               [](const Film& self) { return self.result().settings.samplesPerPixel; });
    film.def_property_readonly("seconds", [](const Film& self) { return self.result().seconds.render; });
    film.def_property_readonly("device", [](const Film& self) { return self.result().device; });
    film.def_property_readonly("driver", [](const Film& self) { return self.result().driver; });
    film.def_property_readonly("traversal", [](const Film& self) { return self.result().traversal; });
    film.def_property_readonly("world_to_camera",
                               [](const Film& self) { return rowsOf(render::worldToCamera(self.camera())); });
    film.def_property_readonly("world_to_ndc", [](const Film& self) {
        const glm::vec2 size(self.result().size);
        return rowsOf(render::worldToNdc(self.camera(), size.x / size.y));
    });
}

// Other threads of Python run while a tracer waits for its device.
struct DeleteTracer {
    void operator()(Tracer* const tracer) const {
        const py::gil_scoped_release release;
        delete tracer;
    }
};

void addTracer(py::module_& module) {
    using Pointer = std::unique_ptr<Tracer, DeleteTracer>;
    py::class_<Tracer, Pointer> tracer(module, "Tracer");
    tracer.def(py::init([](std::shared_ptr<LoadedScene> scene, const bool onGpu, const std::string& device) {
                   return withoutPython([&] {
                       beginWork();
                       return new Tracer(std::move(scene), onGpu ? openDevice(device) : nullptr);
                   });
               }),
               py::arg("scene"), py::arg("on_gpu"), py::arg("device"));
    tracer.def("trace", [](Tracer& self, const Rows& origins, const Rows& directions, const float tMin,
                           const float tMax) {
        const std::vector<RayQuery> rays = raysOf(origins, directions, tMin, tMax);
        const Hits hits = withoutPython([&] { return self.trace(rays); });
        const auto count = static_cast<py::ssize_t>(rays.size());
        return py::make_tuple(ownedArray<float>({count}, hits.t.data()),
                              ownedArray<std::int32_t>({count}, hits.triangle.data()),
                              ownedArray<float>({count, 2}, hits.uv.data()));
    });
}

// Ends the process without what libraries do then.
void leaveAtOnce(const int status, void*) {
    std::fflush(nullptr);
    _exit(status);
}

// Libraries below OpenImageIO start threads when they are loaded, and wait for them at exit. A forked process
// has no such threads, and would wait for ever. Python has ended before exit() calls leaveAtOnce.
void endForksAtOnce() {
    pthread_atfork(nullptr, nullptr, [] { on_exit(leaveAtOnce, nullptr); });
}

PYBIND11_MODULE(_native, module) {
    endForksAtOnce();
    addErrors(module);
    py::register_exception_translator(translate);
    module.attr("version") = cli::programVersion();
    module.def("options", [] {
        return py::make_tuple(optionsOf(Call::load), optionsOf(Call::render), optionsOf(Call::save));
    });
    addScene(module);
    py::class_<Image> image(module, "Image");
    image.def(py::init(&imageOfArray), py::arg("array"), py::arg("channels"));
    addFilm(module);
    addTracer(module);
    module.def("read_image", [](const std::string& path) {
        return withoutPython([&] {
            beginFileWork();
            return readImage(path);
        });
    });
    module.def("compare", compare, py::arg("a"), py::arg("b"), py::arg("max_abs"),
               py::arg("max_fail_percent"));
    py::module_::import("atexit").attr("register")(py::cpp_function(closeDevices));
}

} // namespace
} // namespace metamarch::python
