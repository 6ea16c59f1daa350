#include "server/commands/scene_options.h"

#include <charconv>
#include <cmath>
#include <initializer_list>

#include <CLI/CLI.hpp>

#include "renderer/scene/ray_models.h"
#include "renderer/scene/validate_sampling.h"
#include "server/workers/render_service.h"

namespace volcast::commands {

namespace {

std::string checkFinite(const std::string& text) {
    double value = 0.0;
    if (CLI::detail::lexical_cast(text, value) && std::isfinite(value)) return {};
    return "\"" + text + "\" is not a finite number";
}

std::string checkAccuracy(const std::string& text) {
    const auto parsed = parseAccuracy(text);
    return parsed ? std::string{} : parsed.error().message;
}

std::vector<std::string> modelNames() {
    std::vector<std::string> names;
    for (const scene::RayModelRow& row : scene::rayModels()) names.emplace_back(row.name);
    for (const char* other : {"max", "on", "composite"}) names.emplace_back(other);
    return names;
}

std::vector<std::string> integratorNames() {
    std::vector<std::string> names{"auto"};
    for (const scene::RayModelRow& row : scene::rayModels()) {
        for (const auto rows : {row.integrators, row.voxelIntegrators}) {
            for (const scene::IntegratorRow& integrator : rows) {
                if (std::ranges::count(names, integrator.name) == 0) {
                    names.emplace_back(integrator.name);
                }
            }
        }
    }
    return names;
}

std::vector<std::string> evaluatorNames() {
    using scene::MeshEvaluator;
    std::vector<std::string> names;
    for (const MeshEvaluator evaluator :
         {MeshEvaluator::kAuto, MeshEvaluator::kWalk, MeshEvaluator::kProjection,
          MeshEvaluator::kProjectionFaces}) {
        names.emplace_back(scene::name(evaluator));
    }
    return names;
}

using Options = std::vector<CLI::Option*>;

/// Options that are headed alike in --help.
class Group {
public:
    /// Each option that is added goes to `all`, too, unless that is null.
    Group(CLI::App& command, std::string heading, Options* all)
        : command_{command}, heading_{std::move(heading)}, all_{all} {}

    template <class Value>
    CLI::Option* add(const std::string& name, Value& value, const std::string& help) {
        return headed(command_.add_option(name, value, help));
    }
    /// `Value` is a vector of exactly `count` numbers.
    template <class Value>
    CLI::Option* numbers(const std::string& name, Value& value, int count,
                         const std::string& help) {
        return add(name, value, help)->expected(count)->check(finite());
    }
    CLI::Option* flag(const std::string& name, bool& value, const std::string& help) {
        return headed(command_.add_flag(name, value, help));
    }

private:
    CLI::Option* headed(CLI::Option* option) {
        option->group(heading_);
        if (all_ != nullptr) all_->push_back(option);
        return option;
    }

    CLI::App& command_;
    std::string heading_;
    Options* all_;
};

void addScale(Group& group, const std::string& name, const std::string& of, ScaleOptions& o) {
    group.add(name, o.kind, "Scale of " + of + ": linear, log or power")
        ->check(CLI::IsMember({"linear", "log", "power"}));
    group.add(name + "-exponent", o.exponent, "Of a power scale, above 0")
        ->check(finite() & CLI::PositiveNumber);
    group.numbers(name + "-domain", o.domain, 2,
                  "MIN MAX that the scale runs over; none: the field's range");
}

void addChoices(Group group, SceneOptions& o) {
    group
        .add("--model", o.model,
             "Ray model; max is mip, on and composite are volume; none: as the data suggests")
        ->check(knownModel());
    group.add("--integrator", o.integrator, "How a ray's share of a cell is integrated")
        ->check(knownIntegrator());
    group.add("--evaluator", o.evaluator, "What brings rays and cells of a mesh together")
        ->check(knownEvaluator());
}

void addWhat(Group group, SceneOptions& o) {
    group.add("--field", o.field, "Field or channel by name; none: the first");
    group.add("--time-step", o.timeStep, "From 0")->check(CLI::NonNegativeNumber);
    group.add("--tf", o.map,
              "Transfer function: a file of lines `value r g b sigma`, or of JSON (drawn maps, "
              "tables; see server/commands/README.md)");
    addScale(group, "--scale", "--field", o.scale);
    group.add(
        "--channel", o.channels,
        "NAME FILE: a channel and its transfer function, as --tf; given again: drawn together");
    group.add("--density-field", o.densityField,
              "Second field: extinction of volume and xray, colour of an isosurface");
    group.add("--density-tf", o.densityMap, "Its transfer function; none: that of --tf");
    addScale(group, "--density-scale", "--density-field", o.densityScale);
    group.numbers("--interval", o.interval, 2, "LO HI: only where the field is between them");
    group
        .add("--markers", o.markers,
             "FIELD VALUE...: only cells whose value in a field of cells is one of these")
        ->expected(2, 1024);
}

void addModelOptions(Group group, SceneOptions& o) {
    auto* colour = group.numbers("--colour", o.colour, 3, "Of a surface: linear R G B")
                       ->check(CLI::NonNegativeNumber);
    group.flag("--coloured", o.coloured, "Surface in the colours of its field")->excludes(colour);
    group.flag("--unlit", o.unlit, "Surface and isosurface without headlight");
    group.add("--edge-width", o.edgeWidth, "Of a wireframe, in pixels")
        ->check(finite() & CLI::PositiveNumber);
    group.numbers("--edge-colour", o.edgeColour, 3, "Of a wireframe: linear R G B")
        ->check(CLI::NonNegativeNumber);
    auto* levels = group.add("--levels", o.levels, "Values of isosurfaces")
                       ->expected(1, scene::Levels::kMaxLevels)
                       ->check(finite());
    auto* range = group
                      .numbers("--level-range", o.levelRange, 3,
                               "FIRST LAST COUNT of evenly spaced isosurfaces, ends included")
                      ->excludes(levels);
    group.add("--level-spacing", o.levelSpacing, "Of --level-range: linear, log or power")
        ->check(CLI::IsMember({"linear", "log", "power"}))
        ->needs(range);
    group.add("--level-exponent", o.levelExponent, "Of power spacing, above 0; none: 2")
        ->check(finite() & CLI::PositiveNumber)
        ->needs(range);
    group.add("--exposure", o.exposure, "Of splat, in stops; none: as the data suggests")
        ->check(finite());
    group.numbers("--section-point", o.sectionPoint, 3,
                  "X Y Z in the world where cross-sections meet; none: the middle");
    group.add("--sections", o.sections, "Which of them: across the grid's x, y, z; none: all")
        ->check(CLI::IsMember({"x", "y", "z"}));
    group
        .add("--extinction-scale", o.extinctionScale,
             "Factor of xray's extinction; none: as the data suggests")
        ->check(finite() & CLI::NonNegativeNumber);
}

void addLight(Group group, SceneOptions& o) {
    auto* light = group.flag("--light", o.light, "A volume of voxels reflects light");
    group.numbers("--light-position", o.lightPosition, 3, "X Y Z in the world; none: at the eye")
        ->needs(light);
    const auto number = [&](const char* name, std::optional<float>& value, const char* help) {
        return group.add(name, value, help)->check(finite())->needs(light);
    };
    number("--ambient", o.ambient, "Part of the colour that needs no light; none: 0.3")
        ->check(CLI::NonNegativeNumber);
    number("--diffuse", o.diffuse, "Part that faces the light; none: 0.7")
        ->check(CLI::NonNegativeNumber);
    number("--specular", o.specular, "White highlight; none: 0.2")->check(CLI::NonNegativeNumber);
    number("--shininess", o.shininess, "Exponent of the highlight; none: 32")
        ->check(CLI::PositiveNumber);
}

void addEvaluation(Group group, SceneOptions& o) {
    auto* step =
        group.add("--step", o.step, "Sampling distance in voxels' world units; 0: half a voxel")
            ->check(finite() & CLI::NonNegativeNumber);
    group
        .add("--depth-samples", o.depthSamples,
             "Samples over the depth that a volume of voxels reaches along the view, 64 where no "
             "number follows; none: by --step")
        ->expected(0, 1)
        ->default_str(std::to_string(scene::kUsualDepthSamples))
        ->check(CLI::Range(1, scene::kMaxDepthSamples))
        ->excludes(step);
    group.add("--gain", o.gain, "A volume's extinction is multiplied by e to this; -10 to 10")
        ->check(finite() & CLI::Range(-scene::kMaxGain, scene::kMaxGain));
    group.add("--jitter", o.jitter,
              "Seed that moves each pixel's samples of voxels within their steps; none: not moved");
    group.add("--sampling", o.sampling, "Between voxels: trilinear, tricubic or nearest")
        ->check(CLI::IsMember({"trilinear", "tricubic", "nearest"}));
    group
        .add("--voxel-evaluator", o.voxelEvaluator,
             "Of voxels: march, slices or slice_instances; auto: march")
        ->check(CLI::IsMember({"auto", "march", "slices", "slice_instances"}));
}

void addShader(Group group, SceneOptions& o) {
    auto* shader = group.add("--shader", o.shader,
                             "File of GLSL that says what samples of volume, mip and minip show; "
                             "its #uicontrol lines declare controls");
    group
        .add("--control", o.controls,
             "NAME=VALUE of a control of --shader: a number, a CSS colour, true or false, an "
             "option, [FROM, TO] of an invlerp, [[VALUE, \"#rrggbb\", OPACITY], ...] of a "
             "transferFunction; each with its own --control")
        ->allow_extra_args(false)
        ->needs(shader);
}

void addView(Group group, SceneOptions& o) {
    group.add("--camera", o.camera,
              "JSON file {eye, center, up, fovy, near, far}; none: all in view");
    group.add("--projection", o.projection, "perspective or orthographic")
        ->check(CLI::IsMember({"perspective", "orthographic"}));
    group
        .add("--clip", o.clip,
             "NX NY NZ OFFSET: only where n.x >= offset; up to 6, each with its own --clip")
        ->check(finite())
        ->allow_extra_args(false);
    group
        .add("--accuracy", o.accuracy,
             "Where no integrator is named: auto, fastest, exact, error:X (at most, in 1/255) or "
             "time:MS (at most)")
        ->check(CLI::Validator{checkAccuracy, "WISH", "accuracy"});
    group
        .numbers("--background", o.background, 3,
                 "Linear R G B behind the picture; none: transparent")
        ->check(CLI::NonNegativeNumber);
    group.add("--size", o.size, "Width and height in pixels")
        ->expected(2)
        ->check(CLI::Range(1, scene::kMaxPictureSide))
        ->capture_default_str();
}

void addHow(Group group, SceneOptions& o) {
    group.add("--gpu", o.gpu, "EGL device as `volcast doctor` lists it; none: surfaceless")
        ->envname("VOLCAST_GPU");
    group.add("--cache-dir", o.cacheFolder,
              "Folder for the driver's compiled shaders and for measured costs");
    group.add("--shader-dir", o.shaderFolder, "Read shader chunks from here");
    group
        .add("--volume-budget", o.volumeBudgetMib,
             "MiB of GPU memory for all voxels of a scene: those that take more are drawn from "
             "bricks")
        ->check(CLI::Range(workers::kLeastVolumeBudgetMib, workers::kMostVolumeBudgetMib))
        ->capture_default_str();
    group.add("--timeout", o.timeoutSeconds, "Seconds that one frame may take")
        ->check(CLI::Range(0.001, 86'400.0))
        ->capture_default_str();
    group.add("--tetgen-switches", o.tetgenSwitches, "How TetGen fills surfaces")
        ->capture_default_str();
    group
        .numbers("--spacing", o.spacing, 3, "Distance of pixels and slices in image stacks: X Y Z")
        ->check(CLI::PositiveNumber);
}

}  // namespace

CLI::Validator knownModel() {
    return CLI::IsMember(modelNames());
}

CLI::Validator knownIntegrator() {
    return CLI::IsMember(integratorNames());
}

CLI::Validator knownEvaluator() {
    return CLI::IsMember(evaluatorNames());
}

const CLI::Validator& finite() {
    static const CLI::Validator kFinite{checkFinite, "NUMBER", "finite"};
    return kFinite;
}

Result<scene::Accuracy> parseAccuracy(const std::string& text) {
    using Kind = scene::Accuracy::Kind;
    if (text == "auto") return scene::Accuracy{.kind = Kind::kAuto};
    if (text == "fastest") return scene::Accuracy{.kind = Kind::kFastest};
    if (text == "exact") return scene::Accuracy{.kind = Kind::kExact};
    const std::size_t colon = text.find(':');
    const std::string kind = text.substr(0, colon);
    if (colon != std::string::npos && (kind == "error" || kind == "time")) {
        double bound = 0.0;
        const char* end = text.data() + text.size();
        const auto read = std::from_chars(text.data() + colon + 1, end, bound);
        if (read.ec == std::errc{} && read.ptr == end && std::isfinite(bound) && bound > 0.0) {
            return scene::Accuracy{.kind = kind == "error" ? Kind::kErrorBound : Kind::kTimeBudget,
                                   .bound = bound};
        }
    }
    return fail(ErrorCode::kInvalidArgument,
                "\"" + text +
                    "\" is not auto, fastest, exact, error:X or time:MS with a number "
                    "above 0");
}

void addSceneOptions(CLI::App& command, SceneOptions& o, Choices choices) {
    command
        .add_option("dataset", o.dataset, "A file, a folder of pictures, demo:mesh or demo:volume")
        ->required();
    auto* document = command.add_option("--scene", o.sceneFile,
                                        "Scene document (JSON), as a client saves it; its layers "
                                        "are drawn from DATASET; without the options of layers");
    document->group("What is drawn");
    Options ofLayer;
    if (choices == Choices::kOne) addChoices({command, "What is drawn", &ofLayer}, o);
    addWhat({command, "What is drawn", &ofLayer}, o);
    addModelOptions({command, "Ray models", &ofLayer}, o);
    addLight({command, "Light", &ofLayer}, o);
    addEvaluation({command, "How rays are evaluated", &ofLayer}, o);
    // Nothing else draws what code shows, so that it cannot be measured.
    if (choices == Choices::kOne) addShader({command, "Shader code", &ofLayer}, o);
    // Not excludes(): --help would list them all.
    command.parse_complete_callback([document, ofLayer] {
        if (document->empty()) return;
        for (const CLI::Option* option : ofLayer) {
            if (!option->empty()) throw CLI::ExcludesError(option->get_name(), "--scene");
        }
    });
    addView({command, "View", nullptr}, o);
    addHow({command, "Machine and import", nullptr}, o);
}

}  // namespace volcast::commands
