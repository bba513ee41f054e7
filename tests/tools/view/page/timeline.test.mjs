import assert from 'node:assert/strict';
import test from 'node:test';

import {columnsOf, frameAt, meanOf, niceTop, PlayHead, quantileOf, runsOf} from '../../../../tools/view/page/timeline.js';

const TIMES = [1000, 1033, 1066, 1100, 1300];

test('a frame is shown from its time to that of the next', () => {
  assert.deepEqual(
      [0, 1000, 1032, 1033, 1250, 9999].map((t) => frameAt(TIMES, t)), [0, 0, 0, 1, 3, 4]);
});

test('playing passes through time at its speed and stops at the end', () => {
  const head = new PlayHead(TIMES);
  head.toggle();
  head.speed = 0.5;
  head.advance(100);
  assert.equal(head.frame, 1);
  assert.ok(head.share > 0.5);
  head.advance(10000);
  assert.equal(head.frame, 4);
  assert.equal(head.share, 0);
  assert.equal(head.playing, false);
  head.toggle();
  assert.equal(head.frame, 0, 'from the end it starts anew');
});

test('a pause stops at a whole frame, so that pictures and pose are of one', () => {
  const head = new PlayHead(TIMES);
  head.toggle();
  head.advance(80);
  head.toggle();
  assert.equal(head.playing, false);
  assert.equal(head.timeMs, 1066);
});

test('a step stops and goes to a whole frame', () => {
  const head = new PlayHead(TIMES);
  head.toggle();
  head.advance(50);
  head.step(1);
  assert.equal(head.playing, false);
  assert.equal(head.timeMs, 1066);
  head.step(-10);
  assert.equal(head.frame, 0);
  head.step(99);
  assert.equal(head.frame, 4);
});

test('speed goes up and down within its steps', () => {
  const head = new PlayHead(TIMES);
  head.changeSpeed(1);
  assert.equal(head.speed, 2);
  for (let i = 0; i < 9; ++i) head.changeSpeed(-1);
  assert.equal(head.speed, 0.1);
});

test('a take of one frame, or none, plays nothing', () => {
  for (const times of [[], [5]]) {
    const head = new PlayHead(times);
    head.toggle();
    assert.equal(head.playing, false);
    assert.equal(head.share, 0);
  }
});

test('states are merged into runs', () => {
  assert.deepEqual(
      runsOf([0, 0, 2, 2, 2, 3]),
      [{value: 0, from: 0, to: 2}, {value: 2, from: 2, to: 5}, {value: 3, from: 5, to: 6}]);
  assert.deepEqual(runsOf([]), []);
});

test('a peak of one frame survives in its column', () => {
  const values = new Array(10000).fill(1);
  values[5432] = 99;
  values.fill(null, 0, 2000);
  const columns = columnsOf(values, 100);
  assert.deepEqual(columns[54], {low: 1, high: 99});
  assert.equal(columns[10], null);
});

test('axes end at 1, 2 or 5 times a power of ten', () => {
  assert.deepEqual([0, 0.3, 1, 1.2, 23, 50, 51, NaN].map(niceTop), [1, 0.5, 1, 2, 50, 50, 100, 1]);
});

test('means and quantiles leave out what is missing', () => {
  assert.equal(meanOf([1, null, NaN, 3]), 2);
  assert.equal(meanOf([null]), null);
  assert.equal(quantileOf([5, null, 1, 3], 0.5), 3);
});
