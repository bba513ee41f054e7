// A video whose frames need those before them, as other programs write FFV1.
#pragma once

#include <cstdint>
#include <filesystem>

#include "core/errors.h"
#include "drivers/take/libav.h"

namespace mocap::testing {

/// The noise in frame `frame` of the video below.
inline std::uint8_t NoiseAt(int frame, int x, int y) {
  return static_cast<std::uint8_t>((x * 7919u + y * 104729u + frame * 31u) * 2654435761u >> 24);
}

/// Writes gray frames, every fifth of which stands on its own.
inline void WriteVideoOfDependentFrames(const std::filesystem::path& file, int width_px,
                                        int height_px, int frames) {
  const CodecPtr encoder(avcodec_alloc_context3(avcodec_find_encoder(AV_CODEC_ID_FFV1)));
  encoder->width = width_px;
  encoder->height = height_px;
  encoder->pix_fmt = AV_PIX_FMT_GRAY8;
  encoder->time_base = {1, 25};
  encoder->gop_size = 5;
  encoder->flags |= AV_CODEC_FLAG_GLOBAL_HEADER;
  MOCAP_CHECK(avcodec_open2(encoder.get(), nullptr, nullptr) >= 0);
  AVFormatContext* output = nullptr;
  MOCAP_CHECK(avformat_alloc_output_context2(&output, nullptr, "matroska", file.c_str()) >= 0);
  AVStream* stream = avformat_new_stream(output, nullptr);
  stream->time_base = encoder->time_base;
  MOCAP_CHECK(avcodec_parameters_from_context(stream->codecpar, encoder.get()) >= 0);
  MOCAP_CHECK(avio_open(&output->pb, file.c_str(), AVIO_FLAG_WRITE) >= 0 &&
              avformat_write_header(output, nullptr) >= 0);
  const PacketPtr packet(av_packet_alloc());
  for (int i = 0; i < frames; ++i) {
    const FramePtr frame(av_frame_alloc());
    frame->format = encoder->pix_fmt;
    frame->width = width_px;
    frame->height = height_px;
    frame->pts = i;
    MOCAP_CHECK(av_frame_get_buffer(frame.get(), 0) >= 0);
    for (int y = 0; y < height_px; ++y) {
      for (int x = 0; x < width_px; ++x) {
        frame->data[0][y * frame->linesize[0] + x] = NoiseAt(i, x, y);
      }
    }
    MOCAP_CHECK(avcodec_send_frame(encoder.get(), frame.get()) >= 0 &&
                avcodec_receive_packet(encoder.get(), packet.get()) >= 0);
    av_packet_rescale_ts(packet.get(), encoder->time_base, stream->time_base);
    MOCAP_CHECK(av_write_frame(output, packet.get()) >= 0);
  }
  MOCAP_CHECK(av_write_trailer(output) >= 0);
  avio_closep(&output->pb);
  avformat_free_context(output);
}

}  // namespace mocap::testing
