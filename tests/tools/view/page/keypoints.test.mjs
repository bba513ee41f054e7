import assert from 'node:assert/strict';
import test from 'node:test';

import {FakeElement} from './fake_page.mjs';

const {drawKeypoints, strengthAt} = await import('../../../../tools/view/page/keypoints.js');
const [SHOULDER_L, ELBOW_L, WRIST_L] = [9, 11, 13];

/** Draws views over a picture of a time. @return calls, with the alpha of each. */
function drawn(views, timeMs = 1000) {
  const calls = [];
  const context = new Proxy({}, {
    get: (_, name) => (...values) => calls.push({name, values, alpha: context.alpha}),
    set: (target, name, value) => {
      if (name === 'globalAlpha') Object.defineProperty(target, 'alpha', {value, writable: true});
      return true;
    },
  });
  drawKeypoints(context, {keypoints: views, timeMs}, 1);
  return calls;
}

function view(points, timeMs = 1000) {
  return {timeMs, points: Float32Array.from(points)};
}

test('points are joined where the body joins them', () => {
  const calls = drawn([
                  view([SHOULDER_L, 1, 2, 1, ELBOW_L, 3, 4, 1, 30, 50, 60, 1])
                ]).map(({name, values}) => [name, ...values.slice(0, 2)]);
  const ends = calls.filter(([name]) => name === 'moveTo' || name === 'lineTo');
  assert.deepEqual(ends.slice(0, 2), [['moveTo', 1.5, 2.5], ['lineTo', 3.5, 4.5]]);
  assert.equal(ends.length, 4, 'the line and its border');
  assert.equal(calls.filter(([name]) => name === 'arc').length, 6);
});

test('keypoints fade out over a second, and later ones are drawn at once', () => {
  assert.deepEqual(
      [900, 1000, 1250, 2000, 9000].map((timeMs) => strengthAt(view([]), timeMs)),
      [1, 1, 0.75, 0, 0]);
  assert.ok(drawn([view([SHOULDER_L, 1, 2, 1])], 2000).every(({name}) => name !== 'arc'));
});
