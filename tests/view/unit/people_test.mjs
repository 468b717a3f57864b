import assert from 'node:assert/strict';
import { test } from 'node:test';
import { ProtocolError } from '../../../actors/apps/view/page/src/protocol/decode_frame.js';
import { peopleOf } from '../../../actors/apps/view/page/src/protocol/connection.js';
import { decodePeople, limits }
  from '../../../actors/apps/view/page/src/protocol/decode_people.js';
import { spanOf, stateAt } from '../../../actors/apps/view/page/src/walk/clock_time.js';
import { peopleAt, presenceOf } from '../../../actors/apps/view/page/src/walk/people_at.js';

const feet = (...places) => Buffer.from(new Float32Array(places.flat()).buffer).toString('base64');
/** Walks 1 m/s east from 10 s to 10.5 s; the last step is half as long as the others. */
const walker = () => ({ eye_height: 1.6, from: 10, to: 10.5,
  feet: feet([2, 1, 0], [2.2, 1, 0], [2.4, 1, 0], [2.5, 1, 0]) });
const whole = (...people) => ({ step: 0.2, people });

test('people walk evenly between the places that are known', () => {
  const people = decodePeople(whole(walker()));
  const x = (time) => peopleAt(people, time)[0].foot[0];
  for (const time of [10, 10.05, 10.2, 10.31, 10.45, 10.5])
    assert.ok(Math.abs(x(time) - (time - 8)) < 1e-6, `${x(time)} at ${time} s`);
  assert.deepEqual(peopleAt(people, 10.2)[0].eyeHeight, 1.6);
});

test('nobody is there before coming and after leaving', () => {
  const late = { ...walker(), from: 20, to: 20.5 };
  const people = decodePeople(whole(walker(), late));
  assert.deepEqual([9.9, 10, 10.5, 10.6, 20.2].map((t) => peopleAt(people, t).length),
    [0, 1, 1, 0, 1]);
  assert.deepEqual(presenceOf(people), { from: 10, to: 20.5 });
  assert.equal(presenceOf(decodePeople(whole())), null);
});

test('a person of one moment stands there', () => {
  const people = decodePeople(whole({ eye_height: 1.2, from: 3, to: 3, feet: feet([1, 2, 3]) }));
  assert.deepEqual(peopleAt(people, 3), [{ eyeHeight: 1.2, foot: [1, 2, 3] }]);
});

test('a wrong field of people is refused, and named', () => {
  const refused = (one, pattern) => assert.throws(
    () => decodePeople(whole(one)),
    (error) => error instanceof ProtocolError && pattern.test(error.message));
  refused({ ...walker(), eye_height: 0 }, /people\[0\]\.eye_height/);
  refused({ ...walker(), to: 9 }, /people\[0\]\.to/);
  refused({ ...walker(), from: 'now' }, /people\[0\]\.from/);
  refused({ ...walker(), feet: '"><script>' }, /not base64/);
  refused({ ...walker(), feet: '' }, /0 bytes/);
  refused({ ...walker(), feet: Buffer.alloc(13).toString('base64') }, /13 bytes/);
  refused({ ...walker(), feet: feet([1e9, 0, 0]) }, /too far/);
  refused({ ...walker(), feet: feet([NaN, 0, 0]) }, /too far/);
  refused(null, /no object/);
  assert.throws(() => decodePeople({ step: 0, people: [] }), /step/);
  assert.throws(() => decodePeople(null), ProtocolError);
  assert.throws(() => decodePeople({ step: 1, people: new Array(limits.people + 1) }), /no list/);
});

test('people are requested beside the page', async () => {
  const ask = async (address) => ({ ok: address === 'http://host:1/people.json?token=t',
    json: async () => whole(walker()) });
  assert.equal((await peopleOf('http://host:1/?token=t', ask)).people.length, 1);
});

test('the clock spans states and people', () => {
  assert.equal(spanOf(null, null), null);
  assert.deepEqual(spanOf({ from: 0, to: 60 }, null), { from: 0, to: 60 });
  assert.deepEqual(spanOf({ from: 0, to: 60 }, { from: -5, to: 20 }), { from: -5, to: 60 });
});

test('a time takes the light of the nearest state, and the last one is the end', () => {
  const states = { from: 10, to: 35, step: 10 };
  assert.deepEqual([-3, 10, 14, 16, 29, 33, 99].map((t) => stateAt(states, t)),
    [10, 10, 10, 20, 30, 35, 35]);
});
