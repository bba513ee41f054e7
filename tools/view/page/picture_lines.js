// Lines over a camera's picture: the trimap, and bodies.

import {color, figureColor} from './theme.js';

const SIDES = ['side-middle', 'side-left', 'side-right'];

const HATCH_PX = 5;

function addPath(context, points, isClosed) {
  for (let i = 0; i + 1 < points.length; i += 2) {
    // Pixel centres are integers; a canvas counts from the corner.
    const place = [points[i] + 0.5, points[i + 1] + 0.5];
    if (i === 0)
      context.moveTo(...place);
    else
      context.lineTo(...place);
  }
  if (isClosed) context.closePath();
}

/** Hatches unknown pixels. People have an outline: the two differ without colours, too. */
function hatch(context, {unknown, widthPx, heightPx}, scale) {
  if (unknown.length === 0) return;
  context.save();
  context.beginPath();
  for (const line of unknown) addPath(context, line.points, true);
  context.clip('evenodd');
  context.beginPath();
  for (let x = -heightPx; x < widthPx; x += HATCH_PX / scale) {
    context.moveTo(x, heightPx);
    context.lineTo(x + heightPx, 0);
  }
  context.strokeStyle = color('unknown');
  context.lineWidth = 1.5 / scale;
  context.stroke();
  context.restore();
}

function strokeLine(context, line, isClosed, style, widthPx) {
  context.beginPath();
  addPath(context, line.points, isClosed);
  context.lineJoin = 'round';
  context.lineCap = 'round';
  context.strokeStyle = style;
  context.lineWidth = widthPx;
  context.stroke();
}

/** Draws the border of people, and hatches what is unknown. */
export function drawTrimap(context, picture, scale) {
  hatch(context, picture, scale);
  for (const line of picture.silhouette)
    strokeLine(context, line, true, color('silhouette'), 1.3 / scale);
}

/** Draws lines in the camera's picture on a canvas of any size. */
export function drawLines(context, picture, width, height) {
  const scale = width / picture.widthPx;
  context.save();
  context.scale(scale, height / picture.heightPx);
  drawTrimap(context, picture, scale);
  const stroke = (line, style, widthPx) =>
      strokeLine(context, line, line.points.length > 4, style, widthPx / scale);
  for (const line of picture.body) stroke(line, 'rgba(0, 0, 0, 0.55)', 3.4);
  for (const line of picture.body) {
    // With several people, the colour shows the person, not the side.
    const name = line.person === null ? SIDES[line.side] ?? SIDES[0] : figureColor(line.person);
    stroke(line, color(name), 1.8);
  }
  context.restore();
}
