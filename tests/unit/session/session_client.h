#pragma once

#include <condition_variable>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include <gtest/gtest.h>

#include "protocol/framing.h"
#include "server/session/session.h"

namespace volcast::session::test {

/// A client of a session without a socket, in binary messages; its strand is the test's thread.
class SessionClient {
public:
    SessionClient(Shared& shared, std::uint64_t number) {
        session = Session::create(shared, number,
                                  {.post =
                                       [this](std::function<void()> act) {
                                           const std::lock_guard lock{mutex_};
                                           posted_.push_back(std::move(act));
                                           came_.notify_all();
                                       },
                                   .wake = [] {}});
    }
    void send(const v1::ClientMessage& message) {
        std::string bytes;
        message.SerializeToString(&bytes);
        session->receive(std::as_bytes(std::span{bytes}), Form::kBinary, Clock::now());
    }
    void hello(const std::string& person = {}, const std::string& resume = {}) {
        v1::ClientMessage message;
        message.mutable_hello()->set_major(protocol::kMajor);
        message.mutable_hello()->set_person(person);
        message.mutable_hello()->set_resume(resume);
        send(message);
    }
    void openView(const std::string& link = {}, std::uint32_t view = 1, std::uint32_t width = 8) {
        v1::ClientMessage message;
        v1::OpenView& open = *message.mutable_open_view();
        open.set_view(view);
        open.mutable_viewport()->set_width(width);
        open.mutable_viewport()->set_height(6);
        open.set_input_seq(1);
        open.set_link(link);
        send(message);
    }
    void look(std::uint64_t seq, double x, std::uint32_t view = 1) {
        v1::ClientMessage message;
        v1::Update& update = *message.mutable_update();
        update.set_view(view);
        update.set_input_seq(seq);
        v1::Camera& camera = *update.mutable_camera();
        camera.mutable_eye()->set_x(x);
        camera.mutable_center();
        camera.mutable_up()->set_z(1);
        camera.set_fovy_degrees(40);
        send(message);
    }
    void undo(bool redo = false) {
        v1::ClientMessage message;
        message.mutable_undo()->set_view(1);
        message.mutable_undo()->set_redo(redo);
        send(message);
    }
    void takeControl() {
        v1::ClientMessage message;
        message.mutable_take_control()->set_view(1);
        send(message);
    }
    void handOver(std::uint32_t person) {
        v1::ClientMessage message;
        message.mutable_hand_over()->set_view(1);
        message.mutable_hand_over()->set_person(person);
        send(message);
    }
    void askControl(bool withdraw = false) {
        v1::ClientMessage message;
        message.mutable_ask_control()->set_view(1);
        message.mutable_ask_control()->set_withdraw(withdraw);
        send(message);
    }
    void setName(const std::string& name) {
        v1::ClientMessage message;
        message.mutable_set_name()->set_person(name);
        send(message);
    }
    /// A link to view 1; empty where it was refused.
    std::string share(v1::Role role, std::uint32_t expiresS = 0) {
        v1::ClientMessage message;
        message.mutable_share_view()->set_view(1);
        message.mutable_share_view()->set_role(role);
        message.mutable_share_view()->set_expires_s(expiresS);
        send(message);
        const auto answer =
            wait([](const auto& one) { return one.has_view_shared() || one.has_error(); });
        return answer ? answer->view_shared().link() : std::string{};
    }
    /// The next message that `accept`s, those before it dropped. Frames are acked.
    std::optional<v1::ServerMessage> wait(
        const std::function<bool(const v1::ServerMessage&)>& accept) {
        const auto until = Clock::now() + std::chrono::seconds{30};
        while (Clock::now() < until) {
            while (const auto out = session->next(Clock::now())) {
                if (out->payload) {
                    take(*out);
                    continue;
                }
                v1::ServerMessage message;
                EXPECT_TRUE(
                    message.ParseFromArray(out->head.data(), static_cast<int>(out->head.size())));
                if (accept(message)) return message;
            }
            run();
        }
        return std::nullopt;
    }
    std::optional<v1::SceneChanged> sceneChanged() {
        const auto message = wait([](const auto& one) { return one.has_scene_changed(); });
        return message ? std::optional{message->scene_changed()} : std::nullopt;
    }
    std::optional<v1::Error> error() {
        const auto message = wait([](const auto& one) { return one.has_error(); });
        return message ? std::optional{message->error()} : std::nullopt;
    }
    /// People of view 1, when there are `count`, and the one who steers is `steers`.
    std::optional<v1::People> people(int count, const std::string& steers) {
        const auto message = wait([&](const auto& one) {
            if (!one.has_people() || one.people().people_size() != count) return false;
            for (const v1::Person& person : one.people().people()) {
                if (person.steers()) return person.name() == steers;
            }
            return steers.empty();
        });
        return message ? std::optional{message->people()} : std::nullopt;
    }
    /// True where nothing that `unwanted`s comes before the answer to a ping.
    bool never(const std::function<bool(const v1::ServerMessage&)>& unwanted) {
        run();
        v1::ClientMessage ping;
        ping.mutable_ping()->set_token(1);
        bool seen = false;
        // Mail comes behind the pong, which the session itself sends: read on until all is said.
        send(ping);
        while (const auto out = session->next(Clock::now())) {
            v1::ServerMessage message;
            if (out->payload ||
                !message.ParseFromArray(out->head.data(), static_cast<int>(out->head.size()))) {
                continue;
            }
            seen = seen || unwanted(message);
        }
        return !seen;
    }
    /// Runs what other threads posted.
    void run() {
        session->tick(Clock::now());
        std::unique_lock lock{mutex_};
        came_.wait_for(lock, std::chrono::milliseconds{5}, [this] { return !posted_.empty(); });
        std::deque<std::function<void()>> now;
        now.swap(posted_);
        lock.unlock();
        for (auto& act : now) act();
    }

    std::shared_ptr<Session> session;
    std::uint64_t newestSeen = 0;  ///< input_seq of the newest frame.

private:
    void take(const Outgoing& out) {
        std::vector<std::byte> all = out.head;
        all.insert(all.end(), out.payload->begin(), out.payload->end());
        const auto frame = protocol::decodeFrame(all);
        ASSERT_TRUE(frame.has_value());
        newestSeen = frame->header.input_seq();
        v1::ClientMessage ack;
        ack.mutable_ack()->set_view(frame->prefix.view);
        ack.mutable_ack()->set_sequence(frame->prefix.sequence);
        send(ack);
    }

    std::mutex mutex_;
    std::condition_variable came_;
    std::deque<std::function<void()>> posted_;
};

}  // namespace volcast::session::test
