import './fake_page.mjs';

import assert from 'node:assert/strict';
import test from 'node:test';

const {drawKeypoints, strengthAt} = await import('../../../../tools/view/page/keypoints.js');
const [SHOULDER_L, ELBOW_L, BIG_TOE_L] = [9, 11, 28];

/** Draws views over a picture of a time. @return the calls, each with its opacity. */
function drawn(views, timeMs = 1000) {
  const calls = [];
  const context = {save() {}, restore() {}, beginPath() {}, stroke() {}, fill() {}};
  for (const name of ['moveTo', 'lineTo', 'arc'])
    context[name] = (x, y) => calls.push({name, x, y, opacity: context.globalAlpha});
  drawKeypoints(context, {keypoints: views, timeMs}, 1);
  return calls;
}

function view(points, timeMs = 1000) {
  return {timeMs, points: Float32Array.from(points)};
}

test('points are joined where the body joins them', () => {
  const calls = drawn([view([SHOULDER_L, 1, 2, 1, ELBOW_L, 3, 4, 1, BIG_TOE_L, 50, 60, 1])]);
  const ends = calls.filter(({name}) => name !== 'arc').map(({name, x, y}) => [name, x, y]);
  const bone = [['moveTo', 1.5, 2.5], ['lineTo', 3.5, 4.5]];
  assert.deepEqual(ends, [...bone, ...bone], 'the border first');
  assert.equal(calls.filter(({name}) => name === 'arc').length, 6);
});

test('points and lines with a low score are faint, and seen nevertheless', () => {
  const calls = drawn([view([SHOULDER_L, 1, 2, 1, ELBOW_L, 3, 4, 0.5, BIG_TOE_L, 50, 60, 0])]);
  assert.equal(calls.find(({name}) => name === 'lineTo').opacity, 0.5);
  assert.deepEqual(
      calls.filter(({name}) => name === 'arc').slice(0, 3).map(({opacity}) => opacity),
      [1, 0.5, 0.15]);
});

test('keypoints fade out over a second, and later ones are drawn in full', () => {
  assert.deepEqual(
      [900, 1000, 1250, 2000, 9000].map((timeMs) => strengthAt(view([]), timeMs)),
      [1, 1, 0.75, 0, 0]);
  assert.equal(drawn([view([SHOULDER_L, 1, 2, 1])], 1250)[0].opacity, 0.75);
  assert.equal(drawn([view([SHOULDER_L, 1, 2, 1])], 2000).length, 0);
});
