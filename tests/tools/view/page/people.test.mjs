import assert from 'node:assert/strict';
import test from 'node:test';

// Colours ask the browser for its scheme when they are loaded.
globalThis.window = {
  matchMedia: () => ({matches: false})
};
const {People} = await import('../../../../tools/view/page/people.js');

const NOON_MS = 1.7e12;

function poseOf(person, timeMs) {
  return {
    person,
    timeMs,
    publishMs: timeMs + 15,
    state: 'tracking',
    hasPose: true,
    points: new Float32Array(69),
    capsules: new Float32Array(8),
  };
}

test('nobody is old or gone because the clock of the studio was put back', () => {
  for (const stepMs of [-800, -3600000]) {
    const people = new People(null);
    people.takePose(poseOf(1, NOON_MS - 20), 980);
    people.takePose(poseOf(0, NOON_MS), 1020);
    for (let i = 1; i < 10; ++i) {
      people.takePose(poseOf(0, NOON_MS + stepMs + 10 * i), 1020 + 10 * i);
      assert.ok(people.draw(1020 + 10 * i) < 50, `${stepMs}`);
      assert.ok(people.shown.timeMs <= NOON_MS + stepMs + 10 * i);
    }
  }
});
