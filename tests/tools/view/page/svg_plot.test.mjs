import assert from 'node:assert/strict';
import test from 'node:test';

import './fake_page.mjs';

const {roundTicks, svgPlot} = await import('../../../../tools/view/page/svg_plot.js');
// Leaves 100 by 100 pixels between the axes, from x = 58 on.
const WIDTH = 172;

function plot(series, more = {}) {
  const range = [0, 10];
  const whole = {label: '', figure: 0, mark: 'line', ...series};
  return svgPlot(
      {x: {label: 'x [m]', range}, y: {label: 'y', range}, height: 100, series: [whole], ...more},
      WIDTH);
}

function named(svg, tag, name) {
  return svg.all(tag).filter(({attributes}) => attributes.class === name);
}

const numbersOf = (path) => path.attributes.d;
const textsOf = (svg) => svg.all('text').map(({text}) => text);

test('ticks are round numbers inside the range', () => {
  assert.deepEqual(roundTicks([0, 119], 8), [0, 20, 40, 60, 80, 100]);
  assert.deepEqual(roundTicks([-0.31, 0.29], 4), [-0.2, 0, 0.2]);
  assert.deepEqual(roundTicks([1230, 1270], 5), [1230, 1240, 1250, 1260, 1270]);
  assert.deepEqual(roundTicks([5, 5], 4), [5], 'a range of nothing');
});

test('points are where the scales say', () => {
  const dots = named(plot({mark: 'dots', x: [0, 5], y: [0, 10]}), 'circle', 'dot');
  const places = dots.map(({attributes: {cx, cy}}) => [cx, cy]);
  assert.deepEqual(places, [['58', '106'], ['108', '6']]);
});

test('a line breaks where a value is missing, and no number is NaN', () => {
  const svg = plot({x: [0, 1, 2, 3, 4], y: [0, 1, null, 3, 4]});
  assert.equal(numbersOf(named(svg, 'path', 'line')[0]), 'M58 106L68 96M88 76L98 66');
  assert.ok(svg.all('path').every((path) => !numbersOf(path).includes('NaN')));
});

test('curves over frames begin at the first, or have the numbers of theirs', () => {
  const axis = {label: 'frame', range: [0, 10]};
  const drawn = (x) =>
      numbersOf(named(plot({y: [0, 10]}, {x: {...axis, ...x}}), 'path', 'line')[0]);
  assert.equal(drawn({first: 5}), 'M108 106L118 6');
  assert.equal(drawn({values: [5, 9]}), 'M108 106L148 6');
});

test('a plan has one scale, and a picture its y downwards', () => {
  const range = [0, 10];
  const points = {mark: 'dots', x: [0, 1], y: [0, 1]};
  const places = (more) => named(plot(points, {equal: true, ...more}), 'circle', 'dot')
                               .map(({attributes: {cx, cy}}) => [Number(cx), Number(cy)]);
  const [a, b] = places({height: 200});
  assert.equal(b[0] - a[0], a[1] - b[1]);
  const [above, below] = places({y: {label: 'y', range: [10, 0]}, x: {label: 'x', range}});
  assert.ok(above[1] < below[1]);
});

test('what is not tracked is shaded, and cells are drawn where they are', () => {
  const x = {label: 'frame', first: 0, range: [0, 10]};
  const shaded = plot({y: [1, null, null, 4, 5]}, {x, shade: true});
  const [{attributes}] = named(shaded, 'rect', 'shade');
  assert.deepEqual([attributes.x, attributes.width], ['63', '20']);
  const cells = {low: [0, 0], size: [5, 5], columns: 2, values: [0, 0, 0, 0.5]};
  const [cell, ...others] = named(plot({x: [], y: []}, {cells}), 'rect', 'cell');
  assert.deepEqual(others, []);
  const {x: left, y: top, width, 'fill-opacity': opacity} = cell.attributes;
  assert.deepEqual([left, top, width, opacity], ['108', '6', '50', '0.5']);
});

test('a legend that is too wide goes on in the next row', () => {
  const series = ['a long name of a camera', 'another'].map(
      (label, figure) => ({label, figure, mark: 'line', x: [0], y: [0]}));
  const svg = plot({}, {series});
  const rows = svg.all('text').filter(({text}) => series.some(({label}) => label === text));
  assert.deepEqual(rows.map(({attributes: {y}}) => y), ['12', '30']);
});

test('axes tell their units, names stand instead of numbers, and points have theirs', () => {
  const svg = plot(
      {mark: 'rings', x: [0], y: [3], names: ['<cam1>']},
      {x: {label: 'part', names: ['head', 'foot'], range: [-1, 2]}});
  for (const text of ['part', 'y', 'head', 'foot', '<cam1>']) assert.ok(textsOf(svg).includes(text));
});

test('the pointer reads the values at its place', () => {
  const svg = plot({label: 'error', y: [1, 2, null]}, {x: {label: 'frame', first: 4, range: [0, 10]}});
  const point = (name, offsetX) => svg.dispatchEvent(Object.assign(new Event(name), {offsetX}));
  point('pointermove', 109);
  assert.ok(textsOf(svg).includes('frame 5 · error 2.00'));
  point('pointerleave');
  assert.ok(!textsOf(svg).some((text) => text.startsWith('frame 5')));
});

test('outlines have no value under the pointer', () => {
  const series = [
    {label: 'mean', figure: 0, mark: 'line', y: [1, 2]},
    {label: '', figure: 0, mark: 'area', x: [0, 1, 1, 0], y: [7, 8, 3, 4]}
  ];
  const svg = svgPlot({x: {label: '%', first: 0}, y: {label: ''}, height: 100, series}, WIDTH);
  svg.dispatchEvent(Object.assign(new Event('pointermove'), {offsetX: 158}));
  assert.ok(textsOf(svg).includes('% 1 · mean 2.00'));
});

test('an empty plot is drawn, too', () => {
  const svg = svgPlot({x: {label: 'x'}, y: {label: 'y'}, series: []}, WIDTH);
  assert.equal(named(svg, 'path', 'axis').length, 1);
});
