#include "drivers/take/sound_reader.h"

#include <algorithm>
#include <cmath>

#include "core/errors.h"
#include "drivers/take/libav.h"

extern "C" {
#include <libavutil/channel_layout.h>
#include <libswresample/swresample.h>
}

namespace mocap {
namespace {

constexpr AVRational kSoundNanoseconds = {1, 1'000'000'000};
constexpr auto kMostSamples = static_cast<std::size_t>(kLongestSound_s * kSoundRate_hz);
/// Packets whose times differ less from what their samples fill are rounded, not apart.
constexpr double kLeastGap_s = 0.02;

struct ResamplerDeleter {
  void operator()(SwrContext* p) const { swr_free(&p); }
};
using ResamplerPtr = std::unique_ptr<SwrContext, ResamplerDeleter>;

class SoundDecoder {
 public:
  SoundDecoder(const AVStream& stream, const AVCodec* codec)
      : time_base_(stream.time_base),
        decoder_(avcodec_alloc_context3(codec)),
        frame_(av_frame_alloc()) {
    MOCAP_CHECK(decoder_ && frame_);
    decoder_->thread_count = 1;
    decoder_->pkt_timebase = stream.time_base;
    is_open_ = avcodec_parameters_to_context(decoder_.get(), stream.codecpar) >= 0 &&
               avcodec_open2(decoder_.get(), codec, nullptr) >= 0;
  }

  bool is_open() const { return is_open_; }
  bool is_full() const { return track_.samples.size() >= kMostSamples; }
  SoundTrack& track() { return track_; }

  /// @param packet  null: the end.
  void Add(const AVPacket* packet) {
    if (avcodec_send_packet(decoder_.get(), packet) < 0) return;
    while (!is_full() && avcodec_receive_frame(decoder_.get(), frame_.get()) >= 0) AddFrame();
  }

  void Finish() {
    Add(nullptr);
    if (resampler_) Resample(nullptr, 0);
  }

 private:
  void AddFrame() {
    if (frame_->nb_samples <= 0 || !PrepareResampler()) return;
    FillGap();
    Resample(const_cast<const std::uint8_t**>(frame_->extended_data), frame_->nb_samples);
  }

  /// Phones change nothing in the middle of a recording; what does begins anew.
  bool PrepareResampler() {
    const bool is_same = resampler_ && format_ == frame_->format && rate_ == frame_->sample_rate &&
                         channels_ == frame_->ch_layout.nb_channels;
    if (is_same) return true;
    format_ = frame_->format, rate_ = frame_->sample_rate;
    channels_ = frame_->ch_layout.nb_channels;
    AVChannelLayout mono = AV_CHANNEL_LAYOUT_MONO;
    SwrContext* raw = nullptr;
    const bool is_set =
        swr_alloc_set_opts2(&raw, &mono, AV_SAMPLE_FMT_S16, kSoundRate_hz, &frame_->ch_layout,
                            static_cast<AVSampleFormat>(format_), rate_, 0, nullptr) >= 0;
    resampler_.reset(raw);
    if (!is_set || swr_init(resampler_.get()) < 0) resampler_.reset();
    return resampler_ != nullptr;
  }

  void FillGap() {
    if (frame_->best_effort_timestamp == AV_NOPTS_VALUE) return;
    const std::int64_t time_ns =
        av_rescale_q(frame_->best_effort_timestamp, time_base_, kSoundNanoseconds);
    auto& samples = track_.samples;
    const std::int64_t waiting = swr_get_delay(resampler_.get(), kSoundRate_hz);
    if (samples.empty() && waiting == 0) track_.first_ns = time_ns;
    // Of doubles: broken times may be as far apart as can be.
    const double due_s =
        (static_cast<double>(time_ns) - static_cast<double>(track_.first_ns)) / 1e9;
    const double due = due_s * kSoundRate_hz;
    const double missing = due - static_cast<double>(samples.size()) - static_cast<double>(waiting);
    if (missing < kLeastGap_s * kSoundRate_hz) return;
    const double room = static_cast<double>(kMostSamples - samples.size());
    samples.resize(samples.size() + static_cast<std::size_t>(std::min(missing, room)));
  }

  void Resample(const std::uint8_t** in, int count) {
    auto& samples = track_.samples;
    const int most = swr_get_out_samples(resampler_.get(), count);
    if (most <= 0) return;
    const std::size_t before = samples.size();
    samples.resize(before + most);
    auto* out = reinterpret_cast<std::uint8_t*>(samples.data() + before);
    const int made = swr_convert(resampler_.get(), &out, most, in, count);
    samples.resize(before + std::max(made, 0));
  }

  AVRational time_base_;
  CodecPtr decoder_;
  FramePtr frame_;
  ResamplerPtr resampler_;
  bool is_open_ = false;
  int format_ = -1, rate_ = 0, channels_ = 0;
  SoundTrack track_;
};

}  // namespace

std::optional<SoundTrack> ReadSound(const std::filesystem::path& file,
                                    const std::function<void()>& check) {
  av_log_set_level(AV_LOG_QUIET);
  const InputPtr input = OpenInput(file);
  if (avformat_find_stream_info(input.get(), nullptr) < 0) return std::nullopt;
  const AVCodec* codec = nullptr;
  const int stream = av_find_best_stream(input.get(), AVMEDIA_TYPE_AUDIO, -1, -1, &codec, 0);
  if (stream < 0 || codec == nullptr) return std::nullopt;
  SoundDecoder decoder(*input->streams[stream], codec);
  if (!decoder.is_open()) return std::nullopt;
  for (unsigned i = 0; i < input->nb_streams; ++i) {
    if (static_cast<int>(i) != stream) input->streams[i]->discard = AVDISCARD_ALL;
  }
  const PacketPtr packet(av_packet_alloc());
  MOCAP_CHECK(packet);
  while (!decoder.is_full() && av_read_frame(input.get(), packet.get()) >= 0) {
    check();
    if (packet->stream_index == stream) decoder.Add(packet.get());
    av_packet_unref(packet.get());
  }
  decoder.Finish();
  if (decoder.track().samples.empty()) return std::nullopt;
  return std::move(decoder.track());
}

}  // namespace mocap
