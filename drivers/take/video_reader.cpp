#include "drivers/take/video_reader.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/errors.h"
#include "drivers/quoted.h"
#include "drivers/take/libav.h"

namespace mocap {
namespace {

// swscale's vector code may write past the end of a row.
constexpr int kRowAlignment_px = 64;
constexpr int kLargestSide_px = 16384;

/// Telephones write a key frame every second or so.
constexpr std::int64_t kSoon_s = 3;

/// No frame in an otherwise valid video.
class NoFrame : public SetupError {
 public:
  explicit NoFrame(const std::filesystem::path& file)
      : SetupError(file.string() + ": contains no complete frame; expected at least one") {}
};

[[noreturn]] void Fail(const std::filesystem::path& file, const std::string& what) {
  throw SetupError(file.string() + ": " + what);
}

CodecPtr OpenDecoder(const std::filesystem::path& file, const AVStream& stream,
                     const AVCodec* codec) {
  CodecPtr decoder(avcodec_alloc_context3(codec));
  MOCAP_CHECK(decoder);
  decoder->thread_count = 1;
  decoder->pkt_timebase = stream.time_base;
  if (avcodec_parameters_to_context(decoder.get(), stream.codecpar) < 0 ||
      avcodec_open2(decoder.get(), codec, nullptr) < 0) {
    Fail(file, "has a video stream that cannot be decoded");
  }
  return decoder;
}

/// Whether packets can be counted in place of frames, as they are in order.
bool HasAPacketForEachFrame(AVCodecID codec) {
  const AVCodecDescriptor* descriptor = avcodec_descriptor_get(codec);
  const bool stands_alone = descriptor && (descriptor->props & AV_CODEC_PROP_INTRA_ONLY) != 0;
  return stands_alone || codec == AV_CODEC_ID_FFV1;
}

}  // namespace

class VideoReader::Impl {
 public:
  explicit Impl(std::filesystem::path file)
      : file_(std::move(file)), frame_(av_frame_alloc()), packet_(av_packet_alloc()) {
    MOCAP_CHECK(frame_ && packet_);
    av_log_set_level(AV_LOG_QUIET);
    Open();
  }

  int width_px() const { return turn_.SwapsSides() ? height_px_ : width_px_; }
  int height_px() const { return turn_.SwapsSides() ? width_px_ : height_px_; }
  const PictureTurn& turn() const { return turn_; }
  std::optional<std::int64_t> time_ns() const { return time_ns_; }

  void Open() {
    input_ = OpenInput(file_);
    if (avformat_find_stream_info(input_.get(), nullptr) < 0) Fail(file_, "is damaged");
    const AVCodec* codec = nullptr;
    stream_ = av_find_best_stream(input_.get(), AVMEDIA_TYPE_VIDEO, -1, -1, &codec, 0);
    if (stream_ < 0 || codec == nullptr) Fail(file_, "has no video that FFmpeg decodes");
    decoder_ = OpenDecoder(file_, *input_->streams[stream_], codec);
    passes_undecoded_ = HasAPacketForEachFrame(codec->id);
    passed_.clear();
    input_ended_ = false;
    width_px_ = height_px_ = 0;
    next_ = 0;
    counts_ = true;
    frame_waits_ = DecodeFirst();
    if (!frame_waits_) throw NoFrame(file_);
    width_px_ = frame_->width;
    height_px_ = frame_->height;
    if (width_px_ > kLargestSide_px || height_px_ > kLargestSide_px) Fail(file_, "is too large");
    row_px_ = (width_px_ + kRowAlignment_px - 1) / kRowAlignment_px * kRowAlignment_px;
    pixels_.resize(static_cast<std::size_t>(row_px_) * (height_px_ + 1));
    turn_ = TurnOf(*input_->streams[stream_]);
    if (!turn_.IsNone()) turned_ = Image<Bgr>(width_px(), height_px());
  }

  VideoStatus Next() {
    const bool is_decoded = std::exchange(frame_waits_, false);
    const VideoStatus status = is_decoded ? VideoStatus::kFrame : Decode();
    if (status == VideoStatus::kEnd) return status;
    const bool is_first = counts_ && next_ == 0;
    if (status == VideoStatus::kBroken) {
      Count(AV_NOPTS_VALUE);
      return status;
    }
    Count(frame_->best_effort_timestamp);
    KeepTime(frame_->best_effort_timestamp);
    return is_first || IsWhole() ? VideoStatus::kFrame : VideoStatus::kBroken;
  }

  void KeepInMemory() {
    Open();
    KeptFrame frame;
    for (ImageView<const Bgr> image; (frame.status = Decoded(image)) != VideoStatus::kEnd;) {
      frame.image = Image<Bgr>(width_px(), height_px());
      if (frame.status == VideoStatus::kFrame) {
        for (int y = 0; y < height_px(); ++y)
          std::copy_n(image.row(y), width_px(), frame.image.row(y));
      }
      kept_.push_back(std::move(frame));
    }
    decoder_.reset();
    input_.reset();
  }

  VideoStatus Read(ImageView<const Bgr>& image) {
    if (kept_.empty()) return Decoded(image);
    if (next_kept_ == kept_.size()) return VideoStatus::kEnd;
    const KeptFrame& frame = kept_[next_kept_++];
    image = frame.image.view();
    return frame.status;
  }

  VideoStatus Skip() {
    if (kept_.empty()) return Pass();
    return next_kept_ == kept_.size() ? VideoStatus::kEnd : kept_[next_kept_++].status;
  }

  bool ReturnTo(std::size_t frame) {
    if (!kept_.empty()) {
      next_kept_ = std::min(frame, kept_.size());
      return frame < kept_.size();
    }
    if (!counts_ || frame >= times_.size() || times_[frame] == AV_NOPTS_VALUE ||
        std::ranges::count(times_, times_[frame]) != 1 ||
        av_seek_frame(input_.get(), stream_, times_[frame], AVSEEK_FLAG_BACKWARD) < 0) {
      return false;
    }
    avcodec_flush_buffers(decoder_.get());
    passed_.clear();
    input_ended_ = false;
    VideoStatus status = VideoStatus::kBroken;
    while (status == VideoStatus::kBroken ||
           (status == VideoStatus::kFrame && frame_->best_effort_timestamp < times_[frame])) {
      status = Decode();
    }
    frame_waits_ = status == VideoStatus::kFrame && frame_->best_effort_timestamp == times_[frame];
    next_ = frame;
    return frame_waits_;
  }

  bool GoTo(std::int64_t time_ns) {
    if (!kept_.empty()) return false;
    const AVRational unit = input_->streams[stream_]->time_base;
    const std::int64_t pts = av_rescale_q(time_ns, {1, 1'000'000'000}, unit);
    counts_ = false;
    if (!IsSoonAfter(pts) && av_seek_frame(input_.get(), stream_, pts, AVSEEK_FLAG_BACKWARD) >= 0) {
      avcodec_flush_buffers(decoder_.get());
      passed_.clear();
      frame_waits_ = input_ended_ = false;
    }
    VideoStatus status = frame_waits_ ? VideoStatus::kFrame : Decode();
    while (status == VideoStatus::kBroken ||
           (status == VideoStatus::kFrame && frame_->best_effort_timestamp < pts)) {
      status = Decode();
    }
    frame_waits_ = status == VideoStatus::kFrame;
    return frame_waits_;
  }

  void Rewind() {
    next_kept_ = 0;
    if (kept_.empty()) Open();
  }

 private:
  struct KeptFrame {
    VideoStatus status = VideoStatus::kEnd;
    Image<Bgr> image;
  };

  VideoStatus Decoded(ImageView<const Bgr>& image) {
    const VideoStatus status = Next();
    if (status != VideoStatus::kFrame) return status;
    if (!Convert()) return VideoStatus::kBroken;
    image = {pixels_.data(), width_px_, height_px_, row_px_};
    if (turn_.IsNone()) return status;
    Turn(turn_, image, turned_.view());
    image = std::as_const(turned_).view();
    return status;
  }

  bool IsWhole() const {
    return frame_->width == width_px_ && frame_->height == height_px_ &&
           (frame_->flags & AV_FRAME_FLAG_CORRUPT) == 0 && frame_->decode_error_flags == 0;
  }

  // Whether decoding up to a frame is less work than searching it.
  bool IsSoonAfter(std::int64_t pts) const {
    const std::int64_t now = frame_->best_effort_timestamp;
    return now != AV_NOPTS_VALUE && pts >= now &&
           av_rescale_q(pts - now, input_->streams[stream_]->time_base, {1, 1}) < kSoon_s;
  }

  void Count(std::int64_t pts) {
    if (!counts_) return;
    if (next_ == times_.size()) times_.push_back(pts);
    ++next_;
  }

  void KeepTime(std::int64_t pts) {
    time_ns_.reset();
    if (pts == AV_NOPTS_VALUE) return;
    time_ns_ = av_rescale_q(pts, input_->streams[stream_]->time_base, {1, 1'000'000'000});
  }

  // The first frame's rotation takes precedence over the file's. Matroska has only a tag.
  PictureTurn TurnOf(const AVStream& stream) const {
    std::array<std::int32_t, 9> matrix{};
    std::size_t size = 0;
    const std::uint8_t* data = av_stream_get_side_data(&stream, AV_PKT_DATA_DISPLAYMATRIX, &size);
    if (const AVFrameSideData* of_frame =
            av_frame_get_side_data(frame_.get(), AV_FRAME_DATA_DISPLAYMATRIX)) {
      data = of_frame->data;
      size = of_frame->size;
    }
    if (data == nullptr || size < sizeof(matrix)) return TurnOfTag(stream);
    std::memcpy(matrix.data(), data, sizeof(matrix));
    const std::optional<PictureTurn> turn = TurnFromDisplayMatrix(matrix);
    if (!turn)
      Fail(file_,
           "has a display rotation that is not a multiple of 90 degrees; record it without a "
           "rotation");
    return *turn;
  }

  PictureTurn TurnOfTag(const AVStream& stream) const {
    const AVDictionaryEntry* tag = av_dict_get(stream.metadata, kTurnTag, nullptr, 0);
    if (tag == nullptr) return {};
    const std::optional<PictureTurn> turn = TurnFromDegrees(tag->value);
    if (!turn)
      Fail(file_, "has the tag " + std::string(kTurnTag) + " = " + Quoted(tag->value) +
                      "; expected a multiple of 90 degrees");
    return *turn;
  }

  // A recording may begin with frames whose key frame is missing. They do not belong to the take.
  bool DecodeFirst() {
    VideoStatus status = VideoStatus::kBroken;
    while (status == VideoStatus::kBroken) status = Decode();
    return status == VideoStatus::kFrame;
  }

  VideoStatus Decode() {
    while (true) {
      const int received = avcodec_receive_frame(decoder_.get(), frame_.get());
      if (received == 0) return VideoStatus::kFrame;
      if (received == AVERROR_EOF || input_ended_) return VideoStatus::kEnd;
      if (received != AVERROR(EAGAIN)) return VideoStatus::kBroken;
      if (!Feed()) return VideoStatus::kBroken;
    }
  }

  VideoStatus Pass() {
    if (frame_waits_ || !passes_undecoded_) return Next();
    if (!FetchPacket()) return VideoStatus::kEnd;
    Count(packet_->pts);
    KeepTime(packet_->pts);
    passed_.emplace_back(av_packet_clone(packet_.get()));
    return VideoStatus::kFrame;
  }

  // Fetches the video's next packet. A key frame makes the skipped packets unnecessary.
  bool FetchPacket() {
    do {
      av_packet_unref(packet_.get());
      if (av_read_frame(input_.get(), packet_.get()) < 0) return false;
    } while (packet_->stream_index != stream_);
    if (packet_->flags & AV_PKT_FLAG_KEY) passed_.clear();
    return true;
  }

  // Passes one packet, or the end, to the decoder; false: the packet is bad.
  bool Feed() {
    if (!FetchPacket()) {
      input_ended_ = true;
      avcodec_send_packet(decoder_.get(), nullptr);
      return true;
    }
    for (const PacketPtr& packet : std::exchange(passed_, {})) {
      avcodec_send_packet(decoder_.get(), packet.get());
      avcodec_receive_frame(decoder_.get(), frame_.get());
    }
    return avcodec_send_packet(decoder_.get(), packet_.get()) >= 0;
  }

  bool Convert() {
    if (!scaler_ || scaled_format_ != frame_->format) PrepareScaler();
    if (!scaler_) return false;
    auto* first = reinterpret_cast<std::uint8_t*>(pixels_.data());
    std::uint8_t* const planes[] = {first, nullptr, nullptr, nullptr};
    const int strides[] = {row_px_ * static_cast<int>(sizeof(Bgr)), 0, 0, 0};
    return sws_scale(scaler_.get(), frame_->data, frame_->linesize, 0, height_px_, planes,
                     strides) == height_px_;
  }

  void PrepareScaler() {
    scaled_format_ = frame_->format;
    const auto format = static_cast<AVPixelFormat>(frame_->format);
    scaler_.reset(sws_getContext(width_px_, height_px_, format, width_px_, height_px_,
                                 AV_PIX_FMT_BGR24, SWS_BILINEAR, nullptr, nullptr, nullptr));
    if (!scaler_) return;
    const bool unspecified_gray =
        format == AV_PIX_FMT_GRAY8 && frame_->color_range == AVCOL_RANGE_UNSPECIFIED;
    const bool full_range = frame_->color_range == AVCOL_RANGE_JPEG || unspecified_gray;
    const int* matrix = sws_getCoefficients(frame_->colorspace);
    sws_setColorspaceDetails(scaler_.get(), matrix, full_range, matrix, 1, 0, 1 << 16, 1 << 16);
  }

  std::filesystem::path file_;
  InputPtr input_;
  CodecPtr decoder_;
  FramePtr frame_;
  PacketPtr packet_;
  ScalerPtr scaler_;
  int scaled_format_ = AV_PIX_FMT_NONE;
  int stream_ = -1;
  int width_px_ = 0, height_px_ = 0;
  int row_px_ = 0;
  bool input_ended_ = false;
  bool frame_waits_ = false;         // The next frame is decoded already.
  bool counts_ = true;               // Whether next_ is known.
  std::size_t next_ = 0;             // Number of the next frame.
  std::vector<std::int64_t> times_;  // Of each frame so far, in the stream's units.
  bool passes_undecoded_ = false;
  std::vector<PacketPtr> passed_;  // Skipped since the last key frame: later frames may need them.
  std::vector<Bgr> pixels_;
  PictureTurn turn_;
  Image<Bgr> turned_;
  std::optional<std::int64_t> time_ns_;
  std::vector<KeptFrame> kept_;  // Empty: frames are decoded when they are read.
  std::size_t next_kept_ = 0;
};

VideoReader::VideoReader(const std::filesystem::path& file) : impl_(std::make_unique<Impl>(file)) {}
VideoReader::VideoReader(VideoReader&&) noexcept = default;
VideoReader& VideoReader::operator=(VideoReader&&) noexcept = default;
VideoReader::~VideoReader() = default;

int VideoReader::width_px() const { return impl_->width_px(); }
int VideoReader::height_px() const { return impl_->height_px(); }
const PictureTurn& VideoReader::turn() const { return impl_->turn(); }
std::optional<std::int64_t> VideoReader::time_ns() const { return impl_->time_ns(); }
VideoStatus VideoReader::Read(ImageView<const Bgr>& image) { return impl_->Read(image); }
VideoStatus VideoReader::Skip() { return impl_->Skip(); }
void VideoReader::KeepInMemory() { impl_->KeepInMemory(); }
bool VideoReader::ReturnTo(std::size_t frame) { return impl_->ReturnTo(frame); }
bool VideoReader::GoTo(std::int64_t time_ns) { return impl_->GoTo(time_ns); }
void VideoReader::Rewind() { impl_->Rewind(); }

bool HoldsNoFrame(const std::filesystem::path& file) {
  try {
    const VideoReader reader(file);
  } catch (const NoFrame&) {
    return true;
  }
  return false;
}

}  // namespace mocap
