#include "drivers/take/picture_coder.h"

#include <algorithm>
#include <string>

#include "core/errors.h"
#include "drivers/take/libav.h"

namespace mocap {
namespace {

CodecPtr OpenX264(int width_px, int height_px, double fps, int crf) {
  const AVCodec* codec = avcodec_find_encoder_by_name("libx264");
  if (codec == nullptr) throw SetupError("FFmpeg has no encoder libx264; expected one with x264");
  CodecPtr encoder(avcodec_alloc_context3(codec));
  MOCAP_CHECK(encoder);
  encoder->width = width_px;
  encoder->height = height_px;
  encoder->pix_fmt = AV_PIX_FMT_YUV420P;
  encoder->framerate = av_d2q(fps, 100000);
  encoder->time_base = av_inv_q(encoder->framerate);
  encoder->thread_count = 1;
  encoder->flags |= AV_CODEC_FLAG_BITEXACT;
  AVDictionary* options = nullptr;
  av_dict_set_int(&options, "crf", crf, 0);
  // Its fast code for the macroblock tree gives other results from run to run.
  av_dict_set(&options, "x264-params", "mbtree=0", 0);
  const int opened = avcodec_open2(encoder.get(), codec, &options);
  av_dict_free(&options);
  MOCAP_CHECK(opened >= 0);
  return encoder;
}

CodecPtr OpenH264Decoder() {
  const AVCodec* codec = avcodec_find_decoder(AV_CODEC_ID_H264);
  if (codec == nullptr) throw SetupError("FFmpeg does not decode H.264; expected one that does");
  CodecPtr decoder(avcodec_alloc_context3(codec));
  MOCAP_CHECK(decoder);
  decoder->thread_count = 1;
  MOCAP_CHECK(avcodec_open2(decoder.get(), codec, nullptr) >= 0);
  return decoder;
}

ScalerPtr OpenScaler(int width_px, int height_px, AVPixelFormat from, AVPixelFormat to) {
  // Without these flags, grey values lose one to five by rounding down.
  constexpr int kFlags = SWS_BILINEAR | SWS_ACCURATE_RND | SWS_BITEXACT | SWS_FULL_CHR_H_INT;
  ScalerPtr scaler(sws_getContext(width_px, height_px, from, width_px, height_px, to, kFlags,
                                  nullptr, nullptr, nullptr));
  MOCAP_CHECK(scaler);
  return scaler;
}

FramePtr MakeFrame(int width_px, int height_px, AVPixelFormat format) {
  FramePtr frame(av_frame_alloc());
  MOCAP_CHECK(frame);
  frame->format = format;
  frame->width = width_px;
  frame->height = height_px;
  MOCAP_CHECK(av_frame_get_buffer(frame.get(), 0) >= 0);
  return frame;
}

void Scale(SwsContext* scaler, const AVFrame& from, AVFrame& to) {
  MOCAP_CHECK(sws_scale(scaler, from.data, from.linesize, 0, from.height, to.data, to.linesize) ==
              to.height);
}

}  // namespace

class PictureCoder::Impl {
 public:
  Impl(int width_px, int height_px, double fps, int crf)
      : colors_(MakeFrame(width_px, height_px, AV_PIX_FMT_BGR24)),
        planes_(MakeFrame(width_px, height_px, AV_PIX_FMT_YUV420P)),
        decoded_(av_frame_alloc()),
        packet_(av_packet_alloc()),
        to_planes_(OpenScaler(width_px, height_px, AV_PIX_FMT_BGR24, AV_PIX_FMT_YUV420P)),
        to_colors_(OpenScaler(width_px, height_px, AV_PIX_FMT_YUV420P, AV_PIX_FMT_BGR24)) {
    MOCAP_CHECK(decoded_ && packet_);
    av_log_set_level(AV_LOG_QUIET);
    encoder_ = OpenX264(width_px, height_px, fps, crf);
    decoder_ = OpenH264Decoder();
  }

  void Add(ImageView<const Bgr> picture) {
    MOCAP_CHECK(picture.width() == colors_->width && picture.height() == colors_->height);
    for (int y = 0; y < picture.height(); ++y) std::copy_n(picture.row(y), picture.width(), Row(y));
    MOCAP_CHECK(av_frame_make_writable(planes_.get()) >= 0);
    Scale(to_planes_.get(), *colors_, *planes_);
    planes_->pts = count_++;
    MOCAP_CHECK(avcodec_send_frame(encoder_.get(), planes_.get()) >= 0);
  }

  void Finish() { MOCAP_CHECK(avcodec_send_frame(encoder_.get(), nullptr) >= 0); }

  bool Take(Image<Bgr>& picture) {
    while (avcodec_receive_frame(decoder_.get(), decoded_.get()) < 0) {
      const int coded = avcodec_receive_packet(encoder_.get(), packet_.get());
      if (coded == AVERROR(EAGAIN) || has_ended_) return false;
      has_ended_ = coded == AVERROR_EOF;
      MOCAP_CHECK(coded >= 0 || has_ended_);
      MOCAP_CHECK(avcodec_send_packet(decoder_.get(), has_ended_ ? nullptr : packet_.get()) >= 0);
      av_packet_unref(packet_.get());
    }
    Scale(to_colors_.get(), *decoded_, *colors_);
    if (picture.width() != colors_->width || picture.height() != colors_->height)
      picture = Image<Bgr>(colors_->width, colors_->height);
    for (int y = 0; y < picture.height(); ++y) std::copy_n(Row(y), picture.width(), picture.row(y));
    return true;
  }

 private:
  Bgr* Row(int y) {
    return reinterpret_cast<Bgr*>(colors_->data[0] +
                                  static_cast<std::ptrdiff_t>(y) * colors_->linesize[0]);
  }

  FramePtr colors_, planes_, decoded_;
  PacketPtr packet_;
  ScalerPtr to_planes_, to_colors_;
  CodecPtr encoder_, decoder_;
  std::int64_t count_ = 0;
  bool has_ended_ = false;
};

PictureCoder::PictureCoder(int width_px, int height_px, double fps, int crf)
    : impl_(std::make_unique<Impl>(width_px, height_px, fps, crf)) {}
PictureCoder::PictureCoder(PictureCoder&&) noexcept = default;
PictureCoder& PictureCoder::operator=(PictureCoder&&) noexcept = default;
PictureCoder::~PictureCoder() = default;

void PictureCoder::Add(ImageView<const Bgr> picture) { impl_->Add(picture); }
void PictureCoder::Finish() { impl_->Finish(); }
bool PictureCoder::Take(Image<Bgr>& picture) { return impl_->Take(picture); }

}  // namespace mocap
