#include "tools/calibrate_board.h"

#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>

#include "drivers/printable_text.h"
#include "tools/calibration/board_print.h"

namespace mocap {
namespace {

struct BoardArguments {
  std::string board, page;
  std::filesystem::path out;
};

void PrintBoard(const BoardArguments& a) {
  const Board board = ParseBoard(a.board);
  WriteBoardPdf(a.out, board, a.page.empty() ? Vector2::Zero() : ParsePage(a.page));
  std::printf("%s: %s; print it at 100 %% and glue it to a flat plate\n",
              Printable(a.out.string()).c_str(), board.Text().c_str());
}

}  // namespace

void AddPrintedBoard(CLI::App* parent) {
  const auto a = std::make_shared<BoardArguments>();
  CLI::App* command = parent->add_subcommand("board", "Write a board as a PDF, to print it");
  command->add_option("--board", a->board, "board, as for mocap calibrate studio")->required();
  command->add_option("--page", a->page,
                      "page: a0 to a5, or WIDTHxHEIGHT in mm (default: as large as the board)");
  command->add_option("--out", a->out, "output PDF file")->required();
  command->callback([a] { PrintBoard(*a); });
}

}  // namespace mocap
