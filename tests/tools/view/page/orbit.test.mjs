import assert from 'node:assert/strict';
import test from 'node:test';

import {Orbit} from '../../../../tools/view/page/orbit.js';

function makeOrbit(onChange) {
  return new Orbit({addEventListener() {}, clientHeight: 500}, onChange);
}

function lengthOf(a, b) {
  return Math.hypot(...a.map((value, axis) => value - b[axis]));
}

test('turning and tilting keep the distance from the target', () => {
  const orbit = makeOrbit();
  for (const [turn, rise] of [[1, 0.3], [-4, -0.2], [0.5, 0.9]]) {
    orbit.rotate(turn, rise);
    assert.ok(Math.abs(lengthOf(orbit.eye, orbit.target) - orbit.distance) < 1e-6);
  }
});

test('the eye stays above the floor and below the zenith', () => {
  const orbit = makeOrbit();
  orbit.rotate(0, 10);
  assert.ok(orbit.rise < Math.PI / 2);
  orbit.rotate(0, -20);
  assert.ok(orbit.rise > -0.1);
});

test('panning moves the target across the view', () => {
  const orbit = makeOrbit();
  const [eye, before] = [orbit.eye, [...orbit.target]];
  orbit.pan(0.1, -0.2);
  const sight = before.map((value, axis) => value - eye[axis]);
  const moved = orbit.target.map((value, axis) => value - before[axis]);
  assert.ok(lengthOf(orbit.target, before) > 1);
  assert.ok(Math.abs(sight.reduce((sum, value, axis) => sum + value * moved[axis], 0)) < 1e-3);
});

test('zooming has limits, and a reset returns home', () => {
  let changes = 0;
  const orbit = makeOrbit(() => ++changes);
  orbit.setHome([100, 200, 900], 3000);
  const home = orbit.eye;
  orbit.zoom(1e-9);
  assert.ok(orbit.distance > 100);
  orbit.zoom(1e9);
  assert.ok(orbit.distance < 1e5);
  orbit.pan(1, 1);
  orbit.reset();
  assert.deepEqual(orbit.eye, home);
  assert.equal(changes, 6);
});
