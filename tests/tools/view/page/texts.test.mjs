import assert from 'node:assert/strict';
import test from 'node:test';

import {subjectNames} from '../../../../tools/view/page/actions.js';
import {factsOf, lookOfCamera} from '../../../../tools/view/page/camera_text.js';
import {conclusionOf} from '../../../../tools/view/page/state_panel.js';
import {ageText, bytesText, clockText, partText, withoutNumbers} from '../../../../tools/view/page/text.js';

const GOOD = {
  isOpen: true,
  sinceClosedS: 0,
  silence: '',
  serviceAgeS: 0.5,
  poseAgeS: 0.01,
  complaints: []
};

test('all is good only when nothing is complained of, all is fresh, and the line is open', () => {
  assert.equal(conclusionOf(GOOD).text, 'all is good');
  for (const flaw
           of [{isOpen: false}, {silence: 'nothing is heard'}, {serviceAgeS: null},
               {serviceAgeS: 4}, {poseAgeS: null}, {poseAgeS: 2}, {complaints: ['cam1 is lost']}]) {
    assert.notEqual(conclusionOf({...GOOD, ...flaw}).tone, 'ok', JSON.stringify(flaw));
  }
});

test('complaints are told word for word', () => {
  const complaints = ['cam3 is lost: check its cable and power', '<b>cam4</b>'];
  assert.deepEqual(conclusionOf({...GOOD, complaints}).lines, complaints);
});

test('ages are in the unit that fits', () => {
  assert.deepEqual([1, 89, 90, 3600, 7200, 3 * 86400, -1, NaN].map(ageText), [
    '1 second', '89 seconds', '2 minutes', '60 minutes', '2 hours', '3 days', 'unknown',
    'unknown'
  ]);
});

test('lengths of time, sizes and names are as people read them', () => {
  assert.equal(clockText(65), '1:05');
  assert.equal(clockText(3723.9), '1:02:03');
  assert.equal(bytesText(412.3e9), '412 GB');
  assert.equal(bytesText(1.25e12), '1.3 TB');
  assert.equal(partText('upper_arm_l'), 'upper arm left');
});

test('a number that changes is nothing new to say', () => {
  assert.equal(withoutNumbers('cam5 gives 24.1 of 30.0'), withoutNumbers('cam6 gives 3 of 30.0'));
});

test('a camera whose silhouettes lie beside the hull is not trusted', () => {
  const camera = {state: 'streaming', poor: []};
  assert.equal(lookOfCamera(camera), 'streaming');
  assert.equal(lookOfCamera({...camera, poor: ['off_px']}), 'not trusted');
  assert.equal(lookOfCamera({...camera, poor: ['trust']}), 'not trusted');
  assert.equal(lookOfCamera({...camera, poor: ['off_px'], state: 'lost'}), 'lost');
});

test('a camera tells what is known of it', () => {
  const camera = {
    frames_per_second: 29.97,
    trust: null,
    off_px: null,
    light: 1.02,
    dropped: 3,
    late: 0,
    torn: 0
  };
  assert.equal(factsOf(camera), '30.0\u00a0/s · light 102\u00a0% · dropped 3');
});

test('no line ends between a number and its unit', () => {
  const camera = {frames_per_second: 30, trust: 1, off_px: 0.3, light: 1.01};
  assert.doesNotMatch(factsOf(camera), /\d [^·]/);
});

test('subjects are those lines of the list that tell a stature', () => {
  assert.deepEqual(
      subjectNames('anna                    stature 1780 mm\nbert  stature 1820 mm\n'),
      ['anna', 'bert']);
  assert.deepEqual(subjectNames('no subject is saved yet\n'), []);
});
