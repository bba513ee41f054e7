import assert from 'node:assert/strict';
import test from 'node:test';

import {freshElement} from './fake_page.mjs';

const {LatencyPlot} = await import('../../../../tools/view/page/latency_plot.js');

function open() {
  const page = {};
  for (const id of ['latency-plot', 'latency-p50', 'latency-p99', 'stages'])
    page[id] = freshElement(id);
  return {plot: new LatencyPlot(), page};
}

function stage(name, p50, p99, count = 30) {
  return {name, count, p50_ms: p50, p99_ms: p99};
}

function textsOf(page) {
  return page.stages.all('tr').map((row) => row.children.map((cell) => cell.textContent));
}

/** @return the points of the curve that was drawn last. */
function lastCurve({context: {calls}}) {
  const begin = calls.findLastIndex(([name]) => name === 'stroke');
  const from = calls.findLastIndex(([name], i) => name === 'beginPath' && i < begin);
  return calls.slice(from, begin).filter(([name]) => name === 'moveTo' || name === 'lineTo');
}

test('the total is told in numbers, and each stage in a row', () => {
  const {plot, page} = open();
  plot.take([stage('latency', 7.25, 12.5), stage('carve', 0.42, 1.34), stage('decode', 1, 1)]);
  plot.take([stage('latency', 8, 13), stage('carve', 0.5, 1.5)]);
  assert.equal(page['latency-p50'].textContent, '8.0');
  assert.equal(page['latency-p99'].textContent, '13.0');
  assert.deepEqual(textsOf(page), [['carve', '', '0.5', '1.5']]);
});

test('a second without sets is a gap, not a zero', () => {
  const {plot, page} = open();
  plot.take([stage('latency', 4, 6)]);
  plot.take([stage('latency', 0, 0, 0)]);
  assert.equal(page['latency-p50'].textContent, '–');
  plot.take([stage('latency', 5, 6)]);
  assert.deepEqual(
      lastCurve(page['latency-plot']).map(([name]) => name), ['moveTo', 'moveTo'],
      'the gap is not bridged');
});

test('two minutes are kept, the newest at the right', () => {
  const {plot, page} = open();
  for (let i = 0; i < 300; ++i) plot.take([stage('latency', 4, 6)]);
  assert.equal(plot.series.get('latency').length, 120);
  const curve = lastCurve(page['latency-plot']);
  assert.equal(curve.length, 120);
  assert.equal(curve.at(-1)[1], page['latency-plot'].clientWidth);
});

test('the axis grows with the slowest percentile', () => {
  const {plot, page} = open();
  const labels = () => page['latency-plot'].context.calls.filter(([name]) => name === 'fillText');
  plot.take([stage('latency', 4, 6)]);
  assert.ok(labels().some(([, text]) => text === '10'));
  plot.take([stage('latency', 4, 33)]);
  assert.ok(labels().some(([, text]) => text === '50'));
});

test('names that a stranger sends do not pile up', () => {
  const {plot} = open();
  for (let i = 0; i < 1000; ++i) plot.take([stage(`stage ${i}`, 1, 1)]);
  assert.ok(plot.series.size < 40);
});
