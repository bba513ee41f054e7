import assert from 'node:assert/strict';
import test from 'node:test';

// Colours ask the browser for its theme.
globalThis.window = {
  matchMedia: () => ({matches: false})
};
const {People} = await import('../../../../tools/view/page/people.js');

function pose(person, id, timeMs, more = {}) {
  return {
    person,
    id,
    timeMs,
    publishMs: timeMs + 20,
    state: 'tracking',
    hasPose: true,
    residualMm: 10 + id,
    points: new Float32Array([timeMs, 0, 0]),
    capsules: new Float32Array(),
    contacts: new Float32Array(),
    ...more
  };
}

function peopleOf(...sets) {
  const people = new People(null);
  for (const set of sets) people.takePoses(set, set[0].timeMs + 30);
  return people;
}

test('whoever is not in a set has left', () => {
  const people = peopleOf([pose(0, 1, 100), pose(1, 2, 100)], [pose(1, 2, 110)]);
  assert.deepEqual(people.rows(140).map((row) => row.id), [2]);
  assert.equal(people.rows(140)[0].color, 'figure-1');
});

test('whoever has been followed the longest comes first, whatever the colour', () => {
  const people = peopleOf([pose(1, 2, 100)], [pose(1, 2, 110), pose(0, 3, 110)]);
  assert.deepEqual(people.rows(140).map((row) => row.id), [2, 3]);
});

test('a colour that goes to somebody else brings no past with it', () => {
  const people = peopleOf([pose(0, 1, 100)], [pose(0, 5, 110)]);
  assert.equal(people.histories.get(0).poses.length, 1);
});

test('whoever gets a number while being measured stays the same', () => {
  const people = peopleOf([pose(0, 0, 100, {state: 'acquiring'})], [pose(0, 1, 110)]);
  assert.equal(people.histories.get(0).poses.length, 2);
});

test('the panel tells the name, or the number, and since when', () => {
  const people = peopleOf([pose(0, 1, 10000), pose(1, 2, 10000)]);
  people.takePeople({
    people: [
      {id: 1, color: 0, name: 'anna', since_ms: 20, has_come: false},
      {id: 2, color: 1, name: '', since_ms: 7020, has_come: true}
    ]
  });
  const [anna, other] = people.rows(10030);
  assert.equal(anna.label, 'anna');
  assert.equal(anna.followedS, 10);
  assert.equal(anna.residualMm, 11);
  assert.equal(other.label, 'person 2');
  assert.equal(other.followedS, 3);
  assert.equal(other.hasCome, true);
});

test('the panel tells how sure a pose in doubt is', () => {
  const people = peopleOf(
      [pose(0, 1, 100, {probability: 0.6}), pose(1, 2, 100, {probability: 0.99}), pose(2, 3, 100)]);
  assert.deepEqual(people.rows(140).map((row) => row.doubt), ['60\u00a0%\u00a0sure', '', '']);
});

test('nobody is old or gone because the clock of the studio was put back', () => {
  const noonMs = 1.7e12;
  for (const stepMs of [-800, -3600000]) {
    const people = new People(null);
    people.takePoses([pose(0, 1, noonMs - 20), pose(1, 2, noonMs - 20)], 980);
    people.takePoses([pose(0, 1, noonMs)], 1020);
    for (let i = 1; i < 10; ++i) {
      people.takePoses([pose(0, 1, noonMs + stepMs + 10 * i)], 1020 + 10 * i);
      assert.ok(people.draw(1020 + 10 * i) < 50, `${stepMs}`);
      assert.ok(people.shown.timeMs <= noonMs + stepMs + 10 * i);
    }
  }
});
