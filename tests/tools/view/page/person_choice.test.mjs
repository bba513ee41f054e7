import assert from 'node:assert/strict';
import test from 'node:test';

import {PersonChoice} from '../../../../tools/view/page/person_choice.js';

const anna = {
  id: 3,
  label: 'anna'
},
      bert = {
        id: 4,
        label: 'person 4'
      },
      cleo = {
        id: 7,
        label: 'cleo'
      };

function choiceAfter(...sets) {
  const choice = new PersonChoice();
  for (const set of sets) choice.take(set);
  return choice;
}

test('one alone is meant by number, without a list', () => {
  const choice = choiceAfter([anna]);
  assert.equal(choice.value, '3');
  assert.equal(choice.isOffered, false);
});

test('of several the first is meant until another is chosen', () => {
  const choice = choiceAfter([anna, bert]);
  assert.equal(choice.isOffered, true);
  assert.equal(choice.value, '3');
  choice.choose('4');
  choice.take([anna, bert, cleo]);
  assert.deepEqual(choice.options().map((option) => option.selected), [false, true, false]);
});

test('nobody is taken for the chosen one who has left', () => {
  for (const rest of [[bert, cleo], [bert]]) {
    const choice = choiceAfter([anna, bert, cleo], rest, rest);
    assert.equal(choice.isGone, true);
    assert.equal(choice.value, '');
    assert.equal(choice.isOffered, true);
    assert.deepEqual(choice.options()[0], {text: 'whose?', value: '', selected: true});
    choice.choose('4');
    assert.equal(choice.isGone, false);
    assert.equal(choice.value, '4');
  }
});

test('the chosen one stays so when the others leave', () => {
  const choice = choiceAfter([anna, bert]);
  choice.choose('4');
  choice.take([bert]);
  assert.equal(choice.value, '4');
  assert.equal(choice.isOffered, false);
});

test('an empty room is a new beginning', () => {
  const choice = choiceAfter([anna, bert], [bert], [], [cleo]);
  assert.equal(choice.isGone, false);
  assert.equal(choice.value, '7');
});

test('who has no number yet is meant by none', () => {
  const choice = choiceAfter([{id: 0, label: 'person 0'}]);
  assert.equal(choice.value, '');
  choice.take([anna]);
  assert.equal(choice.value, '3');
});
