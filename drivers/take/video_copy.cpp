#include "drivers/take/video_copy.h"

#include <optional>
#include <stdexcept>
#include <string>
#include <system_error>

#include "core/errors.h"
#include "drivers/take/libav.h"

namespace mocap {
namespace {

/// @return  null if Matroska does not hold the stream.
OutputPtr BeginCopy(const AVStream& from, const std::filesystem::path& to,
                    const std::string& degrees) {
  AVFormatContext* raw = nullptr;
  MOCAP_CHECK(avformat_alloc_output_context2(&raw, nullptr, "matroska", nullptr) >= 0);
  OutputPtr output(raw);
  output->flags |= AVFMT_FLAG_BITEXACT;
  AVStream* stream = avformat_new_stream(output.get(), nullptr);
  MOCAP_CHECK(stream && avcodec_parameters_copy(stream->codecpar, from.codecpar) >= 0);
  stream->codecpar->codec_tag = 0;
  stream->time_base = from.time_base;
  stream->avg_frame_rate = from.avg_frame_rate;
  if (degrees != "0") av_dict_set(&stream->metadata, kTurnTag, degrees.c_str(), 0);
  if (avio_open(&output->pb, ("file:" + to.string()).c_str(), AVIO_FLAG_WRITE) < 0)
    throw std::runtime_error(to.string() + ": cannot be created");
  if (avformat_write_header(output.get(), nullptr) < 0) return nullptr;
  return output;
}

void CopyPackets(AVFormatContext& input, int stream, AVFormatContext& output,
                 const std::filesystem::path& to, const std::function<void()>& check) {
  const PacketPtr packet(av_packet_alloc());
  MOCAP_CHECK(packet);
  const auto require = [&](int result) {
    if (result < 0) throw std::runtime_error(to.string() + ": cannot be written");
  };
  while (av_read_frame(&input, packet.get()) >= 0) {
    check();
    if (packet->stream_index == stream) {
      packet->stream_index = 0;
      packet->pos = -1;
      packet->flags &= ~AV_PKT_FLAG_DISCARD;
      av_packet_rescale_ts(packet.get(), input.streams[stream]->time_base,
                           output.streams[0]->time_base);
      require(av_interleaved_write_frame(&output, packet.get()));
    }
    av_packet_unref(packet.get());
  }
  require(av_write_trailer(&output));
  avio_flush(output.pb);
  require(output.pb->error);
}

}  // namespace

bool CopyVideo(const std::filesystem::path& from, const std::filesystem::path& to,
               const PictureTurn& turn, const std::function<void()>& check) {
  av_log_set_level(AV_LOG_QUIET);
  const std::optional<std::string> degrees = TurnInDegrees(turn);
  if (!degrees) return false;
  const InputPtr input = OpenInput(from);
  if (avformat_find_stream_info(input.get(), nullptr) < 0)
    throw SetupError(from.string() + ": is damaged");
  const int stream = av_find_best_stream(input.get(), AVMEDIA_TYPE_VIDEO, -1, -1, nullptr, 0);
  if (stream < 0) throw SetupError(from.string() + ": has no video that FFmpeg decodes");
  const OutputPtr output = BeginCopy(*input->streams[stream], to, *degrees);
  if (!output) {
    std::error_code error;
    std::filesystem::remove(to, error);
    return false;
  }
  CopyPackets(*input, stream, *output, to, check);
  return true;
}

}  // namespace mocap
