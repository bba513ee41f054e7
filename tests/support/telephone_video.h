// A video as telephones write them: with a turn, and with frames that come as they please.
#pragma once

#include <array>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <vector>

#include "core/errors.h"
#include "drivers/take/libav.h"

namespace mocap::testing {

/// What "held upright" writes: the picture is to be turned right by 90 degrees.
inline constexpr std::array<std::int32_t, 9> kHeldUpright = {0, 65536, 0, -65536, 0,
                                                             0, 0,     0, 1 << 30};

/// Writes gray frames of 64 x 32 pixels, white in the top left quarter alone.
/// @param times_ms  of the frames, ascending.
inline void WriteTelephoneVideo(const std::filesystem::path& file,
                                const std::vector<std::int64_t>& times_ms,
                                const std::array<std::int32_t, 9>& matrix) {
  av_log_set_level(AV_LOG_QUIET);
  constexpr int kWidth = 64, kHeight = 32;
  const CodecPtr encoder(avcodec_alloc_context3(avcodec_find_encoder(AV_CODEC_ID_FFV1)));
  encoder->width = kWidth;
  encoder->height = kHeight;
  encoder->pix_fmt = AV_PIX_FMT_GRAY8;
  encoder->time_base = {1, 1000};
  encoder->gop_size = 1;
  encoder->flags |= AV_CODEC_FLAG_GLOBAL_HEADER;
  MOCAP_CHECK(avcodec_open2(encoder.get(), nullptr, nullptr) >= 0);
  AVFormatContext* output = nullptr;
  MOCAP_CHECK(avformat_alloc_output_context2(&output, nullptr, "mov", file.c_str()) >= 0);
  AVStream* stream = avformat_new_stream(output, nullptr);
  stream->time_base = encoder->time_base;
  MOCAP_CHECK(avcodec_parameters_from_context(stream->codecpar, encoder.get()) >= 0);
  std::memcpy(av_stream_new_side_data(stream, AV_PKT_DATA_DISPLAYMATRIX, sizeof(matrix)),
              matrix.data(), sizeof(matrix));
  MOCAP_CHECK(avio_open(&output->pb, file.c_str(), AVIO_FLAG_WRITE) >= 0 &&
              avformat_write_header(output, nullptr) >= 0);
  const PacketPtr packet(av_packet_alloc());
  for (const std::int64_t time_ms : times_ms) {
    const FramePtr frame(av_frame_alloc());
    frame->format = encoder->pix_fmt;
    frame->width = kWidth;
    frame->height = kHeight;
    frame->pts = time_ms;
    MOCAP_CHECK(av_frame_get_buffer(frame.get(), 0) >= 0);
    for (int y = 0; y < kHeight; ++y) {
      for (int x = 0; x < kWidth; ++x)
        frame->data[0][y * frame->linesize[0] + x] = x < kWidth / 2 && y < kHeight / 2 ? 255 : 0;
    }
    MOCAP_CHECK(avcodec_send_frame(encoder.get(), frame.get()) >= 0 &&
                avcodec_receive_packet(encoder.get(), packet.get()) >= 0);
    packet->duration = 33;
    av_packet_rescale_ts(packet.get(), encoder->time_base, stream->time_base);
    MOCAP_CHECK(av_write_frame(output, packet.get()) >= 0);
  }
  MOCAP_CHECK(av_write_trailer(output) >= 0);
  avio_closep(&output->pb);
  avformat_free_context(output);
}

}  // namespace mocap::testing
