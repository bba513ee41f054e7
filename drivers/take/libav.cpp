#include "drivers/take/libav.h"

#include <string>
#include <system_error>

#include "core/errors.h"
#include "drivers/take/input_file.h"

namespace mocap {

InputPtr OpenInput(const std::filesystem::path& file) {
  RequireFile(file, "a video file");
  std::error_code error;
  if (std::filesystem::file_size(file, error) == 0 && !error)
    throw SetupError(file.string() + ": is empty; expected a video file");
  AVFormatContext* raw = nullptr;
  AVDictionary* options = nullptr;
  // Without a whitelist, a disguised playlist could access the network.
  av_dict_set(&options, "protocol_whitelist", "file", 0);
  const int result =
      avformat_open_input(&raw, ("file:" + file.string()).c_str(), nullptr, &options);
  av_dict_free(&options);
  if (result < 0)
    throw SetupError(
        file.string() +
        ": is not a video that FFmpeg knows; expected a video file, such as Matroska or MP4");
  InputPtr input(raw);
  input->flags |= AVFMT_FLAG_DISCARD_CORRUPT;
  return input;
}

}  // namespace mocap
