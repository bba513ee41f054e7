// Bit rot in a video.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "core/errors.h"
#include "drivers/take/libav.h"
#include "drivers/take/video_writer.h"
#include "tests/support/small_take.h"
#include "tests/support/temporary_folder.h"

namespace mocap::testing {

/// Gives the coded bytes of one frame of a video whose frames stand on their own.
inline std::string CodedFrame(const std::filesystem::path& file, int frame) {
  AVFormatContext* input = nullptr;
  MOCAP_CHECK(avformat_open_input(&input, file.c_str(), nullptr, nullptr) >= 0);
  const PacketPtr packet(av_packet_alloc());
  for (int i = 0; i <= frame; ++i) {
    av_packet_unref(packet.get());
    MOCAP_CHECK(av_read_frame(input, packet.get()) >= 0);
  }
  std::string bytes(reinterpret_cast<const char*>(packet->data),
                    static_cast<std::size_t>(packet->size));
  avformat_close_input(&input);
  return bytes;
}

/// The gray that fills frame `frame` of the video below.
inline std::uint8_t GrayOf(int frame) { return static_cast<std::uint8_t>(17 * frame + 3); }

/// Writes gray frames, one of which has a spoiled table of slices, so that no decoder can read it.
inline void WriteVideoWithSpoiledFrame(const std::filesystem::path& file, const SmallTake& take,
                                       int frame) {
  VideoWriter writer(file, take.width_px, take.height_px, 25, VideoPixels::kGray);
  for (int i = 0; i < take.frames; ++i) {
    writer.Write(Image<std::uint8_t>(take.width_px, take.height_px, GrayOf(i)).view());
  }
  writer.Finish();
  const std::string coded = CodedFrame(file, frame);
  std::string spoiled = coded;
  for (std::size_t i = spoiled.size() - 8; i < spoiled.size(); ++i) spoiled[i] = '\xff';
  ReplaceInFile(file, coded, spoiled);
}

}  // namespace mocap::testing
