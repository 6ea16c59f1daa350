#pragma once

#include <atomic>
#include <chrono>
#include <future>
#include <list>
#include <memory>
#include <optional>
#include <string>

#include "renderer/accuracy/measurement.h"
#include "renderer/reference/reference.h"
#include "renderer/scene/render.h"

namespace volcast::accuracy {

/// Measures what drawing with one candidate is worth and costs, against the reference. What the
/// reference finds is kept for the other candidates of the same picture.
///
/// All calls on the renderer's thread.
class Meter {
public:
    explicit Meter(scene::Renderer& renderer) noexcept : renderer_{renderer} {}

    /// Draws job.frames + 1 pictures in a view of its own, and one more where steps are counted.
    /// The frames that are timed turn the camera by a thousandth of a degree each, so that none is
    /// a repetition.
    ///
    /// Errors: as scene::Renderer::render and reference::draw; kInvalidArgument for a layer that
    /// the scene does not have.
    Result<Measurement> measure(const Job& job);

    /// The same in parts, so that other pictures can be drawn between them: a call draws one
    /// picture at most, or waits for some milliseconds while threads of low priority ask the
    /// reference. Empty: to be called again, with the same job; another one begins anew.
    ///
    /// Errors: as measure().
    /// `evidence`: as plans take it; for pictures alone.
    Result<std::optional<Measurement>> advance(const Job& job,
                                               const plan::SceneEvidence& evidence = {});
    /// Ends what advance() has begun.
    void stop();

    /// The mean number of cells that a ray meets, from at most `pixels` rays. Errors: as above.
    Result<double> cellsPerRay(const scene::Scene& scene, scene::PictureSize size,
                               std::uint64_t pixels);

    /// To be called before the renderer replaces or removes the dataset.
    void forget(const std::string& dataset);

private:
    /// What the reference is asked for; the scene without what has no influence.
    struct Question {
        scene::Scene scene;
        scene::PictureSize size{0};
        std::vector<glm::ivec2> pixels;
        friend bool operator==(const Question&, const Question&) = default;
    };
    struct Truth {
        Question question;
        reference::Picture picture;
        ReferenceEffort effort = {};  ///< Until it is told.
    };
    struct Answer {
        reference::Picture picture;
        reference::Bodies bodies;  ///< Also those that had to be made,
        double treeSeconds = 0.0;  ///< in this time.
    };
    /// The reference at work, in the background.
    struct Search {
        Search() = default;
        Search(const Search&) = delete;
        Search& operator=(const Search&) = delete;
        Search(Search&&) = delete;
        Search& operator=(Search&&) = delete;
        ~Search() { cancelled = true; }  // Then `answer` waits for its end.
        Question question;
        std::atomic<bool> cancelled{false};
        std::future<Result<Answer>> answer;
    };
    /// A measurement between its parts.
    struct Run {
        Job job;
        std::uint64_t view = 0;
        scene::Scene scene;  ///< As it is drawn.
        plan::SceneEvidence evidence = {};
        Question question = {};
        std::vector<float> rgba = {};
        std::string drawnWith = {};  ///< The layer in whose draw the candidate's is.
        std::vector<double> times = {};
        Measurement measured = {};
        int drawn = 0;  ///< Pictures.
    };
    using Datasets = std::map<std::string, const data::Dataset*>;

    static Question questionOf(const scene::Scene& scene, scene::PictureSize size,
                               std::vector<glm::ivec2> pixels);
    [[nodiscard]] Datasets datasetsOf(const scene::Scene& scene) const;
    static Result<Answer> ask(const Question& question, reference::Bodies bodies,
                              const Datasets& datasets, const std::atomic<bool>* cancelled);
    /// Null: not known.
    Truth* known(const Question& question);
    Truth* keep(Question question, Answer answer);
    Result<Truth*> truthOf(const Question& question);
    /// In the background; null: not known yet.
    Result<Truth*> searchFor(const Question& question);
    static Result<Run> begin(const Job& job, std::uint64_t view);
    /// Draws the next picture; false: there was none left.
    Result<bool> drawNext(Run& run);
    /// `truth`: null where nothing is compared.
    static Measurement finish(Run& run, Truth* truth);

    scene::Renderer& renderer_;
    reference::Bodies bodies_;
    std::list<Truth> truths_;  ///< The last used first.
    std::unique_ptr<Search> search_;
    std::optional<Run> run_;  ///< Of advance().
};

}  // namespace volcast::accuracy
