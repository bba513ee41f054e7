// Writes videos of gray pictures, as other programs do.
#pragma once

#include <array>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <functional>
#include <optional>
#include <vector>

#include "core/errors.h"
#include "drivers/take/libav.h"

namespace mocap::testing {

/// What a video is to be like.
struct GrayVideo {
  const char* container = "matroska";
  int width_px = 64, height_px = 32;
  AVRational time_base = {1, 25};
  int keyframe_every = 1;
  std::vector<std::int64_t> times = {};  ///< Of the frames, in units of the time base.
  std::int64_t duration = 0;             ///< Of a frame; 0: not told.
  std::optional<std::array<std::int32_t, 9>> display_matrix = {};
  /// The brightness of a pixel of a frame.
  std::function<std::uint8_t(int frame, int x, int y)> pixel = nullptr;
};

inline void WriteGrayFrame(const GrayVideo& video, int number, AVCodecContext& encoder,
                           AVFormatContext& output, AVPacket& packet) {
  const FramePtr frame(av_frame_alloc());
  frame->format = encoder.pix_fmt;
  frame->width = video.width_px;
  frame->height = video.height_px;
  frame->pts = video.times[number];
  MOCAP_CHECK(av_frame_get_buffer(frame.get(), 0) >= 0);
  for (int y = 0; y < video.height_px; ++y) {
    for (int x = 0; x < video.width_px; ++x) {
      frame->data[0][y * frame->linesize[0] + x] = video.pixel(number, x, y);
    }
  }
  MOCAP_CHECK(avcodec_send_frame(&encoder, frame.get()) >= 0 &&
              avcodec_receive_packet(&encoder, &packet) >= 0);
  packet.duration = video.duration;
  av_packet_rescale_ts(&packet, encoder.time_base, output.streams[0]->time_base);
  MOCAP_CHECK(av_write_frame(&output, &packet) >= 0);
}

/// Writes a video, coded by FFV1.
inline void WriteGrayVideo(const std::filesystem::path& file, const GrayVideo& video) {
  const CodecPtr encoder(avcodec_alloc_context3(avcodec_find_encoder(AV_CODEC_ID_FFV1)));
  encoder->width = video.width_px;
  encoder->height = video.height_px;
  encoder->pix_fmt = AV_PIX_FMT_GRAY8;
  encoder->time_base = video.time_base;
  encoder->gop_size = video.keyframe_every;
  encoder->flags |= AV_CODEC_FLAG_GLOBAL_HEADER;
  MOCAP_CHECK(avcodec_open2(encoder.get(), nullptr, nullptr) >= 0);
  AVFormatContext* output = nullptr;
  MOCAP_CHECK(avformat_alloc_output_context2(&output, nullptr, video.container, file.c_str()) >= 0);
  AVStream* stream = avformat_new_stream(output, nullptr);
  stream->time_base = encoder->time_base;
  MOCAP_CHECK(avcodec_parameters_from_context(stream->codecpar, encoder.get()) >= 0);
  if (video.display_matrix) {
    constexpr std::size_t kBytes = sizeof(*video.display_matrix);
    std::memcpy(av_stream_new_side_data(stream, AV_PKT_DATA_DISPLAYMATRIX, kBytes),
                video.display_matrix->data(), kBytes);
  }
  MOCAP_CHECK(avio_open(&output->pb, file.c_str(), AVIO_FLAG_WRITE) >= 0 &&
              avformat_write_header(output, nullptr) >= 0);
  const PacketPtr packet(av_packet_alloc());
  for (int i = 0; i < static_cast<int>(video.times.size()); ++i) {
    WriteGrayFrame(video, i, *encoder, *output, *packet);
  }
  MOCAP_CHECK(av_write_trailer(output) >= 0);
  avio_closep(&output->pb);
  avformat_free_context(output);
}

}  // namespace mocap::testing
