// Beyond the paper: people who stayed in one place while the empty studio was learned.
#pragma once

#include "core/reconstruction/empty_room/empty_room.h"

namespace mocap {

/// Makes unseen whatever somebody who stayed may have hidden.
///
/// Who sits or stands sways, so that the rim of the body and of its clothes' patterns never
/// settles. But what is within does, and would be taken for a wall. So everything between unseen
/// pixels of one place is unseen, and a part below them: feet stand still.
/// @param earlier  what it knows stays as it is; null: nothing is known.
/// @param smallest_px  places with fewer unseen pixels are nobody.
void HideStayedPeople(const EarlierRoom* earlier, int smallest_px, EmptyRoom& room);

}  // namespace mocap
