import assert from 'node:assert/strict';
import test from 'node:test';

import {interpolate, PoseHistory} from '../../../../tools/view/page/pose_history.js';

function pose(timeMs, x, more = {}) {
  return {
    timeMs,
    frame: timeMs / 10,
    hasPose: true,
    state: 'tracking',
    points: new Float32Array([x, 0, 0]),
    capsules: new Float32Array(8).fill(x),
    contacts: new Float32Array(16).fill(x),
    ...more
  };
}

function historyOf(...poses) {
  const history = new PoseHistory();
  for (const one of poses) history.add(one);
  return history;
}

test('between two poses the pose is on the straight line', () => {
  const shown = historyOf(pose(100, 0), pose(110, 10)).at(104);
  assert.equal(shown.timeMs, 104);
  assert.ok(Math.abs(shown.points[0] - 4) < 1e-6);
  assert.ok(Math.abs(shown.capsules[3] - 4) < 1e-6);
  assert.ok(Math.abs(shown.frame - 10.4) < 1e-9);
});

test('a rival moves along as the pose does, and comes and goes with a pose', () => {
  const rival = (x) => ({probability: 0.3, points: new Float32Array([x, 0, 0])});
  const both = historyOf(pose(100, 0, {rival: rival(0)}), pose(110, 10, {rival: rival(20)}));
  assert.ok(Math.abs(both.at(104).rival.points[0] - 8) < 1e-5);
  const first = historyOf(pose(100, 0, {rival: rival(5)}), pose(110, 10, {rival: null}));
  assert.equal(first.at(104).rival.points[0], 5);
  assert.equal(first.at(110).rival, null);
});

test('outside of what is known the nearest pose is shown as it was received', () => {
  const history = historyOf(pose(100, 1), pose(110, 2));
  assert.equal(history.at(50).points[0], 1);
  assert.equal(history.at(500).timeMs, 110);
  assert.equal(new PoseHistory().at(0), null);
});

test('nothing is invented across a gap, or between a pose and none', () => {
  assert.equal(historyOf(pose(100, 0), pose(600, 10)).at(350).points[0], 0);
  const none = pose(110, 0, {hasPose: false});
  assert.equal(historyOf(pose(100, 3), none).at(105).timeMs, 100);
  assert.equal(historyOf(none, pose(120, 3)).at(115).hasPose, false);
});

test('poses of bodies with other parts are not mixed', () => {
  const other = pose(110, 9, {capsules: new Float32Array(16)});
  assert.equal(interpolate(pose(100, 1), other, 0.5).timeMs, 100);
});

test('only the last seconds are kept', () => {
  const history = new PoseHistory();
  for (let i = 0; i < 100000; ++i) history.add(pose(10 * i, i));
  assert.ok(history.poses.length <= 302);
  assert.equal(history.newest.timeMs, 999990);
});

test('a flood of poses within a second is bounded too', () => {
  const history = new PoseHistory();
  for (let i = 0; i < 5000; ++i) history.add(pose(i / 100, i));
  assert.ok(history.poses.length <= 1000);
});

test('what arrives late is left out, and a clock that began anew starts anew', () => {
  const history = historyOf(pose(1000, 1), pose(1010, 2), pose(1005, 9));
  assert.equal(history.newest.points[0], 2);
  history.add(pose(1010 - 5000, 3));
  assert.equal(history.poses.length, 1);
  assert.equal(history.newest.points[0], 3);
});

test('the last body is found behind poses without one', () => {
  const history =
      historyOf(pose(100, 1), pose(110, 0, {hasPose: false}), pose(120, 0, {hasPose: false}));
  assert.equal(history.lastBody(120).timeMs, 100);
  assert.equal(history.lastBody(90), null);
});

test('a pose is found as received by its frame', () => {
  const history = historyOf(pose(100, 1), pose(110, 2));
  assert.equal(history.ofFrame(11).points[0], 2);
  assert.equal(history.ofFrame(12), null);
});
