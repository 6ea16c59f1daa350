#include "tests/e2e/server/test_client.h"

#include <cmath>
#include <cstdlib>

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <google/protobuf/util/json_util.h>

namespace volcast::test {

TestClient::TestClient(std::uint16_t port, Form form, const WsOptions& options, v1::Hello hello)
    : socket_{WsClient::connect(port, options)}, form_{form} {
    if (!socket_) return;
    v1::ClientMessage message;
    hello.set_major(protocol::kMajor);
    hello.set_client("test");
    *message.mutable_hello() = std::move(hello);
    send(message);
}

void TestClient::send(const v1::ClientMessage& message) {
    std::string bytes;
    if (form_ == Form::kJson) {
        (void)google::protobuf::util::MessageToJsonString(message, &bytes);
        socket_->sendText(bytes);
    } else {
        message.SerializeToString(&bytes);
        socket_->sendBinary(std::as_bytes(std::span{bytes}));
    }
}

bool TestClient::read(std::chrono::milliseconds limit) {
    const auto message = socket_->receive(limit);
    if (message) take(*message);
    return message.has_value();
}

void TestClient::take(const WsMessage& message) {
    const bool isFrame = !message.text && !message.bytes.empty() &&
                         message.bytes.front() == std::byte{protocol::kMajor};
    const auto* text = reinterpret_cast<const char*>(message.bytes.data());
    if (!isFrame) {
        v1::ServerMessage one;
        const bool parsed =
            message.text
                ? google::protobuf::util::JsonStringToMessage({text, message.bytes.size()}, &one)
                      .ok()
                : one.ParseFromArray(text, static_cast<int>(message.bytes.size()));
        EXPECT_TRUE(parsed);
        EXPECT_EQ(message.text, form_ == Form::kJson);
        messages.push_back(std::move(one));
        return;
    }
    const auto frame = protocol::decodeFrame(message.bytes);
    ASSERT_TRUE(frame.has_value()) << frame.error().message;
    frames.push_back(
        {frame->prefix, frame->header, {frame->payload.begin(), frame->payload.end()}});
    if (acking_) ack(frame->prefix);
}

void TestClient::ack(const protocol::FramePrefix& frame) {
    v1::ClientMessage message;
    message.mutable_ack()->set_view(frame.view);
    message.mutable_ack()->set_sequence(frame.sequence);
    send(message);
}

template <class Item>
std::optional<Item> TestClient::wait(std::vector<Item>& items,
                                     const std::function<bool(const Item&)>& accept) {
    const auto until = std::chrono::steady_clock::now() + kPatience;
    std::size_t next = 0;
    while (std::chrono::steady_clock::now() < until) {
        for (; next < items.size(); ++next) {
            if (!accept(items[next])) continue;
            Item found = std::move(items[next]);
            items.erase(items.begin(), items.begin() + static_cast<std::ptrdiff_t>(next) + 1);
            return found;
        }
        if (!read(std::chrono::milliseconds{200}) && socket_->closeCode() != 0) break;
    }
    return std::nullopt;
}

std::optional<v1::ServerMessage> TestClient::waitFor(
    const std::function<bool(const v1::ServerMessage&)>& accept) {
    return wait(messages, accept);
}

std::optional<v1::Error> TestClient::waitForError() {
    const auto message = waitFor([](const auto& one) { return one.has_error(); });
    if (!message) return std::nullopt;
    return message->error();
}

std::optional<v1::ViewOpened> TestClient::waitForOpened(std::uint32_t view) {
    const auto message = waitFor(
        [&](const auto& one) { return one.has_view_opened() && one.view_opened().view() == view; });
    if (!message) return std::nullopt;
    return message->view_opened();
}

std::optional<v1::Welcome> TestClient::waitForWelcome() {
    const auto message = waitFor([](const auto& one) { return one.has_welcome(); });
    if (!message) return std::nullopt;
    return message->welcome();
}

std::optional<v1::ViewStatus> TestClient::waitForState(std::uint32_t view, v1::ViewState state) {
    const auto message = waitFor([&](const auto& one) {
        return one.has_view_status() && one.view_status().view() == view &&
               one.view_status().state() == state;
    });
    if (!message) return std::nullopt;
    return message->view_status();
}

std::optional<v1::DatasetInfo> TestClient::waitForDataset(const std::string& id,
                                                          v1::DatasetState state) {
    const auto message = waitFor([&](const auto& one) {
        return one.has_dataset_info() && one.dataset_info().id() == id &&
               one.dataset_info().state() == state;
    });
    if (!message) return std::nullopt;
    return message->dataset_info();
}

std::optional<TestFrame> TestClient::waitForFrame(
    const std::function<bool(const TestFrame&)>& accept) {
    return wait(frames, accept);
}

std::optional<TestFrame> TestClient::waitForFrame(std::uint32_t view, std::uint64_t inputSeq) {
    return waitForFrame([&](const TestFrame& frame) {
        return frame.prefix.view == view && frame.header.input_seq() >= inputSeq;
    });
}

std::optional<TestFrame> TestClient::waitForLossless(std::uint32_t view, std::uint64_t inputSeq) {
    return waitForFrame([&](const TestFrame& frame) {
        return frame.prefix.view == view && frame.header.input_seq() >= inputSeq &&
               frame.header.lossless();
    });
}

void TestClient::openView(std::uint32_t view, const std::string& dataset, std::uint32_t width,
                          std::uint32_t height, std::uint64_t inputSeq) {
    v1::ClientMessage message;
    v1::OpenView& open = *message.mutable_open_view();
    open.set_view(view);
    open.set_dataset(dataset);
    open.mutable_viewport()->set_width(width);
    open.mutable_viewport()->set_height(height);
    open.set_input_seq(inputSeq);
    send(message);
}

void TestClient::join(const std::string& link, std::uint32_t view, std::uint32_t width,
                      std::uint32_t height) {
    v1::ClientMessage message;
    v1::OpenView& open = *message.mutable_open_view();
    open.set_view(view);
    open.set_link(link);
    open.mutable_viewport()->set_width(width);
    open.mutable_viewport()->set_height(height);
    send(message);
}

std::string TestClient::share(std::uint32_t view, v1::Role role) {
    v1::ClientMessage message;
    message.mutable_share_view()->set_view(view);
    message.mutable_share_view()->set_role(role);
    send(message);
    const auto shared = waitFor([](const auto& one) { return one.has_view_shared(); });
    return shared ? shared->view_shared().link() : std::string{};
}

void TestClient::look(std::uint32_t view, std::uint64_t inputSeq, double angle) {
    v1::ClientMessage message;
    v1::Update& update = *message.mutable_update();
    update.set_view(view);
    update.set_input_seq(inputSeq);
    v1::Camera& camera = *update.mutable_camera();
    camera.mutable_eye()->set_x(3 * std::cos(angle));
    camera.mutable_eye()->set_y(3 * std::sin(angle));
    camera.mutable_eye()->set_z(0.7);
    camera.mutable_center();
    camera.mutable_up()->set_z(1);
    camera.set_fovy_degrees(40);
    send(message);
}

Decoded decode(const TestFrame& frame) {
    Decoded decoded;
    OIIO::Filesystem::IOMemReader reader{const_cast<std::byte*>(frame.payload.data()),
                                         frame.payload.size()};
    const bool png = frame.header.codec() == v1::CODEC_PNG;
    const auto input = OIIO::ImageInput::open(png ? "a.png" : "a.jpg", nullptr, &reader);
    if (!input) return decoded;
    const OIIO::ImageSpec& spec = input->spec();
    decoded.width = spec.width;
    decoded.height = spec.height;
    decoded.channels = spec.nchannels;
    decoded.pixels.resize(static_cast<std::size_t>(spec.width) * spec.height * spec.nchannels);
    if (!input->read_image(0, 0, 0, spec.nchannels, OIIO::TypeDesc::UINT8, decoded.pixels.data())) {
        return {};
    }
    return decoded;
}

double meanDifference(const Decoded& a, const Decoded& b) {
    if (a.width != b.width || a.height != b.height || a.pixels.empty() || b.pixels.empty()) {
        return 255;
    }
    double sum = 0;
    const int pixels = a.width * a.height;
    for (int pixel = 0; pixel < pixels; ++pixel) {
        for (int channel = 0; channel < 3; ++channel) {
            const int inA = pixel * a.channels + channel;
            const int inB = pixel * b.channels + channel;
            sum += std::abs(int{a.pixels[static_cast<std::size_t>(inA)]} -
                            int{b.pixels[static_cast<std::size_t>(inB)]});
        }
    }
    return sum / (3.0 * pixels);
}

}  // namespace volcast::test
