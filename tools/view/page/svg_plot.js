// A plot from JSON, as a drawing: sharp on paper, and in the colours of the page.
//
// plot: {x, y: {label, range?, names?}, series, height?, equal?, shade?, cells?}
//   x.first, x.values: the series have a value for each of first, first + 1, …, or of the values.
//   names: of 0, 1, …: instead of numbers. equal: both axes have one scale.
//   shade: darken where the first series has no value.
//   cells: {low: [x, y], size: [width, height], columns, values}: squares; 0 to 1, row by row
// series: {label?, figure, mark, x?, y, names?}; null in y is a gap. `mark` is a key of MARKS.

import {makeSvg} from './dom.js';
import {fixed} from './text.js';
import {figureColor} from './theme.js';
import {runsOf} from './timeline.js';

const LEFT = 58;
const RIGHT = 14;
const BOTTOM = 46;
const ROW = 18;          // height of a row of the legend
const CHARACTER = 6.6;   // mean width
const KEY = 44;          // a legend's mark, and the space to the next
const EVERY_X = 80;      // pixels between ticks
const EVERY_Y = 36;
const TICK_DIGITS = 6;

const MARKS = {
  line: (points) => [path(lineThrough(points), 'line')],
  dashed: (points) => [path(lineThrough(points), 'line dashed')],
  area: (points) => [path(`${lineThrough(points)}Z`, 'area')],
  dots: (points) => points.map(([x, y]) => circle(x, y, 4, 'dot')),
  rings: (points) => points.map(([x, y]) => circle(x, y, 5.5, 'ring')),
  crosses: (points) =>
      points.map(([x, y]) => path(`M${px(x - 4)} ${px(y - 4)}l8 8m-8 0l8 -8`, 'line')),
};

const px = (value) => fixed(value, 1).replace('.0', '');
const path = (d, name) => makeSvg('path', {d, class: name});
const circle = (x, y, r, name) => makeSvg('circle', {cx: px(x), cy: px(y), r, class: name});
const isPoint = ([x, y]) => Number.isFinite(x) && Number.isFinite(y);

function label(text, x, y, anchor, more = {}) {
  return makeSvg('text', {x: px(x), y: px(y), 'text-anchor': anchor, text, ...more});
}

function lineThrough(points) {
  return points
      .map(
          (point, i) => !isPoint(point) ?
              '' :
              `${i > 0 && isPoint(points[i - 1]) ? 'L' : 'M'}${px(point[0])} ${px(point[1])}`)
      .join('');
}

/** @return round numbers of a range, about `count`. */
export function roundTicks([low, high], count) {
  const raw = (high - low) / Math.max(1, count);
  if (!(raw > 0)) return [low];
  const power = 10 ** Math.floor(Math.log10(raw));
  const step = power * [1, 2, 5, 10].find((one) => raw / power < one * 1.42);
  const ticks = [];
  for (let i = Math.ceil(low / step - 1e-9); i * step <= high + 1e-9 * step; ++i)
    ticks.push(Number((i * step).toPrecision(TICK_DIGITS)));
  return ticks;
}

/** @return the place of a value that has no x of its own. */
export const placeOf = (x, i) => x.values ? x.values[i] ?? NaN : x.first + i;

function pointsOf(plot, series) {
  return series.y.map((y, i) => [(series.x ? series.x[i] : placeOf(plot.x, i)) ?? NaN, y ?? NaN]);
}

function rangeOf(points, margin) {
  const values = points.filter(Number.isFinite);
  if (values.length === 0) return [0, 1];
  const low = values.reduce((a, b) => Math.min(a, b));
  const high = values.reduce((a, b) => Math.max(a, b));
  const air = low === high ? 0.5 : margin * (high - low);
  return [low - air, high + air];
}

/** Widens a range around its middle. */
function widened([low, high], factor) {
  const half = (high - low) / 2 * Math.max(1, factor);
  return [(low + high) / 2 - half, (low + high) / 2 + half];
}

/** Where the marks of the legend begin, in rows that fit. */
function legendPlaces(labels, width) {
  let [x, row] = [LEFT, 0];
  return labels.map((text) => {
    const needed = KEY + CHARACTER * text.length;
    if (x > LEFT && x + needed > width) [x, row] = [LEFT, row + 1];
    x += needed;
    return [x - needed, row];
  });
}

/** Scales of a plot: from its numbers to pixels. */
class Scales {
  constructor(plot, width, top) {
    this.left = LEFT;
    this.top = top;
    this.right = width - RIGHT;
    this.bottom = top + (plot.height ?? this.planHeight(plot) ?? 200);
    const points = plot.series.flatMap((series) => pointsOf(plot, series));
    const margin = plot.equal ? 0.05 : 0;
    this.xs = plot.x.range ?? rangeOf(points.map(([x]) => x), margin);
    this.ys = plot.y.range ?? rangeOf(points.map(([, y]) => y), 0.06);
    if (!plot.equal) return;
    const unit = ([low, high], length) => Math.abs(high - low) / length;
    const units = [unit(this.xs, this.right - this.left), unit(this.ys, this.bottom - top)];
    this.xs = widened(this.xs, units[1] / units[0]);
    this.ys = widened(this.ys, units[0] / units[1]);
  }

  /** A plan whose ranges are given fills its height. */
  planHeight({equal, x, y}) {
    if (!equal || !x.range || !y.range) return undefined;
    const [across, along] = [x, y].map(({range}) => Math.abs(range[1] - range[0]));
    return Math.round((this.right - this.left) * along / across);
  }

  x(value) {
    return this.left + (value - this.xs[0]) / (this.xs[1] - this.xs[0]) * (this.right - this.left);
  }

  y(value) {
    return this.bottom - (value - this.ys[0]) / (this.ys[1] - this.ys[0]) * (this.bottom - this.top);
  }
}

/** Ticks of an axis: [value, text]. */
function ticksOf({names}, [from, to], count) {
  if (names) return names.map((name, i) => [i, name]);
  return roundTicks([Math.min(from, to), Math.max(from, to)], count)
      .map((value) => [value, `${value}`.replace('-', '−')]);
}

function gridOf(plot, at) {
  const every = plot.equal ? EVERY_X : EVERY_Y;
  const lines = ticksOf(plot.y, at.ys, (at.bottom - at.top) / every).flatMap(([value, text]) => [
    path(`M${at.left} ${px(at.y(value))}H${at.right}`, 'grid'),
    label(text, at.left - 7, at.y(value) + 4, 'end')
  ]);
  const ticks = ticksOf(plot.x, at.xs, (at.right - at.left) / EVERY_X);
  const room = (at.right - at.left) / ticks.length;
  const isTight = ticks.some(([, text]) => CHARACTER * text.length > room);
  return lines.concat(ticks.flatMap(([value, text], i) => [
    path(`M${px(at.x(value))} ${at.top}V${at.bottom}`, 'grid'),
    label(text, at.x(value), at.bottom + (isTight && i % 2 === 1 ? 26 : 15), 'middle')
  ]));
}

function box(at, [x0, y0], [x1, y1], more) {
  const [left, right] = [at.x(x0), at.x(x1)].sort((a, b) => a - b);
  const [top, bottom] = [at.y(y0), at.y(y1)].sort((a, b) => a - b);
  const size = {x: px(left), y: px(top), width: px(right - left), height: px(bottom - top)};
  return makeSvg('rect', {...size, ...more});
}

function shadesOf(plot, at) {
  if (!plot.shade) return [];
  return runsOf(plot.series[0].y.map((value) => value === null))
      .filter(({value}) => value)
      .map(({from, to}) => [placeOf(plot.x, from) - 0.5, placeOf(plot.x, to - 1) + 0.5])
      .map(([from, to]) => [Math.max(from, at.xs[0]), Math.min(to, at.xs[1])])
      .map(([from, to]) => box(at, [from, at.ys[0]], [to, at.ys[1]], {class: 'shade'}));
}

function cellsOf({low, size, columns, values}, at) {
  return values.flatMap((value, i) => {
    if (value <= 0) return [];
    const [x, y] = [i % columns, Math.floor(i / columns)].map((k, axis) => low[axis] + k * size[axis]);
    return [box(at, [x, y], [x + size[0], y + size[1]], {class: 'cell', 'fill-opacity': value})];
  });
}

function drawnSeries(plot, series, at) {
  const points = pointsOf(plot, series).map(([x, y]) => [at.x(x), at.y(y)]);
  const isLine = ['line', 'dashed', 'area'].includes(series.mark);
  const names = (series.names ?? []).map((text, i) => label(text, points[i][0], points[i][1] - 9, 'middle'));
  return makeSvg(
      'g', {class: figureColor(series.figure)},
      ...MARKS[series.mark](isLine ? points : points.filter(isPoint)), ...names);
}

function legendOf(labelled, places) {
  return labelled.map((series, i) => {
    const [x, row] = places[i];
    const y = 8 + ROW * row;
    const isLine = ['line', 'dashed', 'area'].includes(series.mark);
    const points = isLine ? [[x, y], [x + 18, y]] : [[x + 9, y]];
    return makeSvg(
        'g', {class: figureColor(series.figure)},
        ...MARKS[series.mark === 'area' ? 'line' : series.mark](points),
        label(series.label, x + 24, y + 4, 'start'));
  });
}

/** Shows the values under the pointer in place of the axis' label. */
function addReading(svg, plot, at, text) {
  const ruler = svg.appendChild(path('', 'ruler'));
  const tell = (reading, d = '') => {
    text.textContent = reading;
    ruler.setAttribute('d', d);
  };
  svg.addEventListener('pointerleave', () => tell(plot.x.label));
  const places = plot.series[0]?.y.map((_, i) => at.x(placeOf(plot.x, i))) ?? [];
  svg.addEventListener('pointermove', ({offsetX}) => {
    const distance = (i) => Math.abs(places[i] - offsetX);
    const i = places.reduce((best, _, k) => distance(k) < distance(best) ? k : best, 0);
    if (!(distance(i) < EVERY_X)) return tell(plot.x.label);
    const values = plot.series.filter(({x, y}) => !x && Number.isFinite(y[i]))
                       .map((series) => `${series.label} ${fixed(series.y[i], 2)}`.trim());
    const place = `${plot.x.label} ${placeOf(plot.x, i)}`;
    return tell([place, ...values].join(' · '), `M${px(places[i])} ${at.top}V${at.bottom}`);
  });
}

/** Draws a plot of a width in pixels. @return the <svg>. */
export function svgPlot(plot, width) {
  const labelled = plot.series.filter((series) => series.label);
  const places = legendPlaces(labelled.map((series) => series.label), width);
  const at = new Scales(plot, width, 6 + ROW * ((places.at(-1)?.[1] ?? -1) + 1));
  const middle = (at.top + at.bottom) / 2;
  const xLabel = label(plot.x.label, (at.left + at.right) / 2, at.bottom + 40, 'middle', {class: 'label'});
  const yLabel = label(
      plot.y.label, 0, 0, 'middle',
      {class: 'label', transform: `translate(14 ${middle}) rotate(-90)`});
  const svg = makeSvg(
      'svg',
      {
        class: 'plot',
        viewBox: `0 0 ${width} ${at.bottom + BOTTOM}`,
        role: 'img',
        'aria-label': `${plot.y.label} over ${plot.x.label}`
      },
      ...plot.cells ? cellsOf(plot.cells, at) : [], ...shadesOf(plot, at), ...gridOf(plot, at),
      ...plot.series.map((series) => drawnSeries(plot, series, at)),
      path(`M${at.left} ${at.top}V${at.bottom}H${at.right}`, 'axis'), xLabel, yLabel,
      ...legendOf(labelled, places));
  if (plot.x.values || plot.x.first !== undefined) addReading(svg, plot, at, xLabel);
  return svg;
}
