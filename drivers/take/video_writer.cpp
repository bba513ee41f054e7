#include "drivers/take/video_writer.h"

#include <algorithm>
#include <stdexcept>
#include <string>

#include "core/errors.h"
#include "drivers/take/libav.h"

namespace mocap {
namespace {

/// Storage of each kind of pixels.
struct Storage {
  AVCodecID codec;
  AVPixelFormat format;
  AVColorRange range;
};

// HuffYUV takes twice the space of FFV1 and a quarter of its time. One core can replay six cameras
// of 640 x 480 at 30 Hz. Masks are small in FFV1.
Storage StorageOf(VideoPixels pixels, VideoCodec codec) {
  if (pixels == VideoPixels::kGray) {
    return {AV_CODEC_ID_FFV1, AV_PIX_FMT_GRAY8, AVCOL_RANGE_JPEG};
  }
  switch (codec) {
    case VideoCodec::kHuffYuv:
      return {AV_CODEC_ID_HUFFYUV, AV_PIX_FMT_RGB24, AVCOL_RANGE_UNSPECIFIED};
    case VideoCodec::kFfv1:
      return {AV_CODEC_ID_FFV1, AV_PIX_FMT_BGR0, AVCOL_RANGE_UNSPECIFIED};
    case VideoCodec::kRaw:
      return {AV_CODEC_ID_RAWVIDEO, AV_PIX_FMT_BGR24, AVCOL_RANGE_UNSPECIFIED};
  }
  MOCAP_CHECK(false);
}

CodecPtr OpenEncoder(int width_px, int height_px, double fps, const Storage& storage) {
  const AVCodec* codec = avcodec_find_encoder(storage.codec);
  CodecPtr encoder(avcodec_alloc_context3(codec));
  MOCAP_CHECK(codec && encoder);
  encoder->width = width_px;
  encoder->height = height_px;
  encoder->pix_fmt = storage.format;
  encoder->color_range = storage.range;
  encoder->time_base = av_inv_q(av_d2q(fps, 100000));
  encoder->framerate = av_inv_q(encoder->time_base);
  encoder->gop_size = 1;
  if (storage.codec == AV_CODEC_ID_FFV1) {
    encoder->level = 3;  // The version with slices, which detects damage.
    encoder->slices = 4;
  }
  encoder->thread_count = 1;
  encoder->flags |= AV_CODEC_FLAG_BITEXACT | AV_CODEC_FLAG_GLOBAL_HEADER;
  MOCAP_CHECK(avcodec_open2(encoder.get(), codec, nullptr) >= 0);
  return encoder;
}

void CopyPixels(ImageView<const Bgr> image, AVFrame& frame) {
  const bool is_rgb = frame.format == AV_PIX_FMT_RGB24;
  const bool has_fourth = frame.format == AV_PIX_FMT_BGR0;
  for (int y = 0; y < image.height(); ++y) {
    std::uint8_t* to = frame.data[0] + static_cast<std::ptrdiff_t>(y) * frame.linesize[0];
    for (const Bgr* from = image.row(y); from != image.row(y) + image.width(); ++from) {
      *to++ = is_rgb ? from->r : from->b;
      *to++ = from->g;
      *to++ = is_rgb ? from->b : from->r;
      if (has_fourth) *to++ = 0;
    }
  }
}

void CopyPixels(ImageView<const std::uint8_t> image, AVFrame& frame) {
  for (int y = 0; y < image.height(); ++y) {
    std::copy_n(image.row(y), image.width(),
                frame.data[0] + static_cast<std::ptrdiff_t>(y) * frame.linesize[0]);
  }
}

}  // namespace

class VideoWriter::Impl {
 public:
  Impl(const std::filesystem::path& file, int width_px, int height_px, double fps,
       VideoPixels pixels, VideoCodec codec)
      : file_(file.string()),
        pixels_(pixels),
        frame_(av_frame_alloc()),
        packet_(av_packet_alloc()) {
    MOCAP_CHECK(frame_ && packet_);
    av_log_set_level(AV_LOG_QUIET);
    if (width_px < 1 || height_px < 1 || width_px > 16384 || height_px > 16384 || !(fps > 0)) {
      throw SetupError(file_ + ": cannot be a video of " + std::to_string(width_px) + " x " +
                       std::to_string(height_px) + " pixels");
    }
    encoder_ = OpenEncoder(width_px, height_px, fps, StorageOf(pixels, codec));
    frame_->format = encoder_->pix_fmt;
    frame_->width = width_px;
    frame_->height = height_px;
    MOCAP_CHECK(av_frame_get_buffer(frame_.get(), 0) >= 0);
    OpenOutput();
  }

  template <typename Pixel>
  void Write(ImageView<const Pixel> image) {
    MOCAP_CHECK(output_ && (pixels_ == VideoPixels::kBgr) == (sizeof(Pixel) == sizeof(Bgr)));
    MOCAP_CHECK(image.width() == frame_->width && image.height() == frame_->height);
    Check(av_frame_make_writable(frame_.get()));
    CopyPixels(image, *frame_);
    frame_->pts = count_++;
    Check(avcodec_send_frame(encoder_.get(), frame_.get()));
    WritePackets();
  }

  void Finish() {
    if (!output_) return;
    Check(avcodec_send_frame(encoder_.get(), nullptr));
    WritePackets();
    Check(av_write_trailer(output_.get()));
    avio_flush(output_->pb);
    Check(output_->pb->error);
    output_.reset();
  }

 private:
  void OpenOutput() {
    AVFormatContext* raw = nullptr;
    MOCAP_CHECK(avformat_alloc_output_context2(&raw, nullptr, "matroska", nullptr) >= 0);
    output_.reset(raw);
    output_->flags |= AVFMT_FLAG_BITEXACT | AVFMT_FLAG_FLUSH_PACKETS;
    AVStream* stream = avformat_new_stream(output_.get(), nullptr);
    MOCAP_CHECK(stream);
    stream->time_base = encoder_->time_base;
    stream->avg_frame_rate = encoder_->framerate;
    MOCAP_CHECK(avcodec_parameters_from_context(stream->codecpar, encoder_.get()) >= 0);
    if (avio_open(&output_->pb, ("file:" + file_).c_str(), AVIO_FLAG_WRITE) < 0) {
      throw SetupError(file_ + ": cannot be created");
    }
    AVDictionary* options = nullptr;
    // Matroska stores raw colours only in the way of old Windows programs.
    av_dict_set_int(&options, "allow_raw_vfw", 1, 0);
    const int written = avformat_write_header(output_.get(), &options);
    av_dict_free(&options);
    Check(written);
  }

  void WritePackets() {
    while (true) {
      const int received = avcodec_receive_packet(encoder_.get(), packet_.get());
      if (received == AVERROR(EAGAIN) || received == AVERROR_EOF) return;
      Check(received);
      const AVStream& stream = *output_->streams[0];
      av_packet_rescale_ts(packet_.get(), encoder_->time_base, stream.time_base);
      packet_->stream_index = 0;
      Check(av_write_frame(output_.get(), packet_.get()));
      av_packet_unref(packet_.get());
      // A flush ends the cluster, which would otherwise be held back: one per frame.
      Check(av_write_frame(output_.get(), nullptr));
      Check(output_->pb->error);
    }
  }

  void Check(int result) const {
    if (result < 0) throw std::runtime_error(file_ + ": cannot be written");
  }

  std::string file_;
  VideoPixels pixels_;
  CodecPtr encoder_;
  OutputPtr output_;
  FramePtr frame_;
  PacketPtr packet_;
  std::int64_t count_ = 0;
};

VideoWriter::VideoWriter(const std::filesystem::path& file, int width_px, int height_px, double fps,
                         VideoPixels pixels, VideoCodec codec)
    : impl_(std::make_unique<Impl>(file, width_px, height_px, fps, pixels, codec)) {}
VideoWriter::VideoWriter(VideoWriter&&) noexcept = default;
VideoWriter& VideoWriter::operator=(VideoWriter&&) noexcept = default;

VideoWriter::~VideoWriter() {
  try {
    if (impl_) impl_->Finish();
  } catch (const std::runtime_error&) {
  }
}

void VideoWriter::Write(ImageView<const Bgr> image) { impl_->Write(image); }
void VideoWriter::Write(ImageView<const std::uint8_t> image) { impl_->Write(image); }
void VideoWriter::Finish() { impl_->Finish(); }

}  // namespace mocap
