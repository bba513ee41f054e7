import assert from 'node:assert/strict';
import test from 'node:test';

import {dashesOf, doubtText, isDoubtful, withDoubt} from '../../../../tools/view/page/doubt.js';

test('a pose is in doubt at odds below 19 to 1, and where nothing is known it is not', () => {
  assert.deepEqual(
      [0, 0.5, 0.9499, 0.95, 1, NaN].map((probability) => isDoubtful({probability})),
      [true, true, true, false, false, false]);
  assert.equal(isDoubtful({}), false);
});

test('doubt is told in whole per cent, and none of it is rounded away', () => {
  const text = (probability) => doubtText({probability});
  assert.equal(text(Math.fround(0.6)), '60\u00a0%\u00a0sure');
  assert.equal(text(0.9499), '94\u00a0%\u00a0sure');
  assert.deepEqual([text(0.96), text(NaN)], ['', '']);
});

test('a label keeps its name beside the doubt', () => {
  assert.equal(withDoubt('anna', {probability: 0.6}), 'anna (60\u00a0%\u00a0sure)');
  assert.equal(withDoubt('anna', {probability: 1}), 'anna');
  assert.equal(withDoubt('', {probability: 0.6}), '60\u00a0%\u00a0sure');
  assert.equal(withDoubt('', {probability: 1}), '');
});

test('a dashed line begins at one point and ends at the other, with gaps alike', () => {
  const dashes = dashesOf([0, 0, 100], [300, 400, 100]);
  assert.equal(dashes.length, 7);
  assert.deepEqual(dashes[0][0], [0, 0, 100]);
  dashes.at(-1)[1].forEach(
      (value, axis) => assert.ok(Math.abs(value - [300, 400, 100][axis]) < 1e-9));
  for (let i = 1; i < dashes.length; ++i) {
    const gap = Math.hypot(...dashes[i][0].map((value, axis) => value - dashes[i - 1][1][axis]));
    assert.ok(Math.abs(gap - 35) < 1e-9);
  }
});

test('a line too short for two dashes is one, and a point is one without a length', () => {
  assert.deepEqual(dashesOf([0, 0, 0], [30, 0, 0]), [[[0, 0, 0], [30, 0, 0]]]);
  assert.deepEqual(dashesOf([1, 2, 3], [1, 2, 3]), [[[1, 2, 3], [1, 2, 3]]]);
});
